#include "motion/capture/calibration/board_detection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "motion/capture/calibration/charuco_board.hpp"
#include "motion/capture/calibration/one_thread.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {

namespace {

// One of the four ways to look at a picture.
struct Look {
    bool is_mirrored = false;
    bool is_inverted = false;
};

cv::Mat matrix_of(const GreyPicture& picture, const Look& look) {
    cv::Mat copy(picture.height, picture.width, CV_8UC1);
    const auto row_bytes = static_cast<std::size_t>(picture.width);
    for (int y = 0; y < picture.height; ++y) {
        const auto row = picture.pixels.subspan(static_cast<std::size_t>(y) * row_bytes, row_bytes);
        std::copy(row.begin(), row.end(), copy.ptr<unsigned char>(y));
    }
    if (look.is_mirrored) {
        cv::flip(copy, copy, 1);
    }
    if (look.is_inverted) {
        cv::bitwise_not(copy, copy);
    }
    return copy;
}

bool is_sound(const GreyPicture& picture) noexcept {
    constexpr int kLargestSide = 20'000;
    return picture.width > 0 && picture.height > 0 && picture.width <= kLargestSide &&
           picture.height <= kLargestSide &&
           picture.pixels.size() >=
               static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
}

// The shortest edge between neighbours, in pixels; where none are: infinite.
double shortest_edge(const Board& board, const std::vector<BoardCorner>& corners) {
    std::vector<const BoardCorner*> at(corner_count(board), nullptr);
    for (const BoardCorner& corner : corners) {
        at[corner.corner] = &corner;
    }
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : board_edges(board)) {
        if (at[from] != nullptr && at[to] != nullptr) {
            shortest = std::min(shortest, glm::distance(at[from]->pixel, at[to]->pixel));
        }
    }
    return shortest;
}

std::vector<cv::Point2f> pixels_of(const std::vector<BoardCorner>& corners) {
    std::vector<cv::Point2f> pixels;
    pixels.reserve(corners.size());
    for (const BoardCorner& corner : corners) {
        pixels.emplace_back(static_cast<float>(corner.pixel.x), static_cast<float>(corner.pixel.y));
    }
    return pixels;
}

// Half the side of the window in which corners are refined, for a shortest edge so long; pixels.
int window_side(const Board& board, double edge) {
    constexpr double kSmallestWindow = 2.0;
    constexpr double kLargestWindow = 11.0;
    // Of a tilted square the sides are nearer than its corners: on OpenCV's 26 pictures the
    // reprojection is 0.18 px with a third of the edge, 0.28 with 0.4, 0.40 with a half.
    double share = 1.0 / 3.0;
    if (board.kind == BoardKind::charuco) {
        // A marker within the window draws the corner: with OpenCV's own windows by up to 0.9 px in
        // sharp pictures, with its margin by 0.2. (In blurred ones the larger window is better.)
        share = std::min(share, 0.5 * (board.square - board.marker) / board.square);
    }
    return static_cast<int>(std::clamp(share * edge, kSmallestWindow, kLargestWindow));
}

void refine(const cv::Mat& picture,
            const Board& board,
            CornerWindow window,
            std::vector<BoardCorner>& corners) {
    constexpr int kClassicSide = 11;
    const bool is_classic = window == CornerWindow::classic;
    const double edge = shortest_edge(board, corners);
    const int side = is_classic ? kClassicSide : window_side(board, edge);
    // The window must fit into the picture; corners without neighbours have no measure for it.
    if (corners.empty() || !std::isfinite(edge) || picture.cols < 2 * side + 5 ||
        picture.rows < 2 * side + 5) {
        return;
    }
    const cv::TermCriteria stop(cv::TermCriteria::COUNT + cv::TermCriteria::EPS,
                                is_classic ? 30 : 60,
                                is_classic ? 0.1 : 0.01);
    std::vector<cv::Point2f> pixels = pixels_of(corners);
    cv::cornerSubPix(picture, pixels, cv::Size(side, side), cv::Size(-1, -1), stop);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i].pixel = {static_cast<double>(pixels[i].x), static_cast<double>(pixels[i].y)};
    }
}

// Drops corners that are off the plane of most by more than a lens bends it.
void drop_strays(const Board& board, std::vector<BoardCorner>& corners) {
    if (corners.size() <= kFewestBoardCorners) {
        return;  // nothing to compare them with
    }
    constexpr double kOfSquare = 0.2;
    constexpr double kLeast = 2.0;  // pixels
    const double shortest = shortest_edge(board, corners);
    const double allowed =
        std::isfinite(shortest) ? std::max(kLeast, kOfSquare * shortest) : kLeast;
    std::vector<cv::Point2f> places;
    for (const BoardCorner& corner : corners) {
        const glm::dvec2 place = corner_place(board, corner.corner) / board.square;
        places.emplace_back(static_cast<float>(place.x), static_cast<float>(place.y));
    }
    std::vector<unsigned char> fits;
    const cv::Mat plane = cv::findHomography(places, pixels_of(corners), cv::RANSAC, allowed, fits);
    if (plane.empty()) {
        return;  // all in one row
    }
    std::vector<BoardCorner> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (fits[i] != 0) {
            kept.push_back(corners[i]);
        }
    }
    corners = std::move(kept);
}

// Corners between markers.
BoardView find_charuco(const cv::Mat& picture, const Board& board, CornerWindow window) {
    const cv::Ptr<cv::aruco::CharucoBoard> sought = charuco_board(board);
    std::vector<std::vector<cv::Point2f>> markers;
    std::vector<int> names;
    cv::aruco::detectMarkers(picture, sought->dictionary, markers, names);
    BoardView view;
    view.foreign_markers =
        static_cast<std::size_t>(std::count_if(names.begin(), names.end(), [&](int name) {
            return static_cast<std::size_t>(name) >= sought->ids.size();
        }));
    if (names.empty()) {
        return view;
    }
    std::vector<cv::Point2f> pixels;
    std::vector<int> corners;
    cv::aruco::interpolateCornersCharuco(markers, names, picture, sought, pixels, corners);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        view.corners.push_back(
            {static_cast<std::size_t>(corners[i]),
             {static_cast<double>(pixels[i].x), static_cast<double>(pixels[i].y)}});
    }
    drop_strays(board, view.corners);
    if (view.is_found()) {
        refine(picture, board, window, view.corners);
    }
    return view;
}

// Whether the square below and to the right of the first corner is darker than the one beside it.
bool begins_dark(const cv::Mat& picture, const Board& board, const std::vector<cv::Point2f>& at) {
    const auto across = static_cast<std::size_t>(board.columns - 1);
    double dark = 0.0;
    double light = 0.0;
    for (std::size_t row = 0; row + 1 < at.size() / across; ++row) {
        for (std::size_t column = 0; column + 1 < across; ++column) {
            const std::size_t i = row * across + column;
            const cv::Point2f centre =
                (at[i] + at[i + 1] + at[i + across] + at[i + across + 1]) / 4;
            const int x = std::clamp(cvRound(centre.x), 0, picture.cols - 1);
            const int y = std::clamp(cvRound(centre.y), 0, picture.rows - 1);
            ((row + column) % 2 == 0 ? dark : light) += picture.at<unsigned char>(y, x);
        }
    }
    return dark < light;
}

// Brings corners into the order of the board: rows run to the right when columns run down, and the
// square in the top left corner is black.
void put_in_order(const cv::Mat& picture, const Board& board, std::vector<cv::Point2f>& corners) {
    const auto across = static_cast<std::ptrdiff_t>(board.columns - 1);
    const cv::Point2f right = corners[static_cast<std::size_t>(across - 1)] - corners.front();
    const cv::Point2f down =
        corners[corners.size() - static_cast<std::size_t>(across)] - corners.front();
    if (right.x * down.y - right.y * down.x < 0.0F) {
        for (auto row = corners.begin(); row != corners.end(); row += across) {
            std::reverse(row, row + across);
        }
    }
    // The inner square at the first corner has the colour of the outer one that touches it there.
    if (!begins_dark(picture, board, corners)) {
        std::reverse(corners.begin(), corners.end());
    }
}

BoardView find_chessboard(const cv::Mat& picture, const Board& board, CornerWindow window) {
    std::vector<cv::Point2f> corners;
    BoardView view;
    if (!cv::findChessboardCorners(picture,
                                   cv::Size(board.columns - 1, board.rows - 1),
                                   corners,
                                   cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE |
                                       cv::CALIB_CB_FAST_CHECK)) {
        return view;
    }
    put_in_order(picture, board, corners);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        view.corners.push_back(
            {i, {static_cast<double>(corners[i].x), static_cast<double>(corners[i].y)}});
    }
    refine(picture, board, window, view.corners);
    return view;
}

BoardView found_by(const GreyPicture& picture,
                   const Board& board,
                   const Look& look,
                   CornerWindow window) {
    const cv::Mat seen = matrix_of(picture, look);
    BoardView view = board.kind == BoardKind::charuco ? find_charuco(seen, board, window)
                                                      : find_chessboard(seen, board, window);
    view.is_mirrored = look.is_mirrored;
    view.is_inverted = look.is_inverted;
    if (look.is_mirrored) {
        for (BoardCorner& corner : view.corners) {
            corner.pixel.x = picture.width - 1 - corner.pixel.x;
        }
    }
    return view;
}

}  // namespace

BoardView find_board(const GreyPicture& picture, const Board& board, CornerWindow window) {
    if (!is_sound(picture)) {
        return {};
    }
    use_one_thread();
    if (board.kind == BoardKind::chessboard) {
        return found_by(picture, board, {false, board.is_inverted}, window);
    }
    BoardView best;
    std::size_t foreign = 0;
    for (const bool is_inverted : {board.is_inverted, !board.is_inverted}) {
        for (const bool is_mirrored : {false, true}) {
            BoardView view = found_by(picture, board, {is_mirrored, is_inverted}, window);
            foreign = std::max(foreign, view.foreign_markers);
            if (view.corners.size() > best.corners.size()) {
                best = std::move(view);
            }
            // Looked at wrongly, a board shows a chance corner or two, not so many.
            constexpr std::size_t kSurely = 6;
            if (best.corners.size() >= kSurely) {
                best.foreign_markers = foreign;
                return best;
            }
        }
    }
    best.foreign_markers = foreign;
    return best;
}

std::string_view guess_dictionary(const GreyPicture& picture) {
    if (!is_sound(picture)) {
        return {};
    }
    use_one_thread();
    constexpr std::size_t kFewestMarkers = 4;
    std::string_view best;
    std::size_t most = kFewestMarkers - 1;
    const std::vector<std::string_view> names = dictionary_names();
    for (std::size_t i = 0; i < names.size(); ++i) {
        for (const Look& look : {Look{false, false}, Look{false, true}}) {
            std::vector<std::vector<cv::Point2f>> markers;
            std::vector<int> ids;
            cv::aruco::detectMarkers(matrix_of(picture, look),
                                     cv::aruco::getPredefinedDictionary(static_cast<int>(i)),
                                     markers,
                                     ids);
            if (ids.size() > most) {
                most = ids.size();
                best = names[i];
            }
        }
    }
    return best;
}

}  // namespace raks::capture
