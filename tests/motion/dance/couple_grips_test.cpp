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
Two held(Two two, const GripWeights& weights, const ClosedFrame* frame) {
    const CoupleGrips grips(mannequin_skeleton(), mannequin_skeleton());
    const WorldPose lead = world_pose(mannequin_skeleton(), two.lead);
    const WorldPose follow = world_pose(mannequin_skeleton(), two.follow);
    grips.hold(weights, frame, lead, follow, two.lead, two.follow);
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
                        held(couple(aside, ahead), only(palms(lead, follow), 1.0F), nullptr);
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
                       nullptr,
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
    const Two same = held(free, GripWeights{}, nullptr);
    for (std::size_t i = 0; i < kBoneCount; ++i) {
        EXPECT_EQ(same.lead.local_rotations[i], free.lead.local_rotations[i]);
    }
    const Two little = held(free, only(Grip::left_right, 1e-3F), nullptr);
    for (std::size_t i = 0; i < kBoneCount; ++i) {
        EXPECT_GT(std::abs(glm::dot(little.lead.local_rotations[i], free.lead.local_rotations[i])),
                  0.9999F)
            << i;
    }
}

TEST(CoupleGrips, other_arms_legs_and_trunk_stay) {
    const Two free = couple(0.1F, 0.7F);
    const Two two = held(free, only(Grip::left_right, 1.0F), nullptr);
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

GripWeights all_of_frame() {
    GripWeights all{};
    all[index_of(Grip::left_right)] = all[index_of(laid(0, Side::right))] =
        all[index_of(laid(1, Side::left))] = 1.0F;
    return all;
}

TEST(CoupleGrips, the_closed_frame_lays_hands_on_their_contact_points) {
    const ClosedFrame frame;
    for (const float ahead : {0.26F, 0.3F, 0.34F}) {
        const Two two = held(couple(-0.09F, ahead), all_of_frame(), &frame);
        const WorldPose lead = world_pose(mannequin_skeleton(), two.lead);
        const WorldPose follow = world_pose(mannequin_skeleton(), two.follow);
        EXPECT_LT(between_palms(two, Side::left, Side::right), 0.03F);
        const float eyes =
            follow.point(Bone::head, {0.0F, 0.6F * mannequin_skeleton().girth.head_height, 0.0F}).y;
        EXPECT_NEAR(palm_of(lead, Side::left).y, eyes, 0.03F);
        // His palm lies on her back, behind her and on her left: on the shoulder blade.
        const glm::vec3 hand = glm::conjugate(follow.rotation(Bone::upper_chest)) *
                               (palm_of(lead, Side::right) - follow.position(Bone::upper_chest));
        const Girth& girth = mannequin_skeleton().girth;
        EXPECT_NEAR(hand.z, -girth.trunk - girth.hand, 0.03F) << ahead;
        EXPECT_NEAR(hand.x, 1.6F * girth.flank, 0.03F) << ahead;
        // Hers lies on the outside of his upper arm.
        const glm::vec3 arm =
            0.5F * (lead.position(Bone::right_upper_arm) + lead.position(Bone::right_lower_arm));
        EXPECT_NEAR(glm::distance(palm_of(follow, Side::left), arm), 0.06F, 0.03F) << ahead;
    }
}

TEST(CoupleGrips, contact_points_are_those_of_the_frame) {
    ClosedFrame frame;
    frame.laid = {};
    frame.laid[0][static_cast<std::size_t>(Side::right)] = LaidHand{HoldPlace::waist, Side::left};
    frame.laid[1][static_cast<std::size_t>(Side::left)] =
        LaidHand{HoldPlace::shoulder, Side::right};
    const Two two = held(couple(-0.05F, 0.34F), all_of_frame(), &frame);
    const WorldPose lead = world_pose(mannequin_skeleton(), two.lead);
    const WorldPose follow = world_pose(mannequin_skeleton(), two.follow);
    const glm::vec3 hand = glm::conjugate(follow.rotation(Bone::hips)) *
                           (palm_of(lead, Side::right) - follow.position(Bone::hips));
    EXPECT_GT(hand.x, 0.12F);
    EXPECT_LT(std::abs(hand.y), 0.2F);
    EXPECT_LT(glm::distance(palm_of(follow, Side::left), lead.position(Bone::right_upper_arm)),
              0.09F);
    frame.laid = {};
    const Two free = held(couple(-0.05F, 0.34F), only(laid(0, Side::right), 1.0F), &frame);
    EXPECT_EQ(free.lead.rotation(Bone::right_lower_arm),
              couple(-0.05F, 0.34F).lead.rotation(Bone::right_lower_arm))
        << "no contact is no grip";
}

TEST(CoupleGrips, are_comfortable_before_one_another_and_not_behind_or_far_apart) {
    const CoupleGrips grips(mannequin_skeleton(), mannequin_skeleton());
    const auto comfort = [&](const Two& two) {
        return grips.comfort(
            nullptr,
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
        look_at_one_another({1.0F, nullptr},
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
