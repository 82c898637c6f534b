// SMPL parameters in the forms in which others write them, and a clip of ours there and back.
#include "motion/skeleton/formats/smpl.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "base/file.hpp"
#include "motion/skeleton/body/body_finder.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "motion/skeleton/formats/motion_file.hpp"
#include "tests/motion/skeleton/formats/motion_writers.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::motion::smpl_test {
namespace {

constexpr double kQuarter = 1.5707963267948966;

// Two frames of zeros but for a quarter turn of the left lower arm in the second, about y.
NumberArray turns(std::size_t joints, bool is_flat) {
    NumberArray array{
        is_flat ? std::vector<std::size_t>{2, 3 * joints} : std::vector<std::size_t>{2, joints, 3},
        std::vector<double>(6 * joints, 0.0)};
    array.values[3 * (joints + 18) + 1] = kQuarter;
    return array;
}

Expected<MotionClip> clip_of(const NumberArrays& arrays) {
    NpzContent content{arrays, {}};
    for (const auto& [name, array] : arrays) {
        content.names.push_back(name);
    }
    return smpl_clip(content, std::nullopt);
}
std::string message(const Expected<MotionClip>& clip) {
    return clip ? "read" : clip.error().message;
}

TEST(Smpl, every_form_is_the_same_motion) {
    const NumberArray trans = {{2, 3}, {0.0, 0.9, 0.0, 0.25, 0.5, -1.0}};
    const NumberArray rate = {{}, {60.0}};
    // The root and the body apart: as the whole without its first joint.
    NumberArray body = turns(24, true);
    NumberArray part{{2, 69}, {}};
    for (std::size_t frame = 0; frame < 2; ++frame) {
        const auto begin = body.values.begin() + static_cast<std::ptrdiff_t>(72 * frame + 3);
        part.values.insert(part.values.end(), begin, begin + 69);
    }
    NumberArray large = trans;
    for (double& value : large.values) {
        value *= 93.5;
    }
    const NumberArrays forms[] = {
        {{"poses", turns(24, true)}, {"trans", trans}, {"fps", rate}},
        {{"poses", turns(24, false)}, {"transl", trans}, {"fps", {{1}, {60.0}}}},
        {{"poses", turns(52, true)}, {"trans", trans}, {"mocap_framerate", rate}},
        {{"poses", turns(55, true)}, {"trans", trans}, {"mocap_frame_rate", rate}},
        {{"smpl_poses", turns(24, true)},
         {"smpl_trans", large},
         {"smpl_scaling", {{1}, {93.5}}},
         {"fps", rate}},
        {{"global_orient", {{2, 3}, std::vector<double>(6, 0.0)}},
         {"body_pose", part},
         {"transl", trans},
         {"fps", rate}},
    };
    for (const NumberArrays& form : forms) {
        const auto clip = clip_of(form);
        ASSERT_TRUE(clip) << message(clip);
        EXPECT_EQ(clip->frame_count, 2U);
        EXPECT_EQ(clip->frames_per_second, 60.0);
        EXPECT_EQ(clip->metres_per_unit, 1.0);
        EXPECT_NEAR(glm::length(clip->position(1, 0) - glm::dvec3(0.25, 0.5, -1.0)), 0.0, 1e-12);
        // About y the forearm, which points along +x, turns to -z.
        const ClipWorldPose world = world_pose(*clip, 1);
        const glm::dvec3 forearm = world.positions[20] - world.positions[18];
        EXPECT_NEAR(
            glm::length(forearm - glm::dvec3(-0.00737473, 0.01269811, -0.26570925)), 0.0, 1e-9);
    }
}

TEST(Smpl, the_body_is_as_tall_as_a_person) {
    const auto clip = clip_of({{"poses", turns(22, true)}, {"fps", {{}, {30.0}}}});
    ASSERT_TRUE(clip) << message(clip);
    // With 22 joints the hands end their arms.
    EXPECT_EQ(clip->joints[20].end_site, smpl_joints()[22].offset);
    // From the crown to the toes, which lie 3 cm over the soles.
    const std::vector<glm::dvec3> rest = rest_positions(*clip);
    EXPECT_NEAR((rest[15] + *clip->joints[15].end_site - rest[10]).y, kSmplHeight - 0.03, 0.005);
}

TEST(Smpl, what_is_left_out_is_said) {
    const auto clip = clip_of({{"poses", turns(52, true)},
                               {"betas", {{10}, std::vector<double>(10)}},
                               {"fps", {{}, {30.0}}}});
    ASSERT_TRUE(clip) << message(clip);
    ASSERT_EQ(clip->warnings.size(), 3U);
    EXPECT_EQ(clip->warnings[0], "turns of the fingers and the face are left out");
    EXPECT_EQ(clip->warnings[1], "holds no translation: the body turns in one place");
    EXPECT_EQ(clip->warnings[2],
              "the person's own shape (betas) is left out: a mean body of 1.77 m");
}

TEST(Smpl, what_is_no_motion_of_smpl_is_refused_with_the_shape) {
    const NumberArray rate = {{}, {30.0}};
    NumberArray bad = turns(24, true);
    bad.values[100] = std::nan("");
    const struct {
        NumberArrays arrays;
        const char* part;
    } rows[] = {
        {{{"joints", rate}, {"x", rate}}, "holds no SMPL poses"},
        {{{"joints", rate}, {"x", rate}}, "it holds joints, x"},
        {{}, "it holds no arrays"},
        {{{"poses", turns(30, true)}, {"fps", rate}}, "(2, 90): 30 joints"},
        {{{"poses", {{2, 24, 3, 3}, std::vector<double>(432)}}, {"fps", rate}}, "(2, 24, 3, 3)"},
        {{{"poses", {{72}, std::vector<double>(72)}}, {"fps", rate}}, "(72,)"},
        {{{"poses", {{0, 72}, {}}}, {"fps", rate}}, "has no frames"},
        {{{"poses", turns(24, true)}, {"fps", {{}, {0.0}}}}, "fps is 0"},
        {{{"poses", turns(24, true)}, {"fps", {{2}, {1.0, 2.0}}}}, "fps has the shape (2,)"},
        {{{"poses", turns(24, true)}, {"fps", rate}, {"trans", {{3, 3}, std::vector<double>(9)}}},
         "trans has the shape (3, 3); it must be (2, 3)"},
        {{{"poses", bad}, {"fps", rate}}, "poses: frame 1 holds nan"},
        {{{"body_pose", turns(23, true)},
          {"global_orient", {{3, 3}, std::vector<double>(9)}},
          {"fps", rate}},
         "must be one turn a frame"},
    };
    for (const auto& row : rows) {
        const std::string said = message(clip_of(row.arrays));
        EXPECT_NE(said.find(row.part), std::string::npos) << said;
    }
}

// Poses of ours, written as BVH and from there as SMPL, turn every joint as they did.
TEST(Smpl, a_clip_of_ours_comes_back_from_npz_and_json) {
    std::vector<Pose> poses(4);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const float angle = 0.4F * static_cast<float>(i + 1);
        poses[i].hips_position = {0.1F * angle, 0.93F, -0.2F};
        poses[i].rotation(Bone::hips) =
            glm::angleAxis(2.0F * angle, glm::normalize(glm::vec3(0.1F, 1.0F, 0.2F)));
        poses[i].rotation(Bone::left_upper_arm) = glm::angleAxis(-angle, glm::vec3(0, 0, 1));
        poses[i].rotation(Bone::right_lower_leg) = glm::angleAxis(angle, glm::vec3(1, 0, 0));
        poses[i].rotation(Bone::head) = glm::angleAxis(0.5F * angle, glm::vec3(0, 1, 0));
    }
    const raks::test::TemporaryFolder folder;
    ASSERT_TRUE(write_bvh(folder / "x.bvh", mannequin_skeleton(), poses, 50.0));
    const auto ours = read_bvh(folder / "x.bvh");
    ASSERT_TRUE(ours);
    const NumberArrays arrays = raks::test::smpl_arrays(*ours);
    for (const std::string& bytes : {raks::test::npz_bytes(arrays, raks::test::Packing::deflated),
                                     raks::test::json_text(arrays)}) {
        const auto file = parse_motion(bytes, {"x.npz", ""}, {});
        ASSERT_TRUE(file) << file.error().message;
        const MotionClip& clip = std::get<MotionClip>(*file);
        ASSERT_EQ(clip.frame_count, poses.size());
        const auto body = find_body(clip);
        ASSERT_TRUE(body) << body.error().message;
        EXPECT_EQ(body->rest.kind, RestKind::t_pose) << "whatever its bones' directions";
        EXPECT_NEAR(clip.frames_per_second, 50.0, 1e-6);
        for (std::size_t frame = 0; frame < poses.size(); ++frame) {
            const ClipWorldPose world = world_pose(clip, frame);
            const ClipWorldPose truth = world_pose(*ours, frame);
            for (std::size_t j = 0; j < 22; ++j) {
                const auto same = std::find_if(
                    ours->joints.begin(), ours->joints.end(), [&](const ClipJoint& joint) {
                        return joint.name == clip.joints[j].name;
                    });
                ASSERT_NE(same, ours->joints.end()) << clip.joints[j].name;
                const auto index = static_cast<std::size_t>(same - ours->joints.begin());
                EXPECT_NEAR(
                    std::abs(glm::dot(world.rotations[j], truth.rotations[index])), 1.0, 1e-9)
                    << clip.joints[j].name;
            }
        }
    }
}

}  // namespace
}  // namespace raks::motion::smpl_test
