// `raks capture board` and `raks capture calibrate`, as a user starts them.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/capture/camera/rig_file.hpp"
#include "tests/end_to_end/filmed_board.hpp"
#include "tests/end_to_end/program_fixture.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

namespace raks::test {
namespace {

namespace fs = std::filesystem;

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string text_of(const fs::path& file) { return read_file(file).value_or(""); }

/// A big-endian number of a PNG, 4 bytes from `at`.
std::uint32_t number_at(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + 4 && i < bytes.size(); ++i) {
        value = value << 8U | static_cast<unsigned char>(bytes[i]);
    }
    return value;
}

class CaptureBoard : public ProgramTest {};

TEST_F(CaptureBoard, is_drawn_in_its_true_size) {
    const auto pdf =
        run({"board", "--square", "50", "--columns", "7", "--rows", "5", "-o", path("board.pdf")});
    EXPECT_EQ(pdf.exit_code, 0) << pdf.err;
    EXPECT_TRUE(has(pdf.err, "7 x 5 squares of 50 mm")) << pdf.err;
    const std::string page = text_of(path("board.pdf"));
    EXPECT_TRUE(page.starts_with("%PDF-1."));
    EXPECT_TRUE(has(page, "%%EOF"));
    // 350 x 250 mm in points of 1/72 inch, and more around.
    const std::size_t box = page.find("/MediaBox [0 0 ");
    ASSERT_NE(box, std::string::npos);
    EXPECT_GT(std::stod(page.substr(box + 15)), 350.0 / 25.4 * 72.0);
    EXPECT_LT(std::stod(page.substr(box + 15)), 500.0 / 25.4 * 72.0);

    const auto png =
        run({"board", "--columns", "7", "--rows", "5", "--pixels", "20", "-o", path("board.png")});
    EXPECT_EQ(png.exit_code, 0) << png.err;
    const std::string picture = text_of(path("board.png"));
    EXPECT_TRUE(picture.starts_with("\x89PNG"));
    // Squares, and a margin around.
    EXPECT_EQ(number_at(picture, 16), 8U * 20U);
    EXPECT_GE(number_at(picture, 20), 6U * 20U);
}

TEST_F(CaptureBoard, that_cannot_be_is_refused) {
    expect_one_line({"board", "-o", path("board.jpg")}, 1, "is drawn as .pdf or .png");
    expect_one_line({"board", "--marker", "80", "-o", path("b.pdf")}, 1, "marker");
    expect_one_line({"board", "--dictionary", "DICT_9X9", "-o", path("b.pdf")}, 1, "DICT_9X9");
    expect_one_line({"board", "--square", "2000", "--columns", "9", "-o", path("b.pdf")}, 1, "5 m");
    expect_one_line({"board", path("nowhere"), "-o", path("b.pdf")}, 1, "no capture");
    expect_one_line({"board", "-o", path("no/folder/b.pdf")}, 1, "no/folder");
    EXPECT_TRUE(files().empty());
}

class CaptureCalibrate : public ProgramTest {
 protected:
    // Pictures are made once, and copied.
    void SetUp() override {
        static const TemporaryFolder pictures;
        static const bool are_made = [] {
            film_board(two_cameras(), capture::Board{}, pictures / "");
            return true;
        }();
        ASSERT_TRUE(are_made);
        fs::create_directories(path("take"));
        for (const char* const name : {"left", "right"}) {
            fs::create_directory_symlink(pictures / name, fs::path(path("take")) / name);
        }
        plan("columns = 8\nrows = 6\nsquare = 0.08\nmarker = 0.06\n");
    }

    void plan(const std::string& board) const {
        ASSERT_TRUE(write_file(path("take/capture.toml"),
                               "format = \"raks-capture\"\nversion = 1\n[board]\n" + board +
                                   "[[camera]]\nname = \"left\"\ncalibration = \"left\"\n"
                                   "[[camera]]\nname = \"right\"\ncalibration = \"right\"\n"));
    }
    [[nodiscard]] std::vector<std::string> calibrate(std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"calibrate", path("take")});
        return more;
    }
};

TEST_F(CaptureCalibrate, finds_cameras_that_it_knows_the_truth_of) {
    const auto done = run(calibrate({"--floor-picture", "11", "--json"}));
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const auto report = nlohmann::json::parse(done.out, nullptr, false);
    ASSERT_FALSE(report.is_discarded()) << done.out;
    EXPECT_LT(report["rms_px"].get<double>(), 0.5);
    EXPECT_LT(report["held_out"]["rms_mm"].get<double>(), 3.0);
    EXPECT_TRUE(report["has_floor"].get<bool>());
    EXPECT_GE(report["pairs"][0]["shared_views"].get<int>(), 8);
    const auto found = capture::read_rig(path("take/rig.toml"));
    ASSERT_TRUE(found) << found.error().message;
    const capture::Rig truth = two_cameras();
    for (std::size_t i = 0; i < 2; ++i) {
        const capture::Camera& camera = found->rig.cameras[i];
        EXPECT_NEAR(camera.lens.fx, truth.cameras[i].lens.fx, 12.0);
        // The board on the floor is small in these pictures, and seen at a slant.
        EXPECT_NEAR(camera.centre().y, 1.6, 0.12);
        EXPECT_NEAR(glm::length(camera.centre()), glm::length(truth.cameras[i].centre()), 0.08);
    }
}

TEST_F(CaptureCalibrate, keeps_what_was_chosen_by_hand_when_run_calibrates_again) {
    ASSERT_EQ(run(calibrate({"--floor-picture", "11", "--coefficients", "5"})).exit_code, 0);
    EXPECT_TRUE(has(text_of(path("take/calibration.toml")), "floor_picture = 11\n"));
    const std::string first = text_of(path("take/rig.toml"));
    fs::remove(path("take/rig.toml"));
    // It ends where there is no film to hear.
    const auto again = run({"run", path("take")});
    EXPECT_TRUE(has(again.err, "raks: calibrate: missing")) << again.err;
    EXPECT_FALSE(has(again.err, "no floor")) << again.err;
    EXPECT_EQ(text_of(path("take/rig.toml")), first);
    // And another choice counts from then on.
    ASSERT_TRUE(write_file(path("take/calibration.toml"),
                           "format = \"raks-calibration\"\nversion = 1\nfloor_picture = 500\n"));
    const auto elsewhere = run(calibrate());
    EXPECT_TRUE(has(elsewhere.err, "no camera saw the board on the floor")) << elsewhere.err;
}

TEST_F(CaptureCalibrate, says_without_a_floor_that_heights_are_not_true) {
    const auto done = run(calibrate());
    EXPECT_EQ(done.exit_code, 0);
    EXPECT_TRUE(has(done.err, "no floor")) << done.err;
    EXPECT_TRUE(has(done.err, "camera \"right\" looked at: ")) << done.err;
    EXPECT_FALSE(fs::exists(path("take/calibration.toml")));
    // The same where no camera saw it, and which square would be seen.
    const auto unseen = run(calibrate({"--floor-picture", "500"}));
    EXPECT_EQ(unseen.exit_code, 0);
    EXPECT_TRUE(has(unseen.err, "no camera saw the board on the floor")) << unseen.err;
    EXPECT_TRUE(has(unseen.err, "squares of ")) << unseen.err;
    const auto rig = capture::read_rig(path("take/rig.toml"));
    ASSERT_TRUE(rig) << rig.error().message;
    EXPECT_EQ(rig->rig.floor, capture::FloorOrigin::unknown);
}

TEST_F(CaptureCalibrate, refuses_what_is_no_calibration_in_one_line) {
    plan("columns = 7\nrows = 6\n");
    const auto other = run(calibrate());
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_TRUE(has(other.err, "of 12 pictures: are columns and rows right?")) << other.err;
    plan("dictionary = \"DICT_6X6_250\"\n");
    expect_one_line(calibrate(), 1, "DICT_4X4");
    plan("kind = \"chessboard\"\ncolumns = 10\nrows = 7\n");
    expect_one_line(calibrate(), 1, "shows no board");
    plan("");
    expect_one_line(calibrate({"--floor", "1", "--floor-picture", "1"}), 2, "");
    expect_one_line(calibrate({"--clocks", path("none.toml")}), 1, "none.toml");
    ASSERT_TRUE(write_file(path("take/calibration.toml"), "format = \"raks-calibration\"\n"));
    expect_one_line(calibrate(), 1, "calibration.toml");
    fs::remove(path("take/calibration.toml"));
    // One picture again and again: all boards in one pose.
    fs::remove(path("take/left"));
    fs::create_directory(path("take/left"));
    for (int i = 0; i < 12; ++i) {
        fs::copy_file(path("take/right/00.png"), path(fmt::format("take/left/{:02}.png", i)));
    }
    const auto alike = run(calibrate());
    EXPECT_EQ(alike.exit_code, 1);
    EXPECT_TRUE(has(alike.err, "camera \"left\": all boards are in nearly one pose")) << alike.err;
    fs::remove_all(path("take/left"));
    expect_one_line(calibrate(), 1, "take/left");
    EXPECT_FALSE(fs::exists(path("take/rig.toml")));
}

TEST_F(CaptureCalibrate, takes_cameras_that_another_program_calibrated) {
    capture::Rig rig = two_cameras();
    for (capture::Camera& camera : rig.cameras) {
        camera.translation *= 1000.0;
    }
    std::string text = capture::rig_text(rig);
    text.resize(text.find("[metadata]"));
    ASSERT_TRUE(write_file(path("theirs.toml"), text));
    const auto far = run(calibrate({"--rig", path("theirs.toml")}));
    EXPECT_EQ(far.exit_code, 0);
    EXPECT_TRUE(has(far.err, "m apart: is this in millimetres?")) << far.err;
    const auto taken = run(calibrate({"--rig", path("theirs.toml"), "--unit", "mm"}));
    EXPECT_EQ(taken.exit_code, 0) << taken.err;
    const auto read = capture::read_rig(path("take/rig.toml"));
    ASSERT_TRUE(read);
    EXPECT_NEAR(read->rig.cameras[0].centre().y, 1.6, 1e-9);
    rig.cameras[1].name = "other";
    ASSERT_TRUE(write_file(path("theirs.toml"), capture::rig_text(rig)));
    expect_one_line(calibrate({"--rig", path("theirs.toml")}), 1, "has no camera \"right\"");
}

}  // namespace
}  // namespace raks::test
