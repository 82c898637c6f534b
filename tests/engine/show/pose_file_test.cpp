#include "engine/show/pose_file.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/geometric.hpp>

namespace raks::engine {
namespace {

using motion::Bone;

constexpr const char* kTwo = R"({
  "poses": {
    "wave": {"rightUpperArm": [0, 0, 0.6, 0.8], "note": "others are left alone"},
    "T": {}
  }
})";

TEST(PoseFile, a_posture_is_found_by_its_name) {
    const auto pose = parse_pose(kTwo, "wave");
    ASSERT_TRUE(pose) << pose.error().message;
    EXPECT_FLOAT_EQ(pose->rotation(Bone::right_upper_arm).z, 0.6F);
    EXPECT_FLOAT_EQ(pose->rotation(Bone::right_upper_arm).w, 0.8F);
    EXPECT_EQ(pose->rotation(Bone::left_upper_arm), motion::kNoRotation);
    const auto straight = parse_pose(kTwo, "T");
    ASSERT_TRUE(straight);
    EXPECT_EQ(straight->rotation(Bone::right_upper_arm), motion::kNoRotation);
}

TEST(PoseFile, a_file_may_be_one_posture_or_hold_one) {
    EXPECT_TRUE(parse_pose(R"({"hips": [0, 1, 0, 0]})", ""));
    EXPECT_TRUE(parse_pose(R"({"poses": {"x": {"hips": [0, 1, 0, 0]}}})", ""));
    EXPECT_TRUE(parse_pose(R"({"test_poses": {"poses": {"x": {}, "y": {}}}})", "y"));
}

TEST(PoseFile, rotations_are_made_unit) {
    const auto pose = parse_pose(R"({"head": [0, 3, 0, 4]})", "");
    ASSERT_TRUE(pose);
    EXPECT_FLOAT_EQ(glm::length(pose->rotation(Bone::head)), 1.0F);
}

struct BadFile {
    const char* text;
    const char* name;
    const char* message;
};

TEST(PoseFile, what_is_wrong_is_said) {
    for (const BadFile& bad :
         {BadFile{"{", "", "not a JSON object"},
          BadFile{R"({"poses": {"wa\nve": {}, "tall": {}}})",
                  "",
                  "holds several poses: name one as FILE#NAME: tall, wa?ve"},
          BadFile{R"({"poses": {}})", "", "holds no poses"},
          BadFile{"[1, 2]", "", "not a JSON object"},
          BadFile{R"({"skeleton": 1})",
                  "",
                  "it names no bone; name one posture of a list by FILE.json#NAME"},
          BadFile{R"({"hips": [0, 0, 0, 1]})", "x", "it has no poses, so none named x"},
          BadFile{kTwo, "wav", R"(pose "wav" is unknown; did you mean "wave"?)"},
          BadFile{R"({"hips": [0, 0, 0]})",
                  "",
                  "hips is not a rotation: four numbers x, y, z, w, not all 0"},
          BadFile{R"({"head": [0, 0, 0, 0]})",
                  "",
                  "head is not a rotation: four numbers x, y, z, w, not all 0"},
          BadFile{R"({"head": [0, 0, "1", 1]})",
                  "",
                  "head is not a rotation: four numbers x, y, z, w, not all 0"}}) {
        const auto pose = parse_pose(bad.text, bad.name);
        ASSERT_FALSE(pose) << bad.text;
        EXPECT_EQ(pose.error().message, bad.message) << bad.text;
    }
}

void expect_sound_or_refused(const std::string& text) {
    const auto pose = parse_pose(text, "wave");
    if (pose) {
        for (const glm::quat& q : pose->local_rotations) {
            EXPECT_NEAR(glm::length(q), 1.0F, 1e-4F);
        }
    } else {
        EXPECT_FALSE(pose.error().message.empty());
    }
}

TEST(PoseFile, cut_and_damaged_files_are_refused_or_give_sound_postures) {
    const std::string whole = kTwo;
    for (std::size_t length = 0; length < whole.size(); ++length) {
        expect_sound_or_refused(whole.substr(0, length));
    }
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        expect_sound_or_refused(test::mangled(whole, {.seed = seed}));
    }
}

TEST(PoseFile, errors_name_the_file) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "my.json";
    ASSERT_TRUE(write_file(path, kTwo));
    EXPECT_TRUE(read_pose(path.string() + "#wave"));
    const auto pose = read_pose(path.string() + "#wall");
    ASSERT_FALSE(pose);
    EXPECT_EQ(pose.error().message.rfind(path.string() + ": pose \"wall\" is unknown", 0), 0U)
        << pose.error().message;
    EXPECT_FALSE(read_pose((folder.path() / "none.json").string()));
}

}  // namespace
}  // namespace raks::engine
