// The dictionaries of markers: OpenCV's.
#include <array>
#include <optional>

#include "motion/capture/calibration/board.hpp"
#include "motion/capture/calibration/charuco_board.hpp"

namespace raks::capture {

namespace {

// In the order of cv::aruco::PREDEFINED_DICTIONARY_NAME.
constexpr std::array<std::string_view, 21> kDictionaries = {
    "DICT_4X4_50",         "DICT_4X4_100",       "DICT_4X4_250",       "DICT_4X4_1000",
    "DICT_5X5_50",         "DICT_5X5_100",       "DICT_5X5_250",       "DICT_5X5_1000",
    "DICT_6X6_50",         "DICT_6X6_100",       "DICT_6X6_250",       "DICT_6X6_1000",
    "DICT_7X7_50",         "DICT_7X7_100",       "DICT_7X7_250",       "DICT_7X7_1000",
    "DICT_ARUCO_ORIGINAL", "DICT_APRILTAG_16h5", "DICT_APRILTAG_25h9", "DICT_APRILTAG_36h10",
    "DICT_APRILTAG_36h11"};

// Null: there is none of this name.
cv::Ptr<cv::aruco::Dictionary> dictionary_of(std::string_view name) {
    for (std::size_t i = 0; i < kDictionaries.size(); ++i) {
        if (kDictionaries[i] == name) {
            return cv::aruco::getPredefinedDictionary(static_cast<int>(i));
        }
    }
    return {};
}

}  // namespace

std::vector<std::string_view> dictionary_names() {
    return {kDictionaries.begin(), kDictionaries.end()};
}

std::size_t marker_count(std::string_view dictionary) {
    const cv::Ptr<cv::aruco::Dictionary> markers = dictionary_of(dictionary);
    return markers ? static_cast<std::size_t>(markers->bytesList.rows) : 0;
}

MarkerCells marker_cells(std::string_view dictionary, std::size_t marker) {
    const cv::Ptr<cv::aruco::Dictionary> markers = dictionary_of(dictionary);
    constexpr int kBorder = 1;
    MarkerCells cells;
    cells.side = markers->markerSize + 2 * kBorder;
    cv::Mat picture;  // one pixel a cell
    markers->drawMarker(static_cast<int>(marker), cells.side, picture, kBorder);
    for (int y = 0; y < cells.side; ++y) {
        for (int x = 0; x < cells.side; ++x) {
            cells.is_white.push_back(picture.at<unsigned char>(y, x) > 127);
        }
    }
    return cells;
}

cv::Ptr<cv::aruco::CharucoBoard> charuco_board(const Board& board) {
    return cv::aruco::CharucoBoard::create(board.columns,
                                           board.rows,
                                           static_cast<float>(board.square),
                                           static_cast<float>(board.marker),
                                           dictionary_of(board.dictionary));
}

}  // namespace raks::capture
