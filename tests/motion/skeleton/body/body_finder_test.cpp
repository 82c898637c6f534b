#include "motion/skeleton/body/body_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "motion/skeleton/body/retarget.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "tests/motion/skeleton/clip_variants.hpp"

#include <glm/geometric.hpp>

namespace raks::motion::body_finder_test {
namespace {

/// Fingers and what they hang on: own_dance() has none.
bool is_of_hand(Bone bone) {
    const Bone left = index_of(bone) > index_of(mirrored(bone)) ? mirrored(bone) : bone;
    return left >= Bone::left_thumb_metacarpal && left < Bone::right_upper_leg;
}

/// How far two clips on the mannequin are apart at most.
struct Difference {
    double places = 0.0;     // metres, of any joint
    double rotations = 0.0;  // of any local rotation's numbers
};

Difference difference(const RetargetedClip& a, const RetargetedClip& b) {
    Difference most;
    for (std::size_t frame = 0; frame < a.poses.size(); ++frame) {
        const WorldPose one = world_pose(mannequin_skeleton(), a.poses[frame]);
        const WorldPose other = world_pose(mannequin_skeleton(), b.poses[frame]);
        for (std::size_t i = 0; i < one.positions.size(); ++i) {
            if (is_of_hand(static_cast<Bone>(i))) {
                continue;
            }
            most.places =
                std::max(most.places,
                         static_cast<double>(glm::distance(one.positions[i], other.positions[i])));
            const glm::quat& p = a.poses[frame].local_rotations[i];
            const glm::quat& q = b.poses[frame].local_rotations[i];
            most.rotations =
                std::max(most.rotations,
                         static_cast<double>(std::min(glm::length(p - q), glm::length(p + q))));
        }
    }
    return most;
}

RetargetedClip on_mannequin(const MotionClip& clip) {
    auto poses = retarget(clip, mannequin_skeleton());
    EXPECT_TRUE(poses) << poses.error().message;
    return *poses;
}

// What single precision of poses leaves of a rotation.
constexpr double kRounding = 1e-6;

TEST(FindBody, leaves_a_t_pose_with_y_up_as_it_is) {
    const MotionClip clip = own_dance();
    const auto standing = stand(clip);
    ASSERT_TRUE(standing) << standing.error().message;
    EXPECT_EQ(standing->body.rest.kind, RestKind::t_pose);
    EXPECT_EQ(standing->clip.rotations, clip.rotations) << "same bits";
    EXPECT_EQ(standing->clip.positions, clip.positions);
    EXPECT_TRUE(standing->body.notes().empty());
    EXPECT_NEAR(standing->body.stance.floor, 0.0, 3.0) << "centimetres";
    EXPECT_GT(standing->body.stance.floor_confidence, 0.9);
    EXPECT_GT(standing->body.stance.facing_confidence, 0.9);
}

TEST(FindBody, gives_the_same_poses_for_every_drawn_rest_pose) {
    const RetargetedClip expected = on_mannequin(own_dance());
    for (const RestVariant rest : kRestVariants) {
        SCOPED_TRACE(name_of(rest));
        const Difference off = difference(on_mannequin(with_rest(own_dance(), rest)), expected);
        EXPECT_LT(off.places, 2e-6) << "metres";
        if (rest != RestVariant::first_frame) {
            EXPECT_LT(off.rotations, kRounding);
        }
    }
}

TEST(FindBody, twists_bones_by_the_mildest_motion_where_the_rest_pose_is_a_moment_of_it) {
    const MotionClip clip = with_rest(own_dance(), RestVariant::first_frame);
    const auto body = find_body(clip);
    ASSERT_TRUE(body) << body.error().message;
    EXPECT_EQ(body->rest.kind, RestKind::other);
    EXPECT_LT(body->rest.confidence, 0.8);
    // The T-pose's frames are known here: every guessed twist is within a quarter turn of them, and
    // mostly far nearer.
    double sum = 0.0;
    for (std::size_t b = 0; b < body->rest.bones.size(); ++b) {
        if (const auto joint = body->mapping().joints[b]) {
            const glm::dquat truth = glm::conjugate(world_pose(own_dance(), 0).rotations[*joint]);
            const double cosine = std::abs(glm::dot(body->rest.bones[b], truth));
            const double angle = 2.0 * std::acos(std::min(1.0, cosine));
            EXPECT_LT(angle, 1.2) << kBoneNames[b];
            sum += angle / 22.0;
        }
    }
    EXPECT_LT(sum, 0.35) << "radians, mean";
}

// Rokoko writes a tip of the head that points aside, whatever its joint's frame.
TEST(FindBody, does_not_lay_a_head_on_its_side_by_its_tip) {
    MotionClip clip = with_rest(own_dance(), RestVariant::along_x);
    const RetargetedClip expected = on_mannequin(clip);
    const auto body = find_body(clip);
    ASSERT_TRUE(body) << body.error().message;
    ClipJoint& head = clip.joints[*body->mapping().joint(Bone::head)];
    ASSERT_TRUE(head.end_site);
    const glm::dvec3 tip = *head.end_site;
    head.end_site = glm::dvec3(tip.y, tip.z, tip.x);
    const RetargetedClip poses = on_mannequin(clip);
    for (std::size_t frame = 0; frame < poses.poses.size(); ++frame) {
        const glm::vec3 up(0.0F, 1.0F, 0.0F);
        const auto top = [&](const RetargetedClip& from) {
            return world_pose(mannequin_skeleton(), from.poses[frame]).rotation(Bone::head) * up;
        };
        EXPECT_GT(glm::dot(top(poses), top(expected)), 0.9F) << frame;
    }
}

TEST(FindBody, gives_the_same_poses_whichever_axis_is_up) {
    const RetargetedClip expected = on_mannequin(own_dance());
    for (const glm::dvec3& up : kUpVariants) {
        for (const UpStyle style : {UpStyle::root_only, UpStyle::whole_file}) {
            for (const RestVariant rest : {RestVariant::t_pose, RestVariant::along_x}) {
                const MotionClip clip = with_up(with_rest(own_dance(), rest), up, style);
                SCOPED_TRACE(axis_name(up) + " " + std::string(name_of(rest)));
                const auto body = find_body(clip);
                ASSERT_TRUE(body) << body.error().message;
                EXPECT_EQ(body->up.axis, up);
                const Difference off = difference(on_mannequin(clip), expected);
                EXPECT_LT(off.places, 2e-6);
                EXPECT_LT(off.rotations, kRounding);
            }
        }
    }
}

TEST(FindBody, gives_the_same_poses_in_every_unit) {
    const RetargetedClip expected = on_mannequin(own_dance());
    for (const double unit : kUnitVariants) {
        const MotionClip clip = in_unit(own_dance(), unit);
        SCOPED_TRACE(unit_name(unit));
        const auto body = find_body(clip);
        ASSERT_TRUE(body) << body.error().message;
        EXPECT_EQ(body->size.metres_per_unit, unit);
        EXPECT_NEAR(body->size.height, 1.714, 0.002) << "the mannequin's";
        EXPECT_LT(difference(on_mannequin(clip), expected).places, 2e-6);
    }
}

TEST(FindBody, gives_the_same_poses_under_every_scheme_of_names) {
    const RetargetedClip expected = on_mannequin(own_dance());
    for (const body_test::NamingScheme& scheme : body_test::naming_schemes()) {
        SCOPED_TRACE(scheme.tool);
        EXPECT_EQ(difference(on_mannequin(renamed(own_dance(), scheme)), expected).places, 0.0);
    }
}

// All at once; a part of the product, since the whole of it takes ten seconds. RAKS_ALL_VARIANTS=1
// tries the whole.
TEST(FindBody, gives_the_same_poses_for_all_of_these_together) {
    const RetargetedClip expected = on_mannequin(own_dance());
    // A prime: every kind meets every other.
    const std::size_t every = std::getenv("RAKS_ALL_VARIANTS") != nullptr ? 1 : 61;
    std::size_t number = 0;
    for (const body_test::NamingScheme& scheme : body_test::naming_schemes()) {
        for (const RestVariant rest : kRestVariants) {
            for (const glm::dvec3& up : kUpVariants) {
                for (const double unit : kUnitVariants) {
                    if (number++ % every != 0) {
                        continue;
                    }
                    const UpStyle style =
                        number % 2 == 0 ? UpStyle::root_only : UpStyle::whole_file;
                    const MotionClip clip = renamed(
                        in_unit(with_up(with_rest(own_dance(), rest), up, style), unit), scheme);
                    SCOPED_TRACE(scheme.tool + ", " + std::string(name_of(rest)) + ", " +
                                 axis_name(up) + ", " + unit_name(unit));
                    EXPECT_LT(difference(on_mannequin(clip), expected).places, 2e-6);
                }
            }
        }
    }
    EXPECT_GT(number, 6000U);
}

// A body on its back that does not move but lifts and lowers its legs.
MotionClip lying() {
    MotionClip clip = own_dance();
    const std::size_t joints = clip.joints.size();
    constexpr std::array<std::size_t, 2> kThighs = {14, 18};
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        for (std::size_t j = 1; j < joints; ++j) {
            clip.rotations[frame * joints + j] = glm::dquat(1.0, 0.0, 0.0, 0.0);
        }
        for (const std::size_t thigh : kThighs) {
            const double lift = 0.9 + 0.5 * std::sin(0.3 * static_cast<double>(frame * thigh));
            clip.rotations[frame * joints + thigh] =
                glm::angleAxis(-lift, glm::dvec3(1.0, 0.0, 0.0));
        }
        // The face up: what was ahead is up.
        clip.rotations[frame * joints] = turn_to_y({0.0, 0.0, 1.0});
        clip.positions[frame * joints] = {0.0, 10.0, 0.0};
    }
    return clip;
}

TEST(FindBody, does_not_stand_up_a_body_that_lies) {
    const MotionClip clip = lying();
    const auto body = find_body(clip);
    ASSERT_TRUE(body) << body.error().message;
    EXPECT_EQ(body->up.axis, glm::dvec3(0.0, 1.0, 0.0)) << body->up.reason;
    EXPECT_LT(body->up.confidence, 0.6);
    ASSERT_FALSE(body->notes().empty());
    EXPECT_NE(body->notes().front().find("--up sets it"), std::string::npos)
        << body->notes().front();
}

TEST(FindBody, takes_what_a_person_says) {
    BodyOptions options;
    options.up = glm::dvec3(1.0, 0.0, 0.0);
    options.height = 1.5;
    const auto body = find_body(own_dance(), options);
    ASSERT_TRUE(body) << body.error().message;
    EXPECT_EQ(body->up.axis, *options.up);
    EXPECT_DOUBLE_EQ(body->size.height, 1.5);
    EXPECT_NEAR(body->size.metres_per_unit, 0.01 * 1.5 / 1.714, 1e-5);
    options.metres_per_unit = 0.02;
    EXPECT_EQ(find_body(own_dance(), options)->size.metres_per_unit, 0.02);
}

TEST(FindBody, refuses_a_clip_without_frames) {
    MotionClip clip = own_dance();
    clip.frame_count = 0;
    const auto body = find_body(clip);
    ASSERT_FALSE(body);
    EXPECT_EQ(body.error().message, "has no frames");
}

TEST(ReadAxis, knows_six_axes) {
    EXPECT_EQ(read_axis("z").value(), glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_EQ(read_axis("-x").value(), glm::dvec3(-1.0, 0.0, 0.0));
    EXPECT_EQ(read_axis("w").error().message, "\"w\" is not an axis; known: x, y, z, -x, -y, -z");
    for (const std::string name : {"+x", "+y", "+z", "-x", "-y", "-z"}) {
        const glm::dvec3 axis = read_axis(name).value();
        EXPECT_EQ(axis_name(axis), name);
        EXPECT_LT(glm::distance(turn_to_y(axis) * axis, glm::dvec3(0.0, 1.0, 0.0)), 1e-15) << name;
    }
}

TEST(ReadUnit, knows_six_units) {
    EXPECT_EQ(read_unit("in").value(), 0.0254);
    EXPECT_EQ(unit_name(0.3048), "ft");
    EXPECT_EQ(unit_name(0.05644), "0.05644 m");
    EXPECT_EQ(read_unit("km").error().message,
              "\"km\" is not a unit; known: m, dm, cm, mm, in, ft");
}

// The whole body up and down on parabolas, half a second in the air of each second.
TEST(FindSize, takes_a_unit_from_free_fall_where_none_is_usual) {
    constexpr double kOdd =
        0.042;  // metres a unit: too large a body in dm and CMU units, too small in inches
    MotionClip clip = in_unit(own_dance(), kOdd);
    clip.frames_per_second = 60.0;
    const std::size_t joints = clip.joints.size();
    MotionClip jumps = clip;
    jumps.frame_count = 240;
    jumps.positions.clear();
    jumps.rotations.clear();
    for (std::size_t frame = 0; frame < jumps.frame_count; ++frame) {
        // The same posture throughout, so that the middle of the body is what flies.
        for (std::size_t j = 0; j < joints; ++j) {
            jumps.positions.push_back(clip.position(0, j));
            jumps.rotations.push_back(clip.rotation(0, j));
        }
        const double time = std::fmod(static_cast<double>(frame) / 60.0, 1.0) - 0.75;
        const double height = std::max(0.0, 0.5 * 9.81 * (0.25 * 0.25 - time * time));
        jumps.positions[frame * joints].y += height / kOdd;
    }
    const auto body = find_body(jumps);
    ASSERT_TRUE(body) << body.error().message;
    EXPECT_NEAR(body->size.metres_per_unit, kOdd, 0.03 * kOdd);
    EXPECT_NEAR(body->size.height, 1.714, 0.05);
    // Without jumps: the usual height, and it is said.
    const auto standing = find_body(clip);
    EXPECT_EQ(standing->size.height, 1.7);
    EXPECT_NE(standing->notes().back().find("--unit, --height or --scale sets it"),
              std::string::npos);
}

}  // namespace
}  // namespace raks::motion::body_finder_test
