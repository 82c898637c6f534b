#include "training/discovery/clip_discovery.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/pending_file.hpp"
#include "motion/skeleton/formats/bvh.hpp"
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
              "1.bvh: nothing in it repeats; --once learns it as a single phrase, raks train take "
              "beat by beat");
    DiscoveryOptions options;
    options.beats = 8;
    const auto found = discover_clips(learn, Discovery::whole_phrase, options);
    ASSERT_TRUE(found) << found.error().message;
    learn.found = found->labels(learn);
    const auto report = train_figure(learn);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->model.repeats, 1);
}

TEST_F(ClipDiscovery, a_phrase_that_cannot_be_read_is_left_out_beside_others) {
    test::SteppingDance dance;
    dance.repeats = 2;
    write("1.bvh", test::stepping_clip(dance));
    ASSERT_TRUE(write_file(folder_ / "2.bvh", "nonsense"));
    FigureTrainingPlan learn = plan();
    const auto found = discover_clips(learn, Discovery::whole_phrase, {});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->clips.size(), 1U);
    EXPECT_EQ(found->skipped.size(), 1U);
    learn.clips = {folder_ / "2.bvh"};
    EXPECT_FALSE(discover_clips(learn, Discovery::whole_phrase, {}));
}

TEST(TakeNames, are_those_of_files_and_of_clips_in_them) {
    EXPECT_EQ(take_name("a/hip hop.fbx"), "hip hop");
    EXPECT_EQ(take_name("a/x.glb#Dance 2"), "x#Dance 2");
    EXPECT_EQ(take_name("clips/"), "clips");
}

TEST_F(ClipDiscovery, a_dance_in_place_leads_nowhere) {
    TrainingClip clip = test::stepping_clip({});
    const auto frames = static_cast<float>(clip.poses.size());
    for (std::size_t i = 0; i < clip.poses.size(); ++i) {
        clip.poses[i].hips_position.x += 5.0F * static_cast<float>(i) / frames;
    }
    write("1.bvh", clip);
    std::vector<std::string> warnings;
    FigureTrainingPlan learn = plan();
    learn.clips = {folder_ / "1.bvh"};
    const auto as_it_is = load_clip(learn.clips[0], units_of(learn), warnings);
    learn.travel = ClipTravel::none;
    const auto in_place = load_clip(learn.clips[0], units_of(learn), warnings);
    ASSERT_TRUE(as_it_is && in_place);
    const auto way = [](const TrainingClip& of, std::size_t frame) {
        return of.poses[frame].hips_position.x - of.poses[0].hips_position.x;
    };
    EXPECT_GT(way(*as_it_is, clip.poses.size() - 1), 4.5F);
    for (std::size_t i = 0; i < clip.poses.size(); i += 10) {
        EXPECT_LT(std::abs(way(*in_place, i)), 0.1F) << i;
        // The feet go with the hips, and the height stays.
        const auto left_toe = [i](const TrainingClip& of) {
            return of.feet[i][0].toe_tip.x - static_cast<double>(of.poses[i].hips_position.x);
        };
        EXPECT_NEAR(left_toe(*in_place), left_toe(*as_it_is), 1e-4);
        EXPECT_EQ(in_place->poses[i].hips_position.y, as_it_is->poses[i].hips_position.y);
    }
}

FigureModel learnt_at(double rate) {
    test::SteppingDance dance;
    dance.frames_per_second = rate;
    std::vector<FigureRepeat> repeats;
    for (int r = 0; r < dance.repeats; ++r) {
        FigureRepeat repeat;
        for (int b = 0; b <= 8; ++b) {
            repeat.beat_frames.push_back((dance.count_1(r) + dance.beat * b) * rate);
        }
        repeats.push_back(repeat);
    }
    FigureTrainingOptions options;
    options.name = "basic";
    options.dance = "mambo";
    const std::vector<TrainingClip> clips = {test::stepping_clip(dance)};
    return train_figure(clips, repeats, options).value().model;
}

TEST(FrameRates, the_same_motion_gives_nearly_the_same_figure) {
    const FigureModel at_60 = learnt_at(60.0);
    for (const double rate : {24.0, 29.97, 119.88, 120.0, 240.0}) {
        const FigureModel other = learnt_at(rate);
        const std::vector<FigureState>& states = at_60.part(Part::lower).states;
        for (std::size_t k = 0; k < states.size(); ++k) {
            for (std::size_t d = 0; d < states[k].mean.size(); ++d) {
                EXPECT_NEAR(other.part(Part::lower).states[k].mean[d], states[k].mean[d], 0.01)
                    << rate << " state " << k << " feature " << d;
            }
        }
        // At 24 the filter of 10 Hz lies near half the rate.
        EXPECT_NEAR(other.peak_toe_speed, at_60.peak_toe_speed, 0.04 * at_60.peak_toe_speed)
            << rate;
        EXPECT_NEAR(other.learnt_tempo.bpm(), at_60.learnt_tempo.bpm(), 0.1) << rate;
        EXPECT_NEAR(other.net_displacement.y, at_60.net_displacement.y, 0.005) << rate;
    }
}

}  // namespace
}  // namespace raks::motion::clip_discovery_test
