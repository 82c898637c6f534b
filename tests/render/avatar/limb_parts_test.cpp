// Limbs that are one rigid part: the joints that they get, and how they follow them.
#include "render/avatar/limb_parts.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/random.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace {

using namespace raks;
using namespace raks::render;
using motion::Bone;
using motion::index_of;

/// A body of trunk and four limbs, each a stick of flesh from its joint on.
struct PartBody {
    std::vector<FleshPoint> flesh;
    BonePlaces bones;
};

PartBody part_body() {
    PartBody body;
    const auto add = [&body](Bone bone, const glm::vec3& joint, const glm::vec3& end) {
        body.bones.places[index_of(bone)] = joint;
        body.bones.is_there[index_of(bone)] = true;
        for (int i = 0; i <= 20; ++i) {
            const float share = static_cast<float>(i) / 20.0F;
            body.flesh.push_back({glm::mix(joint, end, share), index_of(bone)});
        }
    };
    add(Bone::hips, {0, 0.9F, 0}, {0, 1.0F, 0});
    add(Bone::spine, {0, 1.0F, 0}, {0, 1.7F, 0});
    add(Bone::left_upper_leg, {0.1F, 0.9F, 0}, {0.1F, 0, 0});
    add(Bone::right_upper_leg, {-0.1F, 0.9F, 0}, {-0.1F, 0, 0});
    add(Bone::left_upper_arm, {0.2F, 1.4F, 0}, {0.8F, 1.4F, 0});
    add(Bone::right_upper_arm, {-0.2F, 1.4F, 0}, {-0.8F, 1.4F, 0});
    return body;
}

TEST(LimbParts, get_joints_in_their_middle_and_near_their_end) {
    PartBody body = part_body();
    add_lacking_joints(body.flesh, body.bones);
    const auto place = [&body](Bone bone) { return body.bones.places[index_of(bone)]; };
    EXPECT_NEAR(place(Bone::left_lower_leg).y, 0.495F, 1e-5F);
    EXPECT_NEAR(place(Bone::left_foot).y, 0.09F, 1e-5F);
    EXPECT_NEAR(place(Bone::right_lower_arm).x, -0.44F, 1e-5F);
    EXPECT_NEAR(place(Bone::right_hand).x, -0.68F, 1e-5F);
    EXPECT_NEAR(place(Bone::head).y, 1.42F, 1e-5F);
    for (const LimbBones& limb : kLimbs) {
        EXPECT_FALSE(is_one_part(limb, body.bones.is_there));
    }
    // Every point is of the bone that it lies at; none got lost.
    EXPECT_EQ(body.flesh.size(), part_body().flesh.size());
    for (const FleshPoint& point : body.flesh) {
        if (point.bone == index_of(Bone::left_foot)) {
            EXPECT_LE(point.place.y, 0.09F + 1e-5F);
        }
    }
    const MeasuredBody measured = measure_body(body.flesh, body.bones);
    EXPECT_NEAR(measured.soles, 0.0F, 1e-5F);
    EXPECT_NEAR(measured.height, 1.7F, 1e-5F);
}

TEST(LimbParts, that_have_their_joints_are_left_alone) {
    PartBody body = part_body();
    body.bones.is_there[index_of(Bone::left_lower_leg)] = true;
    body.bones.places[index_of(Bone::left_lower_leg)] = {0.1F, 0.4F, 0.0F};
    add_lacking_joints(body.flesh, body.bones);
    EXPECT_FALSE(body.bones.is_there[index_of(Bone::left_foot)]);
    EXPECT_EQ(body.bones.places[index_of(Bone::left_lower_leg)].y, 0.4F);
}

TEST(LimbParts, of_an_arm_that_ends_with_its_forearm_have_a_wrist) {
    PartBody body = part_body();
    const auto elbow = index_of(Bone::left_lower_arm);
    body.bones.is_there[elbow] = true;
    body.bones.places[elbow] = {0.5F, 1.4F, 0.0F};
    for (FleshPoint& point : body.flesh) {
        const bool is_beyond = point.bone == index_of(Bone::left_upper_arm) && point.place.x > 0.5F;
        point.bone = is_beyond ? elbow : point.bone;
    }
    add_lacking_joints(body.flesh, body.bones);
    EXPECT_TRUE(body.bones.is_there[index_of(Bone::left_hand)]);
    EXPECT_NEAR(body.bones.places[index_of(Bone::left_hand)].x, 0.5F + 0.58F * 0.3F, 1e-5F);
    for (const FleshPoint& point : body.flesh) {
        if (point.bone == index_of(Bone::left_hand)) {
            EXPECT_GT(point.place.x, 0.67F);
        }
    }
}

TEST(LimbParts, point_where_the_end_of_a_bent_limb_is) {
    const CounterRandom random(3);
    for (std::uint64_t i = 0; i < 200; ++i) {
        const auto draw = [&](std::uint64_t k) {
            return static_cast<float>(random.below(4 * i + k, 2'001)) / 1'000.0F - 1.0F;
        };
        motion::Pose pose;
        for (const LimbBones& limb : kLimbs) {
            pose.rotation(limb.lower) = glm::angleAxis(
                2.5F * draw(0), glm::normalize(glm::vec3(draw(1), draw(2), draw(3) + 0.001F)));
            const bool is_leg = limb.end == Bone::left_foot || limb.end == Bone::right_foot;
            const bool is_left = limb.upper < Bone::right_upper_leg;
            const glm::vec3 straight =
                is_leg ? glm::vec3(0, -1, 0) : glm::vec3(is_left ? 1 : -1, 0, 0);
            const glm::vec3 end = straight + pose.rotation(limb.lower) * straight;
            const glm::vec3 way = swing_of_part(limb, pose) * straight;
            EXPECT_GT(glm::dot(way, glm::normalize(end)), 1.0F - 1e-5F);
        }
    }
    motion::Pose straight;
    EXPECT_GT(swing_of_part(kLimbs[0], straight).w, 1.0F - 1e-6F);
    motion::Pose folded;
    folded.rotation(Bone::left_lower_leg) =
        glm::angleAxis(glm::pi<float>(), glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_GT(swing_of_part(kLimbs[0], folded).w, 1.0F - 1e-6F);
}

}  // namespace
