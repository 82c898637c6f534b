// The door: formats are told by content first, and what is no motion is refused in one line.
#include "motion/skeleton/formats/motion_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <variant>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/skeleton/formats/motion_format.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::motion::motion_file_test {
namespace {

namespace fs = std::filesystem;

const fs::path kPlain = fs::path(RAKS_SOURCE_DIR) / "tests/data/bvh/odd/plain.bvh";

std::string message(const Expected<MotionFile>& file) {
    return file ? "read" : file.error().message;
}

TEST(MotionFormat, content_wins_over_the_ending) {
    const std::string c3d = std::string("\x02\x50", 2) + std::string(600, '\0');
    const struct {
        std::string start;
        const char* name;
        MotionFormat format;
    } rows[] = {
        {"HIERARCHY\nROOT a", "x.txt", MotionFormat::bvh},
        {"\xEF\xBB\xBF\r\n hierarchy", "x.json", MotionFormat::bvh},
        {"#!OML:ASF F:\\x.asf\n:FULLY-SPECIFIED\n:DEGREES\n1\n", "x", MotionFormat::amc},
        {"# made by hand\n:version 1.10\n:name x\n", "x.amc", MotionFormat::asf},
        {"PathFileType\t4\t(X/Y/Z)\tx.trc\n", "x.csv", MotionFormat::trc},
        {"PK\x03\x04", "x.bin", MotionFormat::smpl_npz},
        {"glTF\x02", "x.bvh", MotionFormat::model},
        {"{\"poses\": [[0]]}", "x.bvh", MotionFormat::smpl_json},
        {"{\"nodes\": [], \"asset\": {}}", "x.json", MotionFormat::model},
        {c3d, "x", MotionFormat::c3d},
        {"time,a_x,a_y,a_z\n", "x.CSV", MotionFormat::csv},
        {"Vocaloid Motion Data 0002", "x.vpd", MotionFormat::vmd},
        {"Vocaloid Pose Data file\r\n", "x.vmd", MotionFormat::vpd},
    };
    for (const auto& row : rows) {
        EXPECT_EQ(motion_format(row.start, row.name), row.format) << row.start;
    }
    EXPECT_EQ(motion_format("hello", "x.txt"), std::nullopt);
}

TEST(MotionFile, a_bvh_of_any_name_is_a_clip) {
    const raks::test::TemporaryFolder folder;
    const auto text = read_file(kPlain).value();
    ASSERT_TRUE(write_file(folder / "x.dat", text));
    const auto file = read_motion(folder / "x.dat", {.frames_per_second = 50.0});
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_TRUE(std::holds_alternative<MotionClip>(*file));
    const MotionClip& clip = std::get<MotionClip>(*file);
    EXPECT_EQ(clip.frame_count, 12U);
    EXPECT_EQ(clip.frames_per_second, 50.0);
    EXPECT_EQ(clip.metres_per_unit, std::nullopt);  // a BVH does not say it
}

TEST(MotionFile, what_is_no_motion_is_refused_with_what_to_do) {
    const struct {
        std::string bytes;
        const char* part;
    } rows[] = {
        {"", "is empty"},
        {"hello", "is not a motion file of a known kind; known: BVH, ASF/AMC"},
        {std::string("\x80\x04\x95\0", 4), "pickles are programs"},
        {"(dp0\nVsmpl_poses\np1\n", "pickles are programs"},
        {"\x93NUMPY\x01", "numpy.savez"},
        {"version https://git-lfs.github.com/spec/v1\n", "git lfs pull"},
        {"<!DOCTYPE html><html>", "is a web page"},
        {"glTF\x02", "whose clips are not read here"},
        {"Kaydara FBX Binary  ", "whose clips are not read here"},
    };
    for (const auto& row : rows) {
        const auto file = parse_motion(row.bytes, {"x.bin", ""}, {});
        EXPECT_EQ(message(file).rfind("x.bin: ", 0), 0U) << message(file);
        EXPECT_NE(message(file).find(row.part), std::string::npos) << message(file);
    }
}

TEST(MotionFile, models_go_to_the_reader_that_is_handed_in) {
    const raks::test::TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "x.glb", "glTF\x02"));
    ClipAddress asked;
    MotionReadOptions options;
    options.read_model = [&](const ClipAddress& address, std::optional<double>) {
        asked = address;
        return Expected<MotionClip>(MotionClip{});
    };
    EXPECT_TRUE(read_motion(folder / "x.glb#Dance", options));
    EXPECT_EQ(asked.file, folder / "x.glb");
    EXPECT_EQ(asked.clip, "Dance");
}

// The corpus of each format's fuzzer, cut and damaged, through the door.
TEST(MotionFile, cut_and_damaged_files_end_in_one_line) {
    const fs::path corpus = fs::path(RAKS_SOURCE_DIR) / "tests/fuzz/corpus";
    for (const char* file : {"smpl_npz/amass.npz",
                             "smpl_npz/half.npz",
                             "smpl_json/flat.json",
                             "c3d/intel_float.c3d",
                             "c3d/mips_whole.c3d",
                             "trc/two.trc",
                             "points_csv/two.csv"}) {
        const std::string whole = read_file(corpus / file).value();
        EXPECT_TRUE(parse_motion(whole, {file, ""}, {})) << file;
        const auto expect_end = [&](const std::string& bytes) {
            const auto read = parse_motion(bytes, {file, ""}, {});
            EXPECT_EQ(message(read).find_first_of("\r\n"), std::string::npos) << message(read);
        };
        for (std::size_t size = 0; size < whole.size(); ++size) {
            expect_end(whole.substr(0, size));
        }
        for (std::uint64_t seed = 0; seed < 500; ++seed) {
            expect_end(raks::test::mangled(whole, {.seed = seed, .bytes = 1 + seed % 4}));
        }
    }
}

TEST(MotionFile, a_format_of_one_clip_has_no_names) {
    const auto file = read_motion(kPlain.string() + "#walk", {});
    EXPECT_NE(message(file).find("holds one clip, which has no name"), std::string::npos);
}

}  // namespace
}  // namespace raks::motion::motion_file_test
