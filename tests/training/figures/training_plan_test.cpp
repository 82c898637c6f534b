// From files to a figure: clips written by our own writer, tables as a person would type them.
#include "training/figures/training_plan.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "tests/motion/figures/small_figure.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::motion {
namespace {

class TrainingPlan : public ::testing::Test {
 protected:
    void SetUp() override {
        const TrainingClip clip = test::known_dance(3);
        ASSERT_TRUE(write_bvh(folder_ / "60_99.bvh", mannequin_skeleton(), clip.poses, 120.0));
        std::string labels = "take\trole\tstart\tend\tfigure\tbeats\tconfidence\tsplit\n";
        std::string counts = "take\tcount\tframe\n";
        for (int r = 0; r < 3; ++r) {
            labels += fmt::format("60_99\tlead\t{}\t{}\tbasic\t8\t{}\ttrain\n",
                                  160 * r,
                                  160 * (r + 1),
                                  1.0 - 0.1 * r);
            for (int c = 1; c <= 8; ++c) {
                counts += fmt::format("99\t{}\t{}\n", c, 160 * r + 20 * (c - 1));
            }
        }
        write("labels.tsv", labels);
        write("counts.tsv", counts);
        plan_.dance = "salsa";
        plan_.clips = {folder_.path()};
        plan_.labels = folder_ / "labels.tsv";
        plan_.counts = folder_ / "counts.tsv";
        plan_.reading.frames_per_second = 60.0;  // the file says 120
        plan_.metres_per_unit = 1.0;
        plan_.min_confidence = 0.85;
    }

    void write(const std::string& name, const std::string& text) const {
        ASSERT_TRUE(write_file(folder_ / name, text));
    }
    [[nodiscard]] std::string failure() const {
        const Expected<FigureTrainingReport> report = train_figure(plan_);
        return report ? std::string("learnt") : report.error().message;
    }

    raks::test::TemporaryFolder folder_;
    FigureTrainingPlan plan_;
};

TEST_F(TrainingPlan, learns_what_the_tables_say_and_reports_the_rest) {
    const Expected<FigureTrainingReport> report = train_figure(plan_);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->model.repeats, 2);
    EXPECT_NEAR(report->model.learnt_tempo.bpm(), 180.0, 1e-6);
    ASSERT_EQ(report->repeats.size(), 3U);
    EXPECT_EQ(report->repeats[1].left_out, "");
    EXPECT_EQ(report->repeats[2].left_out, "confidence 0.8 is under 0.85");
    // The mannequin is its own source: hips over the toe tips, as its skeleton has them.
    EXPECT_NEAR(report->model.source_hips_height,
                static_cast<double>(mannequin_skeleton().hips_height()),
                0.03);
}

TEST_F(TrainingPlan, evenly_spaced_counts_are_the_same_as_none) {
    const Expected<FigureTrainingReport> with = train_figure(plan_);
    plan_.counts.reset();
    const Expected<FigureTrainingReport> without = train_figure(plan_);
    ASSERT_TRUE(with && without);
    EXPECT_EQ(figure_text(with->model), figure_text(without->model));
}

TEST_F(TrainingPlan, leaves_out_long_faults_and_bridges_short_ones) {
    write("faults.tsv",
          "take\tfrom\tto\tjoints\n60_99\t40\t43\tlFoot\n60_99\t0\t480\thead\n"
          "60_99\t160\t250\thip\n");
    plan_.faults = folder_ / "faults.tsv";
    const Expected<FigureTrainingReport> report = train_figure(plan_);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->model.repeats, 1);
    EXPECT_EQ(report->repeats[1].left_out, "hip bad from frame 160 to 250");
}

TEST_F(TrainingPlan, warns_of_a_tempo_that_nobody_dances) {
    plan_.reading.frames_per_second = 120.0;
    const Expected<FigureTrainingReport> report = train_figure(plan_);
    ASSERT_TRUE(report) << report.error().message;
    ASSERT_FALSE(report->warnings.empty());
    EXPECT_EQ(report->warnings.back(),
              "learnt at 360 BPM, faster than people dance: is the frame rate right? (--fps)");
}

TEST_F(TrainingPlan, says_in_one_line_what_is_missing) {
    plan_.figure = "pirouette";
    EXPECT_EQ(failure(),
              "labels.tsv: no pirouette of the lead to learn from (0 labelled, none fit); check "
              "figure, role, split and confidence");
    plan_.figure = "basic";
    plan_.labels = folder_ / "none.tsv";
    EXPECT_NE(failure().find("none.tsv: cannot be opened"), std::string::npos);
    plan_.labels = folder_ / "labels.tsv";
    plan_.clips = {folder_ / "60_98.bvh"};
    EXPECT_EQ(failure(), "labels.tsv: line 2: no clip named 60_99 was given");
    plan_.clips = {};
    EXPECT_EQ(failure(), "no clips given; name motion files or their folder");
}

TEST_F(TrainingPlan, refuses_labels_beyond_the_clip_and_bodies_that_are_none) {
    write("labels.tsv", "take\trole\tstart\tend\tfigure\tbeats\n60_99\tlead\t400\t560\tbasic\t8\n");
    EXPECT_EQ(failure(), "labels.tsv: line 2: end is 560, 60_99 has 481 frames");
    write("labels.tsv", "take\trole\tstart\tend\tfigure\tbeats\n60_99\tlead\t0\t160\tbasic\t8\n");
    write("60_99.bvh",
          "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
          "JOINT b\n{\nOFFSET 0 1 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\n"
          "OFFSET 0 1 0\n}\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.01\n0 0 0 0 0 0\n");
    const std::string message = failure();
    EXPECT_NE(message.find("60_99.bvh"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace raks::motion
