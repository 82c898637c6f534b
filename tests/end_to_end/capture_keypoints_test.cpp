// `raks capture keypoints` on folders of pictures, and on what other programs found.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/capture/keypoints/keypoints.hpp"
#include "tests/end_to_end/program_fixture.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

const fs::path kPicture = fs::path(RAKS_SOURCE_DIR) / "tests/data/pose/dancer.jpg";

/// Two cameras, left and right, in the folder "take".
class CaptureKeypoints : public ProgramTest {
 protected:
    CaptureKeypoints() { fs::create_directories(folder_ / "take"); }

    void write_plan(const std::string& left, const std::string& right) const {
        const std::string head = "format = \"raks-capture\"\nversion = 1\n";
        EXPECT_TRUE(write_file(folder_ / "take/capture.toml",
                               head + "[[camera]]\nname = \"left\"\n" + left +
                                   "[[camera]]\nname = \"right\"\n" + right));
    }
    void make_film(const std::string& name) const {
        fs::create_directories(folder_ / "take" / name);
        for (const char* const number : {"0", "1"}) {
            fs::copy_file(kPicture, folder_ / "take" / name / (std::string(number) + ".jpg"));
        }
    }
    [[nodiscard]] Expected<capture::KeypointFilm> found(const std::string& camera) const {
        const fs::path file = folder_ / "take/keypoints" / (camera + ".csv");
        const auto text = read_text_file(file, 1'000'000);
        return text ? capture::read_keypoints(*text, file.string()) : fail(text.error());
    }
};

TEST_F(CaptureKeypoints, are_found_in_films_and_kept) {
    write_plan("film = \"a\"\n", "film = \"b\"\n");
    make_film("a");
    make_film("b");
    const auto first = run({"keypoints", path("take"), "--threads", "1"});
    EXPECT_EQ(first.exit_code, 0) << first.err;
    const auto left = found("left");
    ASSERT_TRUE(left) << left.error().message;
    ASSERT_EQ(left->pictures.size(), 2U);
    EXPECT_EQ(left->network, "full");
    EXPECT_EQ(left->width, 198);
    EXPECT_GT(left->pictures[1][capture::BodyPoint::left_ankle].visibility, 0.5);
    // What is done is kept; what is missing is found again, to the same bits.
    fs::remove(folder_ / "take/keypoints/right.csv");
    const auto second = run({"keypoints", path("take"), "--threads", "2"});
    EXPECT_EQ(second.exit_code, 0) << second.err;
    EXPECT_NE(second.err.find("camera left: kept as it was found before"), std::string::npos);
    EXPECT_NE(second.err.find("camera right: 2 pictures searched"), std::string::npos);
    const auto right = found("right");
    ASSERT_TRUE(right) << right.error().message;
    EXPECT_EQ(right->pictures, left->pictures);
}

TEST_F(CaptureKeypoints, of_other_programs_are_taken) {
    write_plan("", "");
    ASSERT_TRUE(write_file(folder_ / "t.csv", "LAnkle_x,LAnkle_y,LKnee_x,LKnee_y\n10,20,11,22\n"));
    const std::string from = "left=" + path("t.csv");
    const auto sized = run({"keypoints", path("take"), "--from", from});
    EXPECT_EQ(sized.exit_code, 1);
    EXPECT_EQ(sized.err,
              "raks: camera left has no film that says it: say --size WIDTHxHEIGHT and --fps\n");
    // One leg is no body: it is kept, and said.
    const auto taken =
        run({"keypoints", path("take"), "--from", from, "--size", "640x480", "--fps", "25"});
    EXPECT_EQ(taken.exit_code, 1);
    EXPECT_NE(taken.err.find("camera left: no whole body is visible"), std::string::npos);
    const auto left = found("left");
    ASSERT_TRUE(left) << left.error().message;
    EXPECT_EQ(left->pictures[0][capture::BodyPoint::left_knee].pixel, glm::dvec2(11.0, 22.0));
    const auto other = run({"keypoints", path("take"), "--from", "middle=" + path("t.csv")});
    EXPECT_EQ(other.err.substr(0, 33), "raks: camera \"middle\" is unknown;");
}

TEST_F(CaptureKeypoints, a_bad_network_is_one_line) {
    write_plan("film = \"a\"\n", "film = \"b\"\n");
    const fs::path full = fs::path(RAKS_SOURCE_DIR) / "models/pretrained/blazepose_full.pose";
    ASSERT_TRUE(write_file(folder_ / "cut.pose", read_file(full)->substr(0, 100'000)));
    const auto cut = run({"keypoints", path("take"), "--pose-model", path("cut.pose")});
    EXPECT_EQ(cut.exit_code, 1);
    EXPECT_EQ(cut.err.find("raks: " + path("cut.pose") +
                           ": is cut off, damaged or of other origin: its SHA-256 begins with "),
              0U)
        << cut.err;
    const auto missing = run({"keypoints", path("take"), "--pose-model", "heavy"});
    EXPECT_EQ(missing.exit_code, 1);
    EXPECT_EQ(missing.err.find("raks: the network heavy is not installed: npm pack "), 0U)
        << missing.err;
}

}  // namespace
}  // namespace raks::test
