#include <algorithm>
#include <cmath>
#include <string>

#include "render/mannequin/body_field.hpp"
#include "render/mannequin/test_poses.hpp"
#include "tests/render/avatar/posed_mesh.hpp"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace raks::render::test {
namespace {

using motion::Bone;
using motion::Pose;

Pose rolled(Bone bone, float degrees) {
    Pose pose;
    pose.rotation(bone) = glm::angleAxis(glm::radians(degrees), glm::vec3{1.0F, 0.0F, 0.0F});
    return pose;
}

/// Mean distance from the axis of each ring of skin between two joints of the left arm, posed to
/// T-pose, the smallest over all rings.
float smallest_ring_ratio(Bone from, Bone to, float past_end, const Pose& pose) {
    constexpr std::size_t kRings = 12;
    const auto world = motion::world_pose(mannequin().skeleton, Pose{});
    const glm::vec3 start = world.position(from);
    const glm::vec3 end = world.position(to);
    const glm::vec3 along = glm::normalize(end - start);
    const float length = glm::length(end - start) + past_end;

    const std::vector<glm::vec3> rest = posed(Pose{});
    const std::vector<glm::vec3> moved = posed(pose);
    std::array<float, kRings> rest_sum{};
    std::array<float, kRings> moved_sum{};
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const glm::vec3 d = rest[i] - start;
        const float t = glm::dot(d, along) / length;
        const float off_axis = glm::length(d - along * glm::dot(d, along));
        if (t < 0.0F || t >= 1.0F || off_axis > 0.07F) {
            continue;
        }
        const auto ring = static_cast<std::size_t>(t * kRings);
        const glm::vec3 m = moved[i] - start;
        rest_sum[ring] += off_axis;
        moved_sum[ring] += glm::length(m - along * glm::dot(m, along));
    }
    float smallest = 1.0F;
    for (std::size_t ring = 0; ring < kRings; ++ring) {
        EXPECT_GT(rest_sum[ring], 0.0F);
        smallest = std::min(smallest, moved_sum[ring] / rest_sum[ring]);
    }
    return smallest;
}

TEST(MannequinSkin, weights_are_at_most_four_that_sum_to_255) {
    for (const AvatarVertex& vertex : mannequin().vertices) {
        int sum = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            sum += vertex.weights[k];
            ASSERT_LT(vertex.joints[k], kPaletteSize);
        }
        ASSERT_EQ(sum, 255);
        ASSERT_TRUE(std::is_sorted(vertex.weights.rbegin(), vertex.weights.rend()));
    }
}

TEST(MannequinSkin, fingers_move_only_their_own_skin) {
    struct Finger {
        std::string_view name;
        Group group;
    };
    constexpr std::array kFingers = {Finger{"Thumb", Group::thumb},
                                     Finger{"Index", Group::index},
                                     Finger{"Middle", Group::middle},
                                     Finger{"Ring", Group::ring},
                                     Finger{"Little", Group::little}};
    constexpr float kOwnSkin = 0.012F;  // metres from the finger's own surface
    constexpr float kTraces = 0.020F;   // that smoothing carries into the palm: 5 % at most
    const BodyField field(BindFrames(mannequin().skeleton, mannequin().bind_pose));
    std::size_t finger_weights = 0;
    for (std::size_t i = 0; i < mannequin().vertices.size(); ++i) {
        const AvatarVertex& vertex = mannequin().vertices[i];
        for (const Finger& finger : kFingers) {
            const float share = share_of(vertex, [&](std::size_t joint) {
                return joint_name(joint).find(finger.name) != std::string_view::npos;
            });
            if (share == 0.0F) {
                continue;
            }
            ++finger_weights;
            const float away = field.finger(finger.group, bind_position(i));
            ASSERT_LE(away, share > 0.05F ? kOwnSkin : kTraces) << finger.name << ' ' << share;
        }
    }
    EXPECT_GT(finger_weights, 2000U);
}

TEST(MannequinSkin, curling_one_finger_leaves_the_tips_of_the_others) {
    constexpr std::array kTips = {Bone::left_index_distal,
                                  Bone::left_middle_distal,
                                  Bone::left_ring_distal,
                                  Bone::left_little_distal};
    const std::vector<glm::vec3> rest = posed(Pose{});
    for (const Bone curled : kTips) {
        Pose pose;
        for (int joint = 0; joint < 3; ++joint) {
            const auto bone = static_cast<Bone>(static_cast<int>(curled) - joint);
            pose.rotation(bone) = glm::angleAxis(glm::radians(70.0F), glm::vec3{0.0F, 0.0F, -1.0F});
        }
        const std::vector<glm::vec3> moved = posed(pose);
        for (std::size_t i = 0; i < rest.size(); ++i) {
            for (const Bone other : kTips) {
                const float own = share_of(mannequin().vertices[i], [&](std::size_t joint) {
                    return joint == motion::index_of(other);
                });
                if (other != curled && own > 0.9F) {
                    ASSERT_LT(glm::length(moved[i] - rest[i]), 1e-4F);
                }
            }
        }
    }
}

TEST(MannequinSkin, joints_of_one_side_hold_nothing_far_on_the_other) {
    for (std::size_t i = 0; i < mannequin().vertices.size(); ++i) {
        const float x = bind_position(i).x;
        const float left = share_of(mannequin().vertices[i], [](std::size_t joint) {
            return joint_name(joint).substr(0, 4) == "left";
        });
        if (x < -0.02F) {
            ASSERT_EQ(left, 0.0F) << x;
        }
    }
}

TEST(MannequinSkin, the_wrist_keeps_its_girth_when_the_hand_rolls_by_120_degrees) {
    for (const float degrees : {120.0F, -120.0F}) {
        const float ratio = smallest_ring_ratio(
            Bone::left_lower_arm, Bone::left_hand, 0.01F, rolled(Bone::left_hand, degrees));
        RecordProperty("wrist_ring_ratio_120", std::to_string(ratio));
        EXPECT_GE(ratio, 0.85F) << degrees;
    }
}

TEST(MannequinSkin, the_upper_arm_keeps_its_girth_when_it_rolls) {
    EXPECT_GE(smallest_ring_ratio(Bone::left_upper_arm,
                                  Bone::left_lower_arm,
                                  -0.02F,
                                  rolled(Bone::left_upper_arm, 90.0F)),
              0.90F);
    EXPECT_GE(smallest_ring_ratio(Bone::left_upper_arm,
                                  Bone::left_lower_arm,
                                  -0.02F,
                                  rolled(Bone::left_upper_arm, 150.0F)),
              0.75F);
}

TEST(MannequinSkin, the_body_keeps_its_volume_in_every_test_pose) {
    std::vector<glm::vec3> bind;
    for (std::size_t i = 0; i < mannequin().vertices.size(); ++i) {
        bind.push_back(bind_position(i));
    }
    const double whole = volume_of(bind);
    for (const NamedPose& named : mannequin_test_poses()) {
        EXPECT_NEAR(volume_of(posed(named.pose)) / whole, 1.0, 0.04) << named.name;
    }
}

TEST(MannequinSkin, both_feet_stand_on_the_floor_in_standing_poses) {
    for (const std::string_view name : {"T", "down", "over", "bind", "twist"}) {
        const std::vector<glm::vec3> positions = posed(mannequin_test_pose(name));
        std::array<float, 2> lowest = {9.0F, 9.0F};
        for (const glm::vec3& p : positions) {
            float& side = lowest[p.x > 0.0F ? 0 : 1];
            side = std::min(side, p.y);
        }
        EXPECT_NEAR(lowest[0], lowest[1], 0.005F) << name;
    }
}

TEST(MannequinSkin, in_t_pose_the_sole_is_where_the_skeleton_says) {
    Pose pose;
    pose.hips_position = {0.0F, mannequin().skeleton.hips_height(), 0.0F};
    const std::vector<glm::vec3> positions = posed(pose);
    float lowest = 9.0F;
    for (const glm::vec3& p : positions) {
        lowest = std::min(lowest, p.y);
    }
    EXPECT_NEAR(lowest, 0.0F, 0.005F);
}

}  // namespace
}  // namespace raks::render::test
