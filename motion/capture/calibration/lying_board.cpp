#include "motion/capture/calibration/lying_board.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "motion/capture/calibration/board_drawing.hpp"
#include "motion/capture/calibration/charuco_board.hpp"
#include "motion/capture/calibration/one_thread.hpp"

namespace raks::capture {

namespace {

constexpr int kSquarePixels = 16;  // of the board seen from above

/// By how much a picture is enlarged, across and down.
struct Stretch {
    double across = 1.0;
    double down = 1.0;
};

struct ReadMarkers {
    std::vector<std::vector<cv::Point2f>> corners;  // in the picture as it is
    std::vector<int> names;
};

cv::Mat matrix_of(const GreyPicture& picture, bool is_inverted) {
    cv::Mat copy(picture.height, picture.width, CV_8UC1);
    const auto row_bytes = static_cast<std::size_t>(picture.width);
    for (int y = 0; y < picture.height; ++y) {
        const auto row = picture.pixels.subspan(static_cast<std::size_t>(y) * row_bytes, row_bytes);
        std::copy(row.begin(), row.end(), copy.ptr<unsigned char>(y));
    }
    if (is_inverted) {
        cv::bitwise_not(copy, copy);
    }
    return copy;
}

// The markers of the board that can be read once the picture is stretched.
ReadMarkers read_markers(const cv::Mat& picture,
                         const cv::Ptr<cv::aruco::CharucoBoard>& board,
                         const Stretch& stretch) {
    // Of the picture's longer side; OpenCV's own 0.03 leaves out what is smaller than 10 x 10
    // pixels in a picture 1280 wide.
    constexpr double kLeastPerimeter = 0.005;
    cv::Mat stretched;
    cv::resize(picture, stretched, {}, stretch.across, stretch.down, cv::INTER_CUBIC);
    const auto parameters = cv::aruco::DetectorParameters::create();
    parameters->minMarkerPerimeterRate = kLeastPerimeter * stretch.across;
    ReadMarkers read;
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> names;
    cv::aruco::detectMarkers(stretched, board->dictionary, corners, names, parameters);
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (static_cast<std::size_t>(names[i]) >= board->ids.size()) {
            continue;
        }
        for (cv::Point2f& corner : corners[i]) {
            corner.x = (corner.x + 0.5F) / static_cast<float>(stretch.across) - 0.5F;
            corner.y = (corner.y + 0.5F) / static_cast<float>(stretch.down) - 0.5F;
        }
        read.names.push_back(names[i]);
        read.corners.push_back(corners[i]);
    }
    return read;
}

/// The board as it is printed, from above.
struct PrintedBoard {
    cv::Mat ink;
    int margin = 0;
};

PrintedBoard printed(const Board& board) {
    const BoardPicture drawn = draw_board(board, kSquarePixels).value();
    return {matrix_of({drawn.width, drawn.height, drawn.pixels}, board.is_inverted), drawn.margin};
}

// Where the corners of marker `name` are printed; clockwise from its own top left.
std::vector<cv::Point2f> marker_corners(const cv::Ptr<cv::aruco::CharucoBoard>& board,
                                        const PrintedBoard& print,
                                        int name) {
    const float scale = kSquarePixels / board->getSquareLength();
    const float bottom =
        static_cast<float>(board->getChessboardSize().height) * board->getSquareLength();
    std::vector<cv::Point2f> corners;
    const std::vector<cv::Point3f>& places = board->objPoints[static_cast<std::size_t>(name)];
    // OpenCV's y goes up in some versions.
    const bool goes_up = places[0].y > places[3].y;
    for (const cv::Point3f& place : places) {
        const float y = goes_up ? bottom - place.y : place.y;
        corners.emplace_back(static_cast<float>(print.margin) + scale * place.x - 0.5F,
                             static_cast<float>(print.margin) + scale * y - 0.5F);
    }
    return corners;
}

/// How the board lies in a picture.
struct Lying {
    cv::Mat picture_from_print;  // a homography; empty: not known
    double agreement = 0.0;      // of black and white with the print; correlation, [-1, 1]
};

// Moves a first guess until black and white agree best.
Lying settle(const cv::Mat& picture, const PrintedBoard& print, const cv::Mat& guess) {
    constexpr int kSteps = 60;
    constexpr double kEnough = 1e-5;
    constexpr int kSmoothing = 5;  // pixels
    Lying lying;
    guess.convertTo(lying.picture_from_print, CV_32F);
    try {
        lying.agreement =
            cv::findTransformECC(print.ink,
                                 picture,
                                 lying.picture_from_print,
                                 cv::MOTION_HOMOGRAPHY,
                                 {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, kSteps, kEnough},
                                 cv::noArray(),
                                 kSmoothing);
    } catch (const cv::Exception&) {
        lying = {};  // OpenCV's way to say that it went astray
    }
    return lying;
}

// The board by the markers that were read: by all that agree, and by each alone where that fails.
Lying lying_by(const cv::Mat& picture,
               const PrintedBoard& print,
               const cv::Ptr<cv::aruco::CharucoBoard>& board,
               const ReadMarkers& read) {
    constexpr double kMostOff = 3.0;  // pixels
    std::vector<cv::Point2f> above;
    std::vector<cv::Point2f> seen;
    for (std::size_t i = 0; i < read.names.size(); ++i) {
        const auto corners = marker_corners(board, print, read.names[i]);
        above.insert(above.end(), corners.begin(), corners.end());
        seen.insert(seen.end(), read.corners[i].begin(), read.corners[i].end());
    }
    Lying best;
    const auto try_guess = [&](const cv::Mat& guess) {
        if (guess.empty()) {
            return;
        }
        Lying lying = settle(picture, print, guess);
        if (lying.agreement > best.agreement) {
            best = std::move(lying);
        }
    };
    if (!above.empty()) {
        try_guess(cv::findHomography(above, seen, cv::RANSAC, kMostOff));
    }
    return best;
}

BoardView view_of(const Board& board,
                  const PrintedBoard& print,
                  const Lying& lying,
                  cv::Size size) {
    std::vector<cv::Point2f> above;
    for (std::size_t i = 0; i < corner_count(board); ++i) {
        const glm::dvec2 place = corner_place(board, i) * (kSquarePixels / board.square);
        above.emplace_back(static_cast<float>(print.margin + place.x - 0.5),
                           static_cast<float>(print.margin + place.y - 0.5));
    }
    std::vector<cv::Point2f> seen;
    cv::perspectiveTransform(above, seen, lying.picture_from_print);
    BoardView view;
    view.is_inverted = board.is_inverted;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const cv::Point2f& at = seen[i];
        if (at.x > 0.0F && at.y > 0.0F && at.x < static_cast<float>(size.width - 1) &&
            at.y < static_cast<float>(size.height - 1)) {
            view.corners.push_back({i, {static_cast<double>(at.x), static_cast<double>(at.y)}});
        }
    }
    return view;
}

}  // namespace

BoardView find_lying_board(const GreyPicture& picture, const Board& board) {
    if (board.kind == BoardKind::chessboard) {
        return find_board(picture, board);
    }
    if (picture.width <= 0 || picture.height <= 0) {
        return {};
    }
    use_one_thread();
    constexpr double kAgrees = 0.6;
    constexpr std::array<Stretch, 3> kStretches{{{2.0, 4.0}, {3.0, 9.0}, {1.0, 2.0}}};
    const cv::Mat seen = matrix_of(picture, board.is_inverted);
    const PrintedBoard print = printed(board);
    const cv::Ptr<cv::aruco::CharucoBoard> sought = charuco_board(board);
    for (const Stretch& stretch : kStretches) {
        const ReadMarkers read = read_markers(seen, sought, stretch);
        const Lying lying = lying_by(seen, print, sought, read);
        if (lying.agreement > kAgrees) {
            return view_of(board, print, lying, seen.size());
        }
    }
    return {};
}

}  // namespace raks::capture
