#include "motion/figures/phrase_tempo.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {
namespace {

/// A body that bounces on each beat, sways from one to the next and swings its arms over four.
Pose pose_at_beat(double beat) {
    const Skeleton& body = mannequin_skeleton();
    const auto wave = [&](double beats) { return std::sin(2.0 * M_PI * beat / beats); };
    Pose pose;
    pose.hips_position =
        body.offsets[0] +
        glm::vec3(static_cast<float>(0.04 * wave(2.0)), static_cast<float>(0.02 * wave(1.0)), 0.0F);
    const auto turn = [&](Bone bone, double angle, const glm::vec3& axis) {
        pose.rotation(bone) = glm::angleAxis(static_cast<float>(angle), axis);
    };
    // One knee up in each beat.
    const double lift = std::max(0.0, wave(2.0));
    const double other = std::max(0.0, -wave(2.0));
    for (const auto& [upper, lower, angle] :
         {std::tuple(Bone::left_upper_leg, Bone::left_lower_leg, lift),
          std::tuple(Bone::right_upper_leg, Bone::right_lower_leg, other)}) {
        turn(upper, -0.7 * angle, {1, 0, 0});
        turn(lower, 1.1 * angle, {1, 0, 0});
    }
    turn(Bone::left_upper_arm, -1.1 + 0.3 * wave(4.0), {0, 0, 1});
    turn(Bone::right_upper_arm, 1.1 + 0.3 * wave(4.0), {0, 0, 1});
    turn(Bone::left_lower_arm, -0.6 + 0.3 * wave(2.0), {0, 1, 0});
    turn(Bone::right_lower_arm, 0.6, {0, 1, 0});
    return pose;
}

std::vector<Pose> phrase(int beats, double bpm, double rate) {
    std::vector<Pose> poses;
    const auto frames = std::lround(60.0 * beats / bpm * rate);
    for (long frame = 0; frame < frames; ++frame) {
        poses.push_back(pose_at_beat(static_cast<double>(frame) / rate * bpm / 60.0));
    }
    return poses;
}

std::vector<PhraseCount> counted(const std::vector<Pose>& poses, double rate) {
    return count_phrase(PhraseSignals(poses, rate, mannequin_skeleton()));
}

TEST(PhraseTempo, counts_a_beat_that_is_bounced) {
    for (const int beats : {8, 16, 32}) {
        for (const double bpm : {96.0, 112.0, 126.0}) {
            const auto counts = counted(phrase(beats, bpm, 60.0), 60.0);
            ASSERT_FALSE(counts.empty());
            EXPECT_EQ(counts[0].beats, beats) << bpm;
            EXPECT_NEAR(counts[0].bpm, bpm, 0.01 * bpm) << beats;
        }
    }
}

TEST(PhraseTempo, keeps_a_number_of_beats_that_is_unusual) {
    const auto counts = counted(phrase(20, 112.0, 60.0), 60.0);
    EXPECT_TRUE(std::any_of(counts.begin(), counts.begin() + 3, [](const PhraseCount& count) {
        return count.beats == 20;
    }));
}

TEST(PhraseTempo, does_not_depend_on_the_frame_rate) {
    const auto at_60 = counted(phrase(16, 110.0, 60.0), 60.0);
    for (const double rate : {30.0, 120.0, 240.0}) {
        const auto other = counted(phrase(16, 110.0, rate), rate);
        ASSERT_FALSE(other.empty());
        EXPECT_EQ(other[0].beats, at_60[0].beats) << rate;
        EXPECT_NEAR(other[0].probability, at_60[0].probability, 0.1) << rate;
    }
}

TEST(PhraseTempo, probabilities_are_those_of_all_counts) {
    const auto counts = counted(phrase(16, 110.0, 60.0), 60.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        sum += counts[i].probability;
        EXPECT_GE(counts[i].beats, 2);
        EXPECT_GE(counts[i].bpm, 40.0);
        EXPECT_LE(counts[i].bpm, 240.0);
        if (i > 0) {
            EXPECT_LE(counts[i].probability, counts[i - 1].probability);
        }
    }
    EXPECT_NEAR(sum, 1.0, 1e-9);
}

TEST(PhraseTempo, what_is_too_short_or_still_is_no_trouble) {
    EXPECT_TRUE(counted({}, 60.0).empty());
    EXPECT_TRUE(counted(phrase(2, 120.0, 60.0), 60.0).empty()) << "a second";
    const auto still = counted(std::vector<Pose>(600), 60.0);
    ASSERT_FALSE(still.empty());
    EXPECT_TRUE(std::isfinite(still[0].probability));
}

TEST(RestPoses, are_those_that_a_clip_was_made_with) {
    const std::vector<Pose> danced = phrase(8, 120.0, 60.0);
    EXPECT_EQ(leading_rest_poses(danced, 60.0), 0U);
    std::vector<Pose> clip(12);  // the T-pose
    clip.insert(clip.end(), danced.begin(), danced.end());
    EXPECT_EQ(leading_rest_poses(clip, 60.0), 12U);
    EXPECT_EQ(leading_rest_poses(std::vector<Pose>(12), 60.0), 0U) << "all of it";
    // Who stands for a moment before the first step has begun; who stands for long has not.
    for (const std::size_t frames : {6U, 60U}) {
        std::vector<Pose> stance(frames);
        for (double share = 0.0; share < 1.0; share += 0.05) {
            Pose begun;
            begun.rotation(Bone::left_upper_leg) =
                glm::angleAxis(static_cast<float>(-share), glm::vec3(1, 0, 0));
            stance.push_back(begun);
        }
        EXPECT_EQ(leading_rest_poses(stance, 60.0) >= frames, frames > 20U) << frames;
    }
    // Who stands still, elbows bent, has begun.
    std::vector<Pose> posed(12, danced[0]);
    posed.insert(posed.end(), danced.begin(), danced.end());
    EXPECT_EQ(leading_rest_poses(posed, 60.0), 0U);
}

}  // namespace
}  // namespace raks::motion
