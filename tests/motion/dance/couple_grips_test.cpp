// Hands that hold one another: palms meet, arms are neither stretched nor folded.
#include "motion/dance/couple_grips.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/skeleton/palm.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr float kHalfTurn = 3.14159265F;

/// One who stands with bent arms, hands before the belly.
Pose standing(const glm::vec3& place, float heading) {
    Pose pose;
    pose.hips_position = {place.x, mannequin_skeleton().hips_height(), place.z};
    pose.rotation(Bone::hips) = glm::angleAxis(heading, glm::vec3(0, 1, 0));
    for (const Side side : kSides) {
        const float sign = side == Side::left ? 1.0F : -1.0F;
        pose.rotation(on_side(Bone::left_upper_arm, side)) =
            glm::angleAxis(-sign * 1.2F, glm::vec3(0, 0, 1));
        pose.rotation(on_side(Bone::left_lower_arm, side)) =
            glm::angleAxis(-sign * 1.3F, glm::vec3(0, 1, 0));
    }
    return pose;
}

/// Distance from shoulder to wrist, of the arm's length.
float reach_of(const Pose& pose, Side side) {
    const WorldPose world = world_pose(mannequin_skeleton(), pose);
    const glm::vec3 shoulder = world.position(on_side(Bone::left_upper_arm, side));
    const glm::vec3 elbow = world.position(on_side(Bone::left_lower_arm, side));
    const glm::vec3 hand = world.position(on_side(Bone::left_hand, side));
    return glm::distance(shoulder, hand) /
           (glm::distance(shoulder, elbow) + glm::distance(elbow, hand));
}

struct Two {
    Pose lead;
    Pose follow;
};

/// The couple with these weights held.
Two held(Two two, const GripWeights& weights, bool is_closed) {
    const CoupleGrips grips(mannequin_skeleton(), mannequin_skeleton());
    const WorldPose lead = world_pose(mannequin_skeleton(), two.lead);
    const WorldPose follow = world_pose(mannequin_skeleton(), two.follow);
    grips.hold(weights, is_closed, lead, follow, two.lead, two.follow);
    return two;
}

Two couple(float aside, float ahead) {
    return {standing({0.0F, 0.0F, 0.0F}, 0.0F), standing({aside, 0.0F, ahead}, kHalfTurn)};
}

GripWeights only(Grip grip, float weight) {
    GripWeights weights{};
    weights[index_of(grip)] = weight;
    return weights;
}

float between_palms(const Two& two, Side lead, Side follow) {
    return glm::distance(palm_of(world_pose(mannequin_skeleton(), two.lead), lead),
                         palm_of(world_pose(mannequin_skeleton(), two.follow), follow));
}

TEST(CoupleGrips, palms_that_are_held_meet) {
    for (const Side lead : kSides) {
        for (const Side follow : kSides) {
            for (const float aside : {-0.2F, 0.0F, 0.2F}) {
                for (const float ahead : {0.5F, 0.65F, 0.8F}) {
                    const Two two =
                        held(couple(aside, ahead), only(palms(lead, follow), 1.0F), false);
                    EXPECT_LT(between_palms(two, lead, follow), 0.04F)
                        << aside << " " << ahead << " " << static_cast<int>(palms(lead, follow));
                    EXPECT_LT(reach_of(two.lead, lead), 0.98F);
                    EXPECT_GT(reach_of(two.lead, lead), 0.42F);
                }
            }
        }
    }
}

TEST(CoupleGrips, palms_meet_between_arms_of_unlike_length) {
    const Skeleton& tall = mannequin_skeleton();
    Skeleton small = tall;
    for (const Side side : kSides) {
        small.offsets[index_of(on_side(Bone::left_lower_arm, side))] *= 0.75F;
        small.offsets[index_of(on_side(Bone::left_hand, side))] *= 0.75F;
    }
    for (const bool leads_tall : {true, false}) {
        const Skeleton& lead = leads_tall ? tall : small;
        const Skeleton& follow = leads_tall ? small : tall;
        const CoupleGrips grips(lead, follow);
        for (const float ahead : {0.5F, 0.65F, 0.75F}) {
            Two two = couple(0.0F, ahead);
            const WorldPose lead_world = world_pose(lead, two.lead);
            const WorldPose follow_world = world_pose(follow, two.follow);
            grips.hold(only(Grip::left_right, 1.0F),
                       false,
                       lead_world,
                       follow_world,
                       two.lead,
                       two.follow);
            EXPECT_LT(glm::distance(palm_of(world_pose(lead, two.lead), Side::left),
                                    palm_of(world_pose(follow, two.follow), Side::right)),
                      0.04F)
                << leads_tall << " " << ahead;
        }
    }
}

TEST(CoupleGrips, nothing_held_changes_nothing_and_a_little_changes_little) {
    const Two free = couple(0.1F, 0.7F);
    const Two same = held(free, GripWeights{}, false);
    for (std::size_t i = 0; i < kBoneCount; ++i) {
        EXPECT_EQ(same.lead.local_rotations[i], free.lead.local_rotations[i]);
    }
    const Two little = held(free, only(Grip::left_right, 1e-3F), false);
    for (std::size_t i = 0; i < kBoneCount; ++i) {
        EXPECT_GT(std::abs(glm::dot(little.lead.local_rotations[i], free.lead.local_rotations[i])),
                  0.9999F)
            << i;
    }
}

TEST(CoupleGrips, other_arms_legs_and_trunk_stay) {
    const Two free = couple(0.1F, 0.7F);
    const Two two = held(free, only(Grip::left_right, 1.0F), false);
    for (const Bone bone : {Bone::hips,
                            Bone::upper_chest,
                            Bone::right_upper_arm,
                            Bone::left_foot,
                            Bone::left_shoulder}) {
        EXPECT_EQ(two.lead.rotation(bone), free.lead.rotation(bone));
    }
    EXPECT_EQ(two.follow.rotation(Bone::left_lower_arm),
              free.follow.rotation(Bone::left_lower_arm));
}

TEST(CoupleGrips, the_closed_frame_is_at_the_height_of_the_shoulders_and_steadier_than_they) {
    GripWeights all{};
    all[index_of(Grip::left_right)] = all[index_of(Grip::back)] = all[index_of(Grip::arm)] = 1.0F;
    const auto height = [&](float sunk) {
        Two two = couple(-0.08F, 0.48F);
        two.lead.hips_position.y -= sunk;
        two.follow.hips_position.y -= sunk;
        two = held(two, all, true);
        const WorldPose lead = world_pose(mannequin_skeleton(), two.lead);
        const WorldPose follow = world_pose(mannequin_skeleton(), two.follow);
        EXPECT_LT(between_palms(two, Side::left, Side::right), 0.04F);
        // His palm lies on her back, behind her and on her left.
        const glm::vec3 hand = glm::conjugate(follow.rotation(Bone::upper_chest)) *
                               (palm_of(lead, Side::right) - follow.position(Bone::upper_chest));
        EXPECT_LT(hand.z, 0.05F);
        EXPECT_GT(hand.x, 0.0F);
        // Hers lies on his upper arm.
        const glm::vec3 arm =
            0.5F * (lead.position(Bone::right_upper_arm) + lead.position(Bone::right_lower_arm));
        EXPECT_LT(glm::distance(palm_of(follow, Side::left), arm), 0.12F);
        return palm_of(lead, Side::left).y;
    };
    const float standing_height = height(0.0F);
    EXPECT_NEAR(standing_height, 1.36F, 0.1F);
    EXPECT_NEAR(standing_height - height(0.1F), 0.03F, 0.01F);
}

TEST(CoupleGrips, are_comfortable_before_one_another_and_not_behind_or_far_apart) {
    const CoupleGrips grips(mannequin_skeleton(), mannequin_skeleton());
    const auto comfort = [&](const Two& two) {
        return grips.comfort(
            world_pose(mannequin_skeleton(), two.lead),
            world_pose(mannequin_skeleton(), two.follow))[index_of(Grip::left_right)];
    };
    EXPECT_GT(comfort(couple(0.0F, 0.7F)), 0.9F);
    EXPECT_EQ(comfort(couple(0.0F, 1.6F)), 0.0F);
    EXPECT_LT(comfort({standing({}, kHalfTurn), standing({0.0F, 0.0F, 0.7F}, 0.0F)}), 0.2F)
        << "back to back";
}

TEST(CoupleGrips, heads_turn_to_the_partner_who_is_seen_and_not_to_one_behind) {
    const auto ahead = [](const Pose& pose) {
        return world_pose(mannequin_skeleton(), pose).rotation(Bone::head) * glm::vec3(0, 0, 1);
    };
    const auto looked = [](Two two) {
        look_at_one_another(1.0F,
                            world_pose(mannequin_skeleton(), two.lead),
                            world_pose(mannequin_skeleton(), two.follow),
                            two.lead,
                            two.follow);
        return two;
    };
    const Two aside = looked(couple(0.4F, 0.6F));
    const glm::vec3 to = glm::normalize(glm::vec3(0.4F, 0.0F, 0.6F));
    EXPECT_GT(glm::dot(ahead(aside.lead), to), 0.97F);
    EXPECT_GT(glm::dot(ahead(aside.follow), -to), 0.97F);
    const Two behind = looked({standing({}, kHalfTurn), standing({0.0F, 0.0F, 0.7F}, 0.0F)});
    EXPECT_GT(glm::dot(ahead(behind.lead), glm::vec3(0, 0, -1)), 0.99F);
}

}  // namespace
}  // namespace raks::motion
