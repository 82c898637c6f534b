// The partner: where the follow of a couple dances, and whose body arms keep out of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motion/dance/partner_clearance.hpp"
#include "motion/dance/partner_place.hpp"
#include "motion/skeleton/palm.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr float kHalfTurn = 3.14159265F;

/// One who stands with arms ahead.
Pose reaching(const Skeleton& skeleton, float ahead, float heading, float lift) {
    Pose pose;
    pose.hips_position = {0.0F, skeleton.hips_height(), ahead};
    pose.rotation(Bone::hips) = glm::angleAxis(heading, glm::vec3(0, 1, 0));
    for (const Side side : kSides) {
        const float sign = side == Side::left ? 1.0F : -1.0F;
        pose.rotation(on_side(Bone::left_upper_arm, side)) =
            glm::angleAxis(-sign * 1.4F, glm::vec3(0, 1, 0)) *
            glm::angleAxis(sign * lift, glm::vec3(0, 0, 1));
        pose.rotation(on_side(Bone::left_lower_arm, side)) =
            glm::angleAxis(-sign * 0.5F, glm::vec3(0, 1, 0));
    }
    return pose;
}

/// Smallest distance of the skins of hands and their halves of the forearms from trunk and head.
float clearance(const Skeleton& own, const Pose& pose, const Skeleton& other, const Pose& partner) {
    const WorldPose world = world_body(own, pose);
    const BodyCapsules body = body_capsules(other.girth, world_body(other, partner));
    float least = 9.0F;
    for (const Side side : kSides) {
        for (const Capsule& hand : hand_capsules(own.girth, world, side)) {
            for (const std::size_t part : {0U, 4U, 8U}) {
                least = std::min(least, nearness(hand, body[part]).metres);
            }
        }
    }
    return least;
}

TEST(PartnerBody, hands_and_forearms_keep_a_centimetre_off_trunk_and_head) {
    Skeleton big_head = mannequin_skeleton();
    big_head.girth.head *= 1.8F;
    big_head.girth.head_height *= 1.8F;
    for (const Skeleton& other : {mannequin_skeleton(),
                                  scaled(mannequin_skeleton(), 0.8F),
                                  scaled(mannequin_skeleton(), 0.5F),
                                  scaled(mannequin_skeleton(), 1.25F),
                                  big_head}) {
        for (const float lift : {-0.4F, 0.0F, 0.3F}) {
            for (const float ahead : {0.3F, 0.45F, 0.6F}) {
                Pose lead = reaching(mannequin_skeleton(), 0.0F, 0.0F, lift);
                const Pose follow = reaching(other, ahead, kHalfTurn, -1.2F);
                const float before = clearance(mannequin_skeleton(), lead, other, follow);
                const PartnerBody body(other.girth, world_body(other, follow));
                move_arms(mannequin_skeleton(),
                          body.ways_off(mannequin_skeleton(), {0.0F, 0.0F}, lead),
                          lead);
                const float after = clearance(mannequin_skeleton(), lead, other, follow);
                EXPECT_GT(after, std::min(before, 0.0F)) << ahead << " " << lift;
                EXPECT_GT(after, 0.01F) << ahead << " " << lift << " from " << before;
            }
        }
    }
}

TEST(PartnerBody, who_is_far_away_is_left_alone) {
    const Pose free = reaching(mannequin_skeleton(), 0.0F, 0.0F, 0.0F);
    Pose lead = free;
    const Pose follow = reaching(mannequin_skeleton(), 2.0F, kHalfTurn, 0.0F);
    const PartnerBody body(mannequin_skeleton().girth, world_body(mannequin_skeleton(), follow));
    move_arms(mannequin_skeleton(), body.ways_off(mannequin_skeleton(), {0.0F, 0.0F}, lead), lead);
    for (std::size_t i = 0; i < kBoneCount; ++i) {
        EXPECT_EQ(lead.local_rotations[i], free.local_rotations[i]);
    }
}

TEST(PartnerBody, arms_of_any_length_give_numbers) {
    for (const float length : {0.3F, 2.0F}) {
        Skeleton own = mannequin_skeleton();
        for (const Side side : kSides) {
            own.offsets[index_of(on_side(Bone::left_lower_arm, side))] *= length;
            own.offsets[index_of(on_side(Bone::left_hand, side))] *= length;
        }
        Pose lead = reaching(own, 0.0F, 0.0F, 0.0F);
        const Pose follow = reaching(mannequin_skeleton(), 0.4F, kHalfTurn, 0.0F);
        const PartnerBody body(mannequin_skeleton().girth,
                               world_body(mannequin_skeleton(), follow));
        move_arms(own, body.ways_off(own, {0.0F, 0.5F}, lead), lead);
        for (const glm::quat& rotation : lead.local_rotations) {
            EXPECT_NEAR(glm::length(rotation), 1.0F, 1e-3F);
        }
    }
}

TEST(PartnerPlace, brings_her_to_the_place_of_the_hold_without_sliding_feet) {
    ClosedFrame frame;
    frame.hips = glm::dvec2(-0.09, 0.29);
    const Skeleton& skeleton = mannequin_skeleton();
    PartnerPlace place;
    std::array<glm::vec3, 2> stood{};
    std::array<bool, 2> was_standing{};
    Pose shown;
    const Pose lead = reaching(skeleton, 0.0F, 0.0F, 0.0F);
    for (int hop = 0; hop < 300; ++hop) {
        Pose follow = reaching(skeleton, 0.45F, kHalfTurn, 0.0F);
        follow.hips_position.y -= 0.06F;
        const std::size_t swings = (hop / 40) % 2 == 0 ? 0 : 1;
        follow.foot_contact = {swings != 0, swings != 1};
        place.advance(missing_way(&frame, {}, lead, follow), follow);
        shown = follow;
        place.apply(skeleton, shown);
        const WorldPose world = world_body(skeleton, shown);
        for (const Side side : kSides) {
            const auto s = static_cast<std::size_t>(side);
            const glm::vec3 foot = world.position(on_side(Bone::left_foot, side));
            if (follow.foot_contact[s] && was_standing[s]) {
                EXPECT_LT(glm::distance(foot, stood[s]), 0.002F) << hop;
            }
            stood[s] = foot;
            was_standing[s] = follow.foot_contact[s];
        }
    }
    EXPECT_NEAR(shown.hips_position.x, -0.09F, 0.01F);
    EXPECT_NEAR(shown.hips_position.z, 0.29F, 0.01F);
}

TEST(PartnerPlace, two_of_unlike_size_stay_as_far_apart_wherever_they_dance) {
    const CoupleSizes sizes{0.8F, 1.25F};
    Pose lead;
    Pose follow;
    // Danced at (3, 1) and (3, 1.8), then shown at their own sizes.
    lead.hips_position = sizes.lead * glm::vec3(3.0F, 0.9F, 1.0F);
    follow.hips_position = sizes.follow * glm::vec3(3.0F, 0.9F, 1.8F);
    const glm::vec2 way = missing_way(nullptr, sizes, lead, follow);
    EXPECT_NEAR(follow.hips_position.x + way.x - lead.hips_position.x, 0.0F, 1e-5F);
    EXPECT_NEAR(follow.hips_position.z + way.y - lead.hips_position.z, 0.8F * 1.025F, 1e-5F);
    const glm::vec2 none = missing_way(nullptr, {}, Pose(), Pose());
    EXPECT_EQ(none, glm::vec2(0.0F));
}

}  // namespace
}  // namespace raks::motion
