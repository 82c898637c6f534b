#include "motion/capture/calibration/lens_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <opencv2/calib3d.hpp>

#include "base/statistics.hpp"
#include "motion/capture/calibration/one_thread.hpp"
#include "motion/capture/camera/rotation.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {

namespace {

constexpr std::size_t kFewestLensCorners = 6;
constexpr std::size_t kFewestViews = 3;
constexpr double kLargeRms = 1.0;  // pixels: above that, something is wrong

// The views that are used, as OpenCV wants them.
struct UsedViews {
    std::vector<std::vector<cv::Point3f>> places;
    std::vector<std::vector<cv::Point2f>> pixels;
    std::vector<std::size_t> numbers;  // of the views
};

// Seen in line, corners say nothing.
bool is_of_use(const Board& board, const std::vector<BoardCorner>& corners) {
    const auto row_of = [&](const BoardCorner& c) { return corner_place(board, c.corner).y; };
    const auto column_of = [&](const BoardCorner& c) { return corner_place(board, c.corner).x; };
    return corners.size() >= kFewestLensCorners &&
           std::any_of(
               corners.begin(),
               corners.end(),
               [&](const BoardCorner& c) { return row_of(c) != row_of(corners.front()); }) &&
           std::any_of(corners.begin(), corners.end(), [&](const BoardCorner& c) {
               return column_of(c) != column_of(corners.front());
           });
}

UsedViews used_views(const Board& board, const std::vector<std::vector<BoardCorner>>& views) {
    UsedViews used;
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (!is_of_use(board, views[i])) {
            continue;
        }
        used.numbers.push_back(i);
        used.places.emplace_back();
        used.pixels.emplace_back();
        for (const BoardCorner& corner : views[i]) {
            const glm::dvec2 place = corner_place(board, corner.corner);
            used.places.back().emplace_back(
                static_cast<float>(place.x), static_cast<float>(place.y), 0.0F);
            used.pixels.back().emplace_back(static_cast<float>(corner.pixel.x),
                                            static_cast<float>(corner.pixel.y));
        }
    }
    return used;
}

Lens lens_of(int width, int height, const cv::Mat& matrix, const cv::Mat& distortion) {
    Lens lens{width,
              height,
              matrix.at<double>(0, 0),
              matrix.at<double>(1, 1),
              matrix.at<double>(0, 2),
              matrix.at<double>(1, 2),
              {}};
    for (std::size_t i = 0; i < std::min<std::size_t>(8, distortion.total()); ++i) {
        lens.distortion[i] = distortion.at<double>(static_cast<int>(i));
    }
    return lens;
}

bool is_finite(const Lens& lens) noexcept {
    return std::isfinite(lens.fx) && std::isfinite(lens.fy) && std::isfinite(lens.cx) &&
           std::isfinite(lens.cy) && lens.fx > 0.0 && lens.fy > 0.0 &&
           std::all_of(lens.distortion.begin(), lens.distortion.end(), [](double k) {
               return std::isfinite(k);
           });
}

// The largest angle between a board's normal and the first one's, as the camera saw them; radians.
double spread_of(const std::vector<cv::Mat>& turns) {
    const auto normal_of = [](const cv::Mat& turn) {
        return rotation_of({turn.at<double>(0), turn.at<double>(1), turn.at<double>(2)})[2];
    };
    const glm::dvec3 first = normal_of(turns.front());
    double widest = 0.0;
    for (const cv::Mat& turn : turns) {
        // From behind a board is no other pose.
        const double along = std::abs(glm::dot(first, normal_of(turn)));
        widest = std::max(widest, std::acos(std::min(along, 1.0)));
    }
    return widest;
}

// A lens and where the boards were, as OpenCV found them.
struct Solution {
    double rms = 0.0;
    cv::Mat matrix;
    cv::Mat distortion;
    cv::Mat deviations;
    cv::Mat view_errors;
    std::vector<cv::Mat> turns;
};

// One run of OpenCV, from the matrix of `solution` where the flags say so. False: it finds none.
bool solve(const UsedViews& used, cv::Size size, int flags, Solution& solution) {
    try {
        solution.rms = cv::calibrateCamera(used.places,
                                           used.pixels,
                                           size,
                                           solution.matrix,
                                           solution.distortion,
                                           solution.turns,
                                           cv::noArray(),
                                           solution.deviations,
                                           cv::noArray(),
                                           solution.view_errors,
                                           flags);
    } catch (const cv::Exception&) {
        return false;
    }
    return std::isfinite(solution.rms);
}

// Begins with a lens of this focal length in pixels.
std::optional<Solution> solution_from(double focal,
                                      const UsedViews& used,
                                      cv::Size size,
                                      int flags) {
    Solution solution;
    solution.matrix = cv::Mat::eye(3, 3, CV_64F);
    solution.matrix.at<double>(0, 0) = focal;
    solution.matrix.at<double>(1, 1) = focal;
    solution.matrix.at<double>(0, 2) = 0.5 * (size.width - 1);
    solution.matrix.at<double>(1, 2) = 0.5 * (size.height - 1);
    if (!solve(used, size, flags | cv::CALIB_USE_INTRINSIC_GUESS, solution)) {
        return std::nullopt;
    }
    return solution;
}

// What boards at the edges of a curved lens suggest can be a focal length many times too long, from
// where no step leads back. Then usual focal lengths are tried too.
std::optional<Solution> best_solution(const UsedViews& used, cv::Size size, int flags) {
    std::optional<Solution> best(std::in_place);
    best->matrix = cv::Mat::eye(3, 3, CV_64F);
    if (!solve(used, size, flags, *best)) {
        best.reset();
    }
    for (const double widths : {0.5, 0.8, 1.3, 2.5}) {
        if (best && best->rms <= kLargeRms) {
            break;
        }
        auto other = solution_from(widths * size.width, used, size, flags);
        if (other && (!best || other->rms < best->rms)) {
            best = std::move(other);
        }
    }
    return best;
}

// Of a board of which little is seen two poses explain nearly the same; one in the wrong one of
// them bends the lens of all. Returns the views that fit; at least half of them are kept.
UsedViews views_that_fit(const UsedViews& used, const Solution& solution) {
    std::vector<double> errors(used.numbers.size());
    for (std::size_t i = 0; i < errors.size(); ++i) {
        errors[i] = solution.view_errors.at<double>(static_cast<int>(i));
    }
    const double most = std::max(kLargeRms, upper_median(errors));
    UsedViews kept;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        if (errors[i] <= most) {
            kept.numbers.push_back(used.numbers[i]);
            kept.places.push_back(used.places[i]);
            kept.pixels.push_back(used.pixels[i]);
        }
    }
    return kept;
}

void add_doubts(LensFit& fit, std::size_t views) {
    constexpr std::size_t kFewViews = 10;
    if (views < kFewViews) {
        fit.doubts.push_back(fmt::format(
            "its lens is fitted to {} views of the board only; 20 or more are better", views));
    }
    if (fit.rms > kLargeRms) {
        fit.doubts.push_back(
            fmt::format("its lens explains the board to {:.2f} px only: is the board flat, and are "
                        "the pictures "
                        "sharp?",
                        fit.rms));
    }
}

}  // namespace

Expected<LensFit> fit_lens(int width,
                           int height,
                           const Board& board,
                           const std::vector<std::vector<BoardCorner>>& views,
                           const LensFitSettings& settings) {
    UsedViews used = used_views(board, views);
    if (used.numbers.size() < kFewestViews) {
        return fail(fmt::format(
            "shows {} or more corners of the board in {} pictures only; {} or more are needed",
            kFewestLensCorners,
            used.numbers.size(),
            kFewestViews));
    }
    use_one_thread();
    const int flags = (settings.coefficients == 8 ? cv::CALIB_RATIONAL_MODEL : 0) |
                      (settings.has_square_pixels ? cv::CALIB_FIX_ASPECT_RATIO : 0);
    auto solved = best_solution(used, cv::Size(width, height), flags);
    if (!solved) {
        return fail("its pictures of the board explain no lens: is it the right board?");
    }
    const std::size_t all = used.numbers.size();
    if (solved->rms > kLargeRms) {
        UsedViews fitting = views_that_fit(used, *solved);
        auto again = best_solution(fitting, cv::Size(width, height), flags);
        if (fitting.numbers.size() >= kFewestViews && again && again->rms <= kLargeRms) {
            used = std::move(fitting);
            solved = std::move(again);
        }
    }
    LensFit fit;
    fit.rms = solved->rms;
    const std::vector<cv::Mat>& turns = solved->turns;
    fit.lens = lens_of(width, height, solved->matrix, solved->distortion);
    fit.focal_deviation = solved->deviations.at<double>(settings.has_square_pixels ? 1 : 0);
    constexpr double kWorstFocal = 0.05;
    constexpr double kLeastSpread = 0.15;  // radians
    if (!is_finite(fit.lens) || spread_of(turns) < kLeastSpread ||
        !(fit.focal_deviation <= kWorstFocal * fit.lens.fx)) {
        return fail(
            "all boards are in nearly one pose, which does not tell the focal length: tilt the "
            "board "
            "to all sides, by 30 degrees or more");
    }
    fit.view_rms.assign(views.size(), 0.0);
    for (std::size_t i = 0; i < used.numbers.size(); ++i) {
        fit.view_rms[used.numbers[i]] = solved->view_errors.at<double>(static_cast<int>(i));
    }
    if (used.numbers.size() < all) {
        fit.doubts.push_back(fmt::format(
            "{} of its {} views of the board do not fit the others and are left out of its lens",
            all - used.numbers.size(),
            all));
    }
    add_doubts(fit, used.numbers.size());
    return fit;
}

}  // namespace raks::capture
