#include "training/discovery/clip_discovery.hpp"

#include <gtest/gtest.h>

#include "motion/skeleton/bvh.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/training/discovery/stepping_dance.hpp"

namespace raks::motion::clip_discovery_test {
namespace {

class ClipDiscovery : public ::testing::Test {
 protected:
    void write(const std::string& name, const TrainingClip& clip) {
        ASSERT_TRUE(
            write_bvh(folder_ / name, mannequin_skeleton(), clip.poses, clip.frames_per_second));
    }
    [[nodiscard]] FigureTrainingPlan plan() const {
        FigureTrainingPlan plan;
        plan.clips = {folder_.path()};
        plan.dance = "mambo";
        plan.metres_per_unit = 1.0;
        return plan;
    }

    raks::test::TemporaryFolder folder_;
};

TEST_F(ClipDiscovery, a_figure_is_learnt_from_clips_that_nobody_labelled) {
    test::SteppingDance dance;
    dance.raised = {2};
    write("1.bvh", test::stepping_clip(dance));
    dance.raised = {};
    dance.repeats = 5;
    write("2.bvh", test::stepping_clip(dance));
    FigureTrainingPlan learn = plan();
    const auto found = discover_clips(learn, Discovery::repeats, {});
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_EQ(found->clips.size(), 2U);
    learn.found = found->labels(learn);
    const auto report = train_figure(learn);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->model.beats, 8);
    EXPECT_GE(report->model.repeats, 8);
    EXPECT_NEAR(report->model.learnt_tempo.bpm(), 60.0 / dance.beat, 5.0);
}

TEST_F(ClipDiscovery, a_clip_taken_once_is_learnt_as_one_phrase) {
    test::SteppingDance dance;
    dance.repeats = 1;
    write("1.bvh", test::stepping_clip(dance));
    FigureTrainingPlan learn = plan();
    const auto none = discover_clips(learn, Discovery::repeats, {});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message,
              "1.bvh: nothing in it repeats; --once learns it as a single phrase");
    DiscoveryOptions options;
    options.beats = 8;
    const auto found = discover_clips(learn, Discovery::whole_phrase, options);
    ASSERT_TRUE(found) << found.error().message;
    learn.found = found->labels(learn);
    const auto report = train_figure(learn);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->model.repeats, 1);
}

}  // namespace
}  // namespace raks::motion::clip_discovery_test
