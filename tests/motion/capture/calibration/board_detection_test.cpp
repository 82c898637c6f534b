#include "motion/capture/calibration/board_detection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "motion/capture/calibration/board_drawing.hpp"
#include "motion/capture/calibration/board_pose.hpp"
#include "motion/capture/calibration/lens_fit.hpp"
#include "motion/capture/camera/lens_file.hpp"
#include "motion/capture/camera/rotation.hpp"
#include "tests/motion/capture/calibration/pictures.hpp"
#include "tests/support/process.hpp"
#include "tests/support/shared_data.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {
namespace {

const Lens kLens{640, 480, 600.0, 600.0, 319.5, 239.5, {}};
const Board kBoard{.columns = 8, .rows = 6, .square = 0.05, .marker = 0.0375};

// A picture of a board before a camera, every pixel the mean of 3 x 3 rays. Seen from behind the
// paper is clear.
test::Picture photograph(const Board& board, const RigidMotion& camera_from_board) {
    const BoardPicture print = draw_board(board, 64).value();
    const RigidMotion back = camera_from_board.inverse();
    const auto shade = [&](const glm::dvec2& pixel) {
        const glm::dvec2 direction = direction_of(kLens, pixel);
        const glm::dvec3 ray = back.rotation * glm::dvec3(direction, 1.0);
        const glm::dvec3 place = back.translation - back.translation.z / ray.z * ray;
        const glm::dvec2 at =
            glm::dvec2(place.x, place.y) / board.square * 64.0 + glm::dvec2(print.margin);
        if (at.x < 0.0 || at.y < 0.0 || at.x >= print.width || at.y >= print.height) {
            return 128.0;
        }
        const auto index = static_cast<std::size_t>(at.y) * static_cast<std::size_t>(print.width) +
                           static_cast<std::size_t>(at.x);
        return 30.0 + 0.75 * print.pixels[index];
    };
    test::Picture picture{kLens.width, kLens.height, {}};
    for (int y = 0; y < kLens.height; ++y) {
        for (int x = 0; x < kLens.width; ++x) {
            double sum = 0.0;
            for (int i = 0; i < 9; ++i) {
                sum += shade({x + (i % 3 - 1) / 3.0, y + (i / 3 - 1) / 3.0});
            }
            picture.pixels.push_back(static_cast<std::uint8_t>(sum / 9.0));
        }
    }
    return picture;
}

// The board's middle on the optical axis but for `aside`, turned.
RigidMotion held(const glm::dvec3& turn, const glm::dvec3& at) {
    RigidMotion place{rotation_of(turn), {}};
    place.translation = at - place.rotation * glm::dvec3(0.2, 0.15, 0.0);
    return place;
}

// The greatest distance of corners from where they are; pixels.
double worst_miss(const Board& board, const RigidMotion& place, const BoardView& view) {
    const Camera camera{{}, kLens, place.rotation, place.translation};
    double worst = 0.0;
    for (const BoardCorner& corner : view.corners) {
        const auto pixel = project(camera, glm::dvec3(corner_place(board, corner.corner), 0.0));
        worst = std::max(worst, glm::distance(*pixel, corner.pixel));
    }
    return worst;
}

TEST(BoardDetection, finds_tilted_boards_to_a_fifth_of_a_pixel) {
    for (const glm::dvec3& turn : {glm::dvec3(0.3, -0.4, 0.2), glm::dvec3(0.1, 0.6, 3.0)}) {
        const RigidMotion place = held(turn, {0.02, -0.03, 0.75});
        for (const bool is_inverted : {false, true}) {
            Board board = kBoard;
            board.is_inverted = is_inverted;
            const BoardView view = find_board(photograph(board, place).grey(), board);
            EXPECT_EQ(view.corners.size(), corner_count(board));
            EXPECT_EQ(view.is_inverted, is_inverted);
            EXPECT_LT(worst_miss(board, place, view), 0.2);
        }
        Board chessboard = kBoard;
        chessboard.kind = BoardKind::chessboard;
        chessboard.columns = 9;
        const BoardView view = find_board(photograph(chessboard, place).grey(), chessboard);
        EXPECT_EQ(view.corners.size(), corner_count(chessboard));
        // Also the right way round.
        EXPECT_LT(worst_miss(chessboard, place, view), 0.2);
    }
}

TEST(BoardDetection, finds_boards_that_are_otherwise_than_said) {
    Board inverted = kBoard;
    inverted.is_inverted = true;
    const RigidMotion before = held({0.3, -0.4, 0.2}, {0.0, 0.0, 0.75});
    const BoardView other = find_board(photograph(inverted, before).grey(), kBoard);
    EXPECT_EQ(other.corners.size(), corner_count(kBoard));
    EXPECT_TRUE(other.is_inverted);
    // From behind: turned by nearly half a turn about the vertical.
    const RigidMotion behind = held({0.1, 2.8, 0.2}, {0.0, 0.0, 0.75});
    const BoardView mirrored = find_board(photograph(kBoard, behind).grey(), kBoard);
    EXPECT_EQ(mirrored.corners.size(), corner_count(kBoard));
    EXPECT_TRUE(mirrored.is_mirrored);
    EXPECT_LT(worst_miss(kBoard, behind, mirrored), 0.3);
}

TEST(BoardDetection, finds_part_of_a_board_and_its_pose) {
    const RigidMotion place = held({0.3, -0.4, 0.2}, {0.3, 0.1, 0.75});
    const BoardView view = find_board(photograph(kBoard, place).grey(), kBoard);
    EXPECT_GT(view.corners.size(), 10U);
    EXPECT_LT(view.corners.size(), corner_count(kBoard));
    EXPECT_LT(worst_miss(kBoard, place, view), 0.2);
    const std::vector<BoardPose> poses = board_poses(kLens, kBoard, view.corners);
    ASSERT_FALSE(poses.empty());
    const RigidMotion& found = poses.front().camera_from_board;
    EXPECT_LT(glm::distance(found.translation, place.translation), 0.003);
    EXPECT_LT(poses.front().rms, 0.15);
}

TEST(BoardDetection, finds_nothing_where_there_is_none) {
    const test::Picture grey{640, 480, std::vector<std::uint8_t>(640U * 480U, 128)};
    EXPECT_FALSE(find_board(grey.grey(), kBoard).is_found());
    EXPECT_FALSE(find_board({}, kBoard).is_found());
    EXPECT_FALSE(find_board({640, 480, {}}, kBoard).is_found());
    EXPECT_FALSE(find_board({-640, -480, grey.pixels}, kBoard).is_found());
    for (const int side : {1, 3, 20}) {
        const std::vector<std::uint8_t> pixels(400, 255);
        EXPECT_FALSE(find_board({side, side, pixels}, kBoard).is_found());
        Board chessboard = kBoard;
        chessboard.kind = BoardKind::chessboard;
        EXPECT_FALSE(find_board({side, side, pixels}, chessboard).is_found());
    }
}

TEST(BoardDetection, tells_a_board_of_another_dictionary) {
    Board other = kBoard;
    other.dictionary = "DICT_5X5_100";
    const test::Picture picture = photograph(other, held({0.3, -0.4, 0.2}, {0.0, 0.0, 0.75}));
    EXPECT_FALSE(find_board(picture.grey(), kBoard).is_found());
    const std::string_view guess = guess_dictionary(picture.grey());
    EXPECT_TRUE(guess.starts_with("DICT_5X5")) << guess;
    // Of the same dictionary, but larger: its other markers are foreign.
    Board larger = kBoard;
    larger.columns = 12;
    larger.rows = 10;
    larger.square = 0.03;
    larger.marker = 0.0225;
    const BoardView view =
        find_board(photograph(larger, held({0.0, 0.1, 0.0}, {0.0, 0.0, 0.75})).grey(), kBoard);
    EXPECT_GT(view.foreign_markers, 10U);
}

TEST(BoardDetection, finds_all_of_opencvs_charuco_picture) {
    const auto folder = raks::test::shared_data() / "capture/opencv";
    const test::Picture picture = test::read_picture(folder / "choriginal.jpg");
    if (picture.width == 0) {
        GTEST_SKIP() << "skipped: no pictures of OpenCV in ../shared";
    }
    const Board board{
        .columns = 5, .rows = 7, .square = 0.04, .marker = 0.02, .dictionary = "DICT_6X6_250"};
    const BoardView view = find_board(picture.grey(), board);
    EXPECT_EQ(view.corners.size(), 24U);
    const auto lens = read_lens_yaml(folder / "tutorial_camera_charuco.yml");
    ASSERT_TRUE(lens) << lens.error().message;
    const std::vector<BoardPose> poses = board_poses(*lens, board, view.corners);
    ASSERT_FALSE(poses.empty());
    EXPECT_LT(poses.front().rms, 0.25);
}

// The frames of a film as grey pictures of 1280 x 720, by the program ffmpeg.
std::vector<test::Picture> frames_of(const std::filesystem::path& film,
                                     const std::filesystem::path& into) {
    raks::test::ProcessPlan plan;
    plan.command = {"ffmpeg",
                    "-v",
                    "error",
                    "-i",
                    film.string(),
                    "-f",
                    "rawvideo",
                    "-pix_fmt",
                    "gray",
                    "-y",
                    into.string()};
    raks::test::run_process(plan);
    const auto bytes = read_file(into);
    std::vector<test::Picture> frames;
    constexpr std::size_t kSize = std::size_t{1280} * 720;
    for (std::size_t at = 0; bytes && at + kSize <= bytes->size(); at += kSize) {
        test::Picture frame{1280, 720, {}};
        const std::string_view some = std::string_view(*bytes).substr(at, kSize);
        frame.pixels.assign(some.begin(), some.end());
        frames.push_back(std::move(frame));
    }
    return frames;
}

TEST(BoardDetection, finds_as_many_boards_in_four_films_as_their_makers) {
    const auto folder = raks::test::shared_data() / "capture/caliscope/4_cam_recording";
    if (!std::filesystem::is_regular_file(folder / "cam_0.mp4")) {
        GTEST_SKIP() << "skipped: no films of Caliscope in ../shared";
    }
    const raks::test::TemporaryFolder work;
    const Board board{
        .columns = 4, .rows = 5, .square = 0.054, .marker = 0.0405, .is_inverted = true};
    const std::array<std::size_t, 4> expected = {47, 48, 48, 24};
    // With OpenCV's larger windows 0.258, 0.236, 0.288, 0.231.
    const std::array<double, 4> lens_rms = {0.31, 0.25, 0.36, 0.24};
    for (std::size_t camera = 0; camera < 4; ++camera) {
        const auto film = folder / ("cam_" + std::to_string(camera) + ".mp4");
        std::vector<std::vector<BoardCorner>> views;
        std::size_t mirrored = 0;
        std::size_t corners = 0;
        std::size_t frames = 0;
        for (const test::Picture& frame : frames_of(film, work.path() / "frames")) {
            const BoardView view = find_board(frame.grey(), board);
            ++frames;
            if (view.is_found()) {
                views.push_back(view.corners);
                corners += view.corners.size();
                mirrored += view.is_mirrored ? 1U : 0U;
            }
        }
        EXPECT_EQ(frames, 48U);
        EXPECT_GE(views.size(), expected[camera]) << camera;
        EXPECT_EQ(mirrored, camera == 1 ? views.size() : 0U) << camera;
        RecordProperty("frames_" + std::to_string(camera), static_cast<int>(views.size()));
        std::erase_if(views, [](const auto& view) { return view.size() < 8; });
        const auto fit = fit_lens(1280, 720, board, views);
        ASSERT_TRUE(fit) << fit.error().message;
        EXPECT_LT(fit->rms, lens_rms[camera]) << camera;
        const std::string name = std::to_string(camera);
        RecordProperty("corners_" + name, static_cast<int>(corners));
        RecordProperty("rms_" + name, std::to_string(fit->rms));
    }
}

}  // namespace
}  // namespace raks::capture
