#include "motion/dance/baking/figure_size.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "motion/dance/body/limb_ik.hpp"
#include "motion/dance/dance_content.hpp"
#include "tests/motion/dance/stage.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr int kPosesABeat = 32;

const DanceContent& content() {
    static const DanceContent made = [] {
        auto result = make_content(std::vector{test::basic_step()}, mannequin_skeleton(), nullptr);
        EXPECT_TRUE(result) << result.error().message;
        return std::move(*result);
    }();
    return made;
}

std::vector<Pose> poses_of(const FigureSize& size) {
    FigureChoice choice = choose_ways(0, 1, 0);
    choice.size = size;
    std::vector<Pose> poses;
    for (int i = 0; i < content().figures[0].beats * kPosesABeat; ++i) {
        poses.push_back(pose_of(content(), choice, static_cast<double>(i) / kPosesABeat));
    }
    return poses;
}

/// How far an ankle comes over the floor, forward and back.
float step_length(const std::vector<Pose>& poses, Side side) {
    float least = 1e9F;
    float most = -1e9F;
    for (const Pose& pose : poses) {
        const float z =
            world_pose(content().skeleton, pose).position(on_side(Bone::left_foot, side)).z;
        least = std::min(least, z);
        most = std::max(most, z);
    }
    return most - least;
}

TEST(FigureSize, as_large_as_learnt_changes_nothing) {
    const FigureMiddle& middle = content().figures[0].middle;
    for (const Pose& learnt : poses_of({})) {
        Pose pose = learnt;
        resize(middle, {}, content().skeleton, pose);
        const WorldPose before = world_pose(content().skeleton, learnt);
        const WorldPose after = world_pose(content().skeleton, pose);
        for (const Bone bone : FigurePassage::kBones) {
            ASSERT_LT(glm::distance(before.position(bone), after.position(bone)), 1e-3F);
        }
    }
}

TEST(FigureSize, smaller_steps_stand_as_still_as_large_ones) {
    const std::vector<Pose> learnt = poses_of({});
    const std::vector<Pose> small = poses_of({.body = 0.8F, .arms = 0.8F, .steps = {0.8F, 0.8F}});
    for (const Side side : kSides) {
        EXPECT_NEAR(step_length(small, side) / step_length(learnt, side), 0.8F, 0.02F);
        const auto ball = [&](const Pose& pose) {
            return foot_point(world_pose(content().skeleton, pose), side, content().skeleton.ball);
        };
        for (std::size_t i = 1; i < learnt.size(); ++i) {
            const bool is_planted = small[i].foot_contact[static_cast<std::size_t>(side)] &&
                                    small[i - 1].foot_contact[static_cast<std::size_t>(side)];
            const float slid = glm::distance(ball(learnt[i]), ball(learnt[i - 1]));
            if (is_planted) {
                ASSERT_LT(glm::distance(ball(small[i]), ball(small[i - 1])), slid + 0.002F) << i;
            }
            ASSERT_NEAR(ball(small[i]).y, ball(learnt[i]).y, 0.003F) << i;
        }
    }
}

TEST(FigureSize, jumps_come_down_in_their_time) {
    const FigureMiddle& middle = content().figures[0].middle;
    const Pose standing = poses_of({}).front();
    Pose jumping = standing;
    jumping.hips_position.y += 0.10F;
    Pose lower = jumping;
    resize(middle, {.flight = 0.5F}, content().skeleton, lower);
    const auto toe = [&](const Pose& pose) {
        return toe_tip(content().skeleton, world_pose(content().skeleton, pose), Side::left).y;
    };
    EXPECT_NEAR(toe(lower) - toe(standing), 0.05F, 0.01F);
    EXPECT_NEAR(
        lower.hips_position.y - standing.hips_position.y, toe(lower) - toe(standing), 0.002F);
}

TEST(FigureSize, follows_the_tempo_as_far_as_the_figure_says) {
    const auto at = [](double exponent, double tempo) {
        return figure_size({exponent, 0.0}, Bpm(120.0), Bpm(tempo));
    };
    EXPECT_TRUE(at(0.0, 180.0).is_as_learnt()) << "captured figures";
    EXPECT_TRUE(at(0.7, 120.0).is_as_learnt());
    EXPECT_NEAR(at(1.0, 150.0).body, 0.8F, 1e-6F);
    EXPECT_NEAR(at(1.0, 150.0).flight, 0.64F, 1e-6F);
    EXPECT_EQ(at(0.7, 150.0).arms, 1.0F);
    EXPECT_EQ(at(2.0, 1000.0).body, 0.6F);
    EXPECT_EQ(at(0.7, 90.0).body, 1.0F) << "legs reach no farther";
    EXPECT_GT(at(0.7, 90.0).flight, 1.0F);
}

}  // namespace
}  // namespace raks::motion
