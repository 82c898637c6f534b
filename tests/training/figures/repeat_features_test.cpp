// Repeats that turn to the other side than most are not averaged with them.
#include "training/figures/repeat_features.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {
namespace {

/// A clip that turns by each of these angles in 100 frames.
TrainingClip turning(const std::vector<double>& turns) {
    TrainingClip clip;
    double heading = 0.0;
    for (const double turn : turns) {
        for (int frame = 0; frame < 100; ++frame) {
            heading += turn / 100.0;
            Pose pose;
            pose.rotation(Bone::hips) =
                glm::angleAxis(static_cast<float>(heading), glm::vec3(0, 1, 0));
            clip.poses.push_back(pose);
        }
    }
    clip.poses.push_back(clip.poses.back());
    return clip;
}

TEST(CommonTurn, is_counted_over_full_turns) {
    const TrainingClip clip = turning({-3.0 * M_PI});
    EXPECT_NEAR(turn_of(clip, {0, {0.0, 50.0, 100.0}, 1.0}), -3.0 * M_PI, 0.1);
}

TEST(CommonTurn, keeps_those_that_turn_as_most_do) {
    const std::vector<double> turns = {3.0, -3.2, 3.3, 2.8, 9.3, 4.2, 0.1};
    std::vector<FigureRepeat> repeats;
    for (std::size_t i = 0; i < turns.size(); ++i) {
        const double start = 100.0 * static_cast<double>(i);
        repeats.push_back({0, {start, start + 50.0, start + 99.0}, 1.0});
    }
    EXPECT_EQ(of_common_turn({turning(turns)}, repeats),
              (std::vector<bool>{true, false, true, true, false, true, false}));
}

TEST(CommonTurn, of_one_repeat_is_its_own) {
    EXPECT_EQ(of_common_turn({turning({1.0})}, {{0, {0.0, 50.0, 99.0}, 1.0}}),
              std::vector<bool>{true});
}

}  // namespace
}  // namespace raks::motion
