#include "motion/skeleton/formats/bvh.hpp"
#include "motion/skeleton/body/joint_finder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "motion/skeleton/body/joint_finder.hpp"
#include "motion/skeleton/body/retarget.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::motion {
namespace {

namespace fs = std::filesystem;

const fs::path kData = fs::path(RAKS_SOURCE_DIR) / "tests" / "data" / "bvh";

std::string text_of(const std::string& name) { return read_file(kData / name).value(); }

MotionClip clip_of(const std::string& name) {
    auto clip = read_bvh(kData / name);
    EXPECT_TRUE(clip) << clip.error().message;
    return clip ? *clip : MotionClip{};
}

double largest_distance(const MotionClip& a, const MotionClip& b) {
    double largest = 0.0;
    for (std::size_t frame = 0; frame < std::min(a.frame_count, b.frame_count); ++frame) {
        const ClipWorldPose x = world_pose(a, frame);
        const ClipWorldPose y = world_pose(b, frame);
        for (std::size_t i = 0; i < x.positions.size(); ++i) {
            largest = std::max(largest, glm::length(x.positions[i] - y.positions[i]));
        }
    }
    return largest;
}

TEST(Bvh, variations_of_the_text_are_the_same_motion) {
    const MotionClip plain = clip_of("odd/plain.bvh");
    ASSERT_EQ(plain.frame_count, 12U);
    for (const char* name : {"crlf",
                             "cr_only",
                             "tabs",
                             "brace_same_line",
                             "lower_case",
                             "bom",
                             "no_final_newline",
                             "blank_lines",
                             "wrapped_rows",
                             "scientific",
                             "position_order",
                             "rotation_first"}) {
        const MotionClip clip = clip_of(std::string("odd/") + name + ".bvh");
        EXPECT_EQ(clip.frame_count, plain.frame_count) << name;
        EXPECT_LT(largest_distance(clip, plain), 1e-3) << name;
    }
}

TEST(Bvh, world_positions_are_those_of_another_reader) {
    const auto expected = nlohmann::json::parse(text_of("odd/expected.json"));
    for (const auto& [name, truth] : expected.items()) {
        const MotionClip clip = clip_of("odd/" + name);
        const ClipWorldPose world = world_pose(clip, truth["frame"].get<std::size_t>());
        for (std::size_t i = 0; i < truth["world_positions"].size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_NEAR(
                    world.positions[i][axis],
                    truth["world_positions"][i][static_cast<std::size_t>(axis)].get<double>(),
                    1e-3)
                    << name << " joint " << i;
            }
        }
    }
}

TEST(Bvh, wrong_frame_counts_are_warned_of) {
    const MotionClip more = clip_of("odd/more_rows.bvh");
    EXPECT_EQ(more.frame_count, 10U);
    EXPECT_EQ(more.warnings.front(), "2 extra rows after the 10 declared are left out");
    const MotionClip fewer = clip_of("odd/fewer_rows.bvh");
    EXPECT_EQ(fewer.frame_count, 12U);
    EXPECT_EQ(fewer.warnings.front(), "declares 15 frames and has 12");
}

TEST(Bvh, loose_structure_is_read) {
    EXPECT_FALSE(clip_of("odd/no_end_site.bvh").joints.back().end_site);
    EXPECT_EQ(clip_of("odd/two_roots.bvh").warnings.front(), "has 2 roots; all are read");
    EXPECT_EQ(clip_of("odd/one_frame.bvh").frame_count, 1U);
    EXPECT_FALSE(clip_of("odd/duplicate_names.bvh").warnings.empty());
    EXPECT_NEAR(clip_of("odd/frame_time_comma_free.bvh").frames_per_second, 120.0, 0.01);
    EXPECT_NEAR(clip_of("odd/ntsc.bvh").frames_per_second, 23.976, 1e-9);
    EXPECT_EQ(leading_rest_frames(clip_of("odd/tpose_first.bvh")), 1U);
    EXPECT_EQ(leading_rest_frames(clip_of("odd/plain.bvh")), 0U);
    EXPECT_NEAR(guess_metres_per_unit(clip_of("odd/metres_zup.bvh")), 1.0, 1e-9);
    EXPECT_EQ(clip_of("odd/two_joints.bvh").joints.size(), 2U);
}

TEST(Bvh, every_bad_file_is_refused_in_one_line_that_says_why) {
    const std::pair<const char*, const char*> cases[] = {
        {"empty", "is empty"},
        {"binary", "not a BVH"},
        {"html", "not a BVH"},
        {"lfs_pointer", "LFS pointer"},
        {"header_cut", "ends inside the HIERARCHY"},
        {"no_motion", "MOTION is missing"},
        {"no_frames", "Frames is missing"},
        {"row_short", "frame 11 has 25 of 30 values"},
        {"columns_29", "29 values for 30 channels"},
        {"nan", "line"},
        {"nan_row", "frame 5"},
        {"inf", "finite"},
        {"huge_value", "out of range"},
        {"frames_huge", "Frames"},
        {"frames_1e12", "Frames"},
        {"frames_negative", "Frames"},
        {"frame_time_zero", "Frame Time"},
        {"frame_time_negative", "Frame Time"},
        {"frame_time_nan", "Frame Time"},
        {"decimal_comma", "comma"},
        {"unknown_channel", "unknown channel"},
        {"channel_count", "does not match"},
        {"channels_9", "999999999 is out of range"},
        {"unbalanced", "unbalanced"},
        {"extra_brace", "unbalanced"},
        {"offset_two", "OFFSET needs three"},
        {"no_root", "ROOT expected"},
    };
    for (const auto& [name, part] : cases) {
        const auto clip = read_bvh(kData / "bad" / (std::string(name) + ".bvh"));
        ASSERT_FALSE(clip) << name;
        EXPECT_NE(clip.error().message.find(part), std::string::npos)
            << name << ": " << clip.error().message;
        EXPECT_EQ(clip.error().message.find('\n'), std::string::npos) << name;
    }
}

TEST(Bvh, deep_nesting_is_refused_without_a_stack_overflow) {
    std::string text = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n";
    for (int i = 0; i < 5000; ++i) {
        text += "JOINT b\n{\nOFFSET 0 1 0\n";
    }
    EXPECT_FALSE(parse_bvh(text, "deep.bvh"));
}

TEST(Bvh, a_given_rate_wins_over_a_bad_frame_time) {
    const auto clip = read_bvh(kData / "bad" / "frame_time_zero.bvh", {.frames_per_second = 60.0});
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_EQ(clip->frames_per_second, 60.0);
}

TEST(Bvh, mangled_files_end_in_a_clip_or_one_line) {
    const std::string whole = text_of("odd/plain.bvh");
    for (std::size_t size = 0; size < whole.size(); size += 3) {
        const auto clip = parse_bvh(whole.substr(0, size), "cut.bvh");
        if (!clip) {
            EXPECT_EQ(clip.error().message.find('\n'), std::string::npos);
        }
    }
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        const std::string text = raks::test::mangled(whole, {.seed = seed, .bytes = 1 + seed % 4});
        const auto clip = parse_bvh(text, "flip.bvh");
        if (clip) {
            EXPECT_LE(clip->rotations.size(), 1'000'000U);
        }
    }
}

TEST(Bvh, written_poses_read_back) {
    std::vector<Pose> poses(3);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const float angle = 0.3F * static_cast<float>(i + 1);
        poses[i].hips_position = {0.1F * angle, 0.93F, -0.2F};
        poses[i].rotation(Bone::hips) =
            glm::angleAxis(2.0F * angle, glm::normalize(glm::vec3(0.1F, 1.0F, 0.2F)));
        poses[i].rotation(Bone::left_upper_arm) = glm::angleAxis(-angle, glm::vec3(0, 0, 1));
        poses[i].rotation(Bone::right_lower_leg) = glm::angleAxis(angle, glm::vec3(1, 0, 0));
    }
    const raks::test::TemporaryFolder folder;
    const fs::path path = folder / "round_trip.bvh";
    ASSERT_TRUE(write_bvh(path, mannequin_skeleton(), poses, 30.0));
    const auto clip = read_bvh(path);
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_NEAR(clip->frames_per_second, 30.0, 1e-6);
    const auto mapping = find_joints(*clip);
    ASSERT_TRUE(mapping) << mapping.error().message;
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
        const ClipWorldPose read = world_pose(*clip, frame);
        const WorldPose written = world_pose(mannequin_skeleton(), poses[frame]);
        for (const Bone bone : {Bone::hips, Bone::head, Bone::left_hand, Bone::right_foot}) {
            const glm::dvec3 error =
                read.positions[*mapping->mapping.joint(bone)] - glm::dvec3(written.position(bone));
            EXPECT_LT(glm::length(error), 1e-5) << kBoneNames[index_of(bone)];
        }
    }
}

TEST(Bvh, poses_that_cannot_be_written_are_refused) {
    const raks::test::TemporaryFolder folder;
    const fs::path path = folder / "never.bvh";
    EXPECT_FALSE(write_bvh(path, mannequin_skeleton(), {}, 30.0));
    const std::vector<Pose> poses(1);
    EXPECT_FALSE(write_bvh(path, mannequin_skeleton(), poses, 0.0));
    std::vector<Pose> broken(1);
    broken[0].hips_position.x = std::nanf("");
    EXPECT_FALSE(write_bvh(path, mannequin_skeleton(), broken, 30.0));
    EXPECT_FALSE(fs::exists(path));
}

TEST(Humanoid, what_is_no_humanoid_is_said) {
    const auto two = find_joints(clip_of("odd/two_joints.bvh"));
    ASSERT_FALSE(two);
    EXPECT_EQ(two.error().message.rfind("no humanoid: ", 0), 0U) << two.error().message;
}

}  // namespace
}  // namespace raks::motion
