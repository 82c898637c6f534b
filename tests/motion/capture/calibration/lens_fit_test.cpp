#include "motion/capture/calibration/lens_fit.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/dice.hpp"
#include "motion/capture/camera/rotation.hpp"
#include "tests/motion/capture/calibration/pictures.hpp"
#include "tests/support/shared_data.hpp"

#include <glm/trigonometric.hpp>

namespace raks::capture {
namespace {

const Board kChessboard{
    .kind = BoardKind::chessboard, .columns = 10, .rows = 7, .square = 0.025, .is_inverted = false};

// OpenCV's own pictures; empty where they are not.
std::vector<std::vector<BoardCorner>> chessboards(const std::string& side, CornerWindow window) {
    std::vector<std::vector<BoardCorner>> views;
    for (int i = 1; i <= 14; ++i) {
        const std::string name = side + (i < 10 ? "0" : "") + std::to_string(i) + ".jpg";
        const test::Picture picture =
            test::read_picture(raks::test::shared_data() / "capture/opencv" / name);
        if (picture.width != 0) {
            views.push_back(find_board(picture.grey(), kChessboard, window).corners);
        }
    }
    return views;
}

// A board before a camera: turned by `turn`, its middle 0.6 m away.
std::vector<BoardCorner> seen(const Lens& lens, const glm::dvec3& turn, double noise, Dice& dice) {
    const glm::dmat3 rotation = rotation_of(turn);
    const glm::dvec3 middle(0.125, 0.0875, 0.0);
    const Camera camera{{}, lens, rotation, glm::dvec3(0.02, 0.0, 0.6) - rotation * middle};
    std::vector<BoardCorner> corners;
    for (std::size_t i = 0; i < corner_count(kChessboard); ++i) {
        const auto pixel = project(camera, glm::dvec3(corner_place(kChessboard, i), 0.0));
        const glm::dvec2 error(dice.normal(1.0), dice.normal(1.0));
        corners.push_back({i, *pixel + noise * error});
    }
    return corners;
}

const Lens kTrue{640, 480, 600.0, 605.0, 322.0, 238.0, {-0.2, 0.05, 1e-3, -5e-4}};

TEST(LensFit, is_the_lens_that_took_the_pictures) {
    Dice dice(1, 0);
    std::vector<std::vector<BoardCorner>> views;
    for (int i = 0; i < 20; ++i) {
        const double about = 6.28 * i / 20.0;
        views.push_back(
            seen(kTrue, {0.5 * std::cos(about), 0.5 * std::sin(about), 0.1 * i}, 0.02, dice));
    }
    views.emplace_back();
    const Expected<LensFit> fit = fit_lens(640, 480, kChessboard, views);
    ASSERT_TRUE(fit) << fit.error().message;
    EXPECT_NEAR(fit->lens.fx, 600.0, 0.6);
    EXPECT_NEAR(fit->lens.fy, 605.0, 0.6);
    EXPECT_NEAR(fit->lens.cx, 322.0, 0.6);
    EXPECT_NEAR(fit->lens.distortion[0], -0.2, 0.01);
    EXPECT_NEAR(fit->rms, 0.02 * std::sqrt(2.0), 0.002);
    EXPECT_EQ(fit->view_rms.back(), 0.0);
    EXPECT_LT(std::abs(fit->lens.fx - 600.0), 3.0 * fit->focal_deviation);
    EXPECT_TRUE(fit->doubts.empty()) << fit->doubts.front();
}

// What cut boards near the edges of a bent lens suggest at first may be many times too long a focal
// length.
TEST(LensFit, is_found_from_boards_that_the_edges_cut) {
    const Lens bent{640, 480, 480.0, 480.0, 318.0, 242.0, {-0.25, 0.06, 0.0, 0.0}};
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Dice dice(seed, 0);
        std::vector<std::vector<BoardCorner>> views;
        for (int i = 0; i < 30; ++i) {
            const glm::dvec3 turn(dice.normal(0.5), dice.normal(0.5), dice.normal(1.5));
            std::vector<BoardCorner> corners = seen(bent, turn, 0.2, dice);
            const int cut = dice.whole(0, static_cast<int>(corners.size()) - 8);
            views.emplace_back(corners.begin() + cut, corners.end());
        }
        const Expected<LensFit> fit = fit_lens(640, 480, kChessboard, views);
        EXPECT_TRUE(fit) << seed << ": " << fit.error().message;
        EXPECT_NEAR(fit ? fit->lens.fx : 0.0, 480.0, 15.0) << seed;
    }
}

TEST(LensFit, is_refused_where_the_boards_tell_too_little) {
    Dice dice(2, 0);
    std::vector<std::vector<BoardCorner>> views(
        30, std::vector<BoardCorner>{{0, {1.0, 1.0}}, {1, {2.0, 1.0}}});
    const Expected<LensFit> few = fit_lens(640, 480, kChessboard, views);
    ASSERT_FALSE(few);
    EXPECT_NE(few.error().message.find("in 0 pictures only; 3 or more"), std::string::npos);
    for (auto& view : views) {
        view = seen(kTrue, {0.02, 0.01, 0.0}, 0.2, dice);
    }
    const Expected<LensFit> one_pose = fit_lens(640, 480, kChessboard, views);
    ASSERT_FALSE(one_pose) << one_pose->lens.fx << " +- " << one_pose->focal_deviation;
    EXPECT_NE(one_pose.error().message.find("nearly one pose"), std::string::npos)
        << one_pose.error().message;
}

TEST(LensFit, is_that_of_opencv_with_its_window) {
    const auto left = chessboards("left", CornerWindow::classic);
    if (left.empty()) {
        GTEST_SKIP() << "skipped: no pictures of OpenCV in ../shared";
    }
    ASSERT_EQ(left.size(), 13U);
    const Expected<LensFit> fit =
        fit_lens(640, 480, kChessboard, left, {.has_square_pixels = true});
    ASSERT_TRUE(fit) << fit.error().message;
    // left_intrinsics.yml says 0.392591 and 535.9157.
    EXPECT_NEAR(fit->rms, 0.3926, 0.001);
    EXPECT_NEAR(fit->lens.fx, 535.9157, 0.01);
    EXPECT_NEAR(fit->view_rms[1], 1.18204820, 0.01);
}

TEST(LensFit, is_twice_as_close_with_windows_within_the_squares) {
    for (const std::string side : {"left", "right"}) {
        const auto views = chessboards(side, CornerWindow::adaptive);
        if (views.empty()) {
            GTEST_SKIP() << "skipped: no pictures of OpenCV in ../shared";
        }
        const Expected<LensFit> five = fit_lens(640, 480, kChessboard, views);
        ASSERT_TRUE(five) << five.error().message;
        // 0.1955 and 0.2071 with a window of 5 px to each side.
        EXPECT_LT(five->rms, 0.19) << side;
        EXPECT_LT(five->focal_deviation, 0.7);
        const Expected<LensFit> eight = fit_lens(640, 480, kChessboard, views, {.coefficients = 8});
        ASSERT_TRUE(eight) << eight.error().message;
        EXPECT_LT(eight->rms, five->rms);
        RecordProperty("rms_" + side, std::to_string(five->rms));
    }
}

}  // namespace
}  // namespace raks::capture
