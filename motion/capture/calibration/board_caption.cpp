// The caption under a painted board: OpenCV's letters.
#include <algorithm>

#include <opencv2/imgproc.hpp>

#include "motion/capture/calibration/board_drawing.hpp"
#include "motion/capture/calibration/one_thread.hpp"

namespace raks::capture {

Expected<BoardPicture> draw_captioned_board(const Board& board, int pixels_per_square) {
    Expected<BoardPicture> plain = draw_board(board, pixels_per_square);
    if (!plain) {
        return plain;
    }
    use_one_thread();
    const int strip = pixels_per_square / 2;  // for the caption
    cv::Mat page(plain->height + strip, plain->width, CV_8UC1, cv::Scalar(255));
    for (int y = 0; y < plain->height; ++y) {
        const auto row = plain->pixels.begin() + static_cast<std::ptrdiff_t>(y) * plain->width;
        std::copy(row, row + plain->width, page.ptr<unsigned char>(y));
    }
    const std::string caption = board_caption(board);
    constexpr double kAcross = 0.9;  // of the width
    const cv::Size size = cv::getTextSize(caption, cv::FONT_HERSHEY_SIMPLEX, 1.0, 1, nullptr);
    const double scale =
        std::min(kAcross * page.cols / size.width, 0.5 * strip / static_cast<double>(size.height));
    cv::putText(page,
                caption,
                {plain->margin, plain->height + strip / 2 + cvRound(0.5 * scale * size.height)},
                cv::FONT_HERSHEY_SIMPLEX,
                scale,
                cv::Scalar(0),
                std::max(1, cvRound(1.5 * scale)),
                cv::LINE_AA);
    plain->height = page.rows;
    plain->pixels.assign(page.datastart, page.dataend);
    return plain;
}

}  // namespace raks::capture
