#include "motion/capture/pictures/waist.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr std::size_t kLeastPixels = 16;
constexpr double kLeastLength2 = 2.0;  // of the variances along and across
constexpr double kNarrow = 0.8;        // of the width on both sides

struct Axes {
    glm::dvec2 centre{};
    glm::dvec2 along{1.0, 0.0};
    double ratio = 1.0;  // of the variances along and across
};

Axes axes_of(std::span<const glm::ivec2> pixels) {
    Axes axes;
    const auto count = static_cast<double>(pixels.size());
    for (const glm::ivec2& pixel : pixels) {
        axes.centre += glm::dvec2(pixel) / count;
    }
    // A pixel is a square, whose variance is 1/12.
    double xx = 1.0 / 12.0;
    double xy = 0.0;
    double yy = 1.0 / 12.0;
    for (const glm::ivec2& pixel : pixels) {
        const glm::dvec2 off = glm::dvec2(pixel) - axes.centre;
        xx += off.x * off.x / count;
        xy += off.x * off.y / count;
        yy += off.y * off.y / count;
    }
    const double middle = 0.5 * (xx + yy);
    const double spread = std::hypot(0.5 * (xx - yy), xy);
    const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
    axes.along = {std::cos(angle), std::sin(angle)};
    axes.ratio = (middle + spread) / std::max(middle - spread, 1e-9);
    return axes;
}

// How many pixels lie at each step of one pixel along the axis, smoothed over three.
std::vector<double> widths_along(std::span<const glm::ivec2> pixels,
                                 const glm::dvec2& along,
                                 double first,
                                 double last) {
    std::vector<double> counts(static_cast<std::size_t>(last - first) + 2);
    // Shared between two steps, so that a slanted spot's widths do not ripple.
    for (const glm::ivec2& pixel : pixels) {
        const double at = glm::dot(glm::dvec2(pixel), along) - first;
        const auto step = static_cast<std::size_t>(at);
        const double rest = at - std::floor(at);
        counts[step] += 1.0 - rest;
        counts[step + 1] += rest;
    }
    std::vector<double> smooth = counts;
    for (std::size_t i = 1; i + 1 < counts.size(); ++i) {
        smooth[i] = 0.25 * counts[i - 1] + 0.5 * counts[i] + 0.25 * counts[i + 1];
    }
    return smooth;
}

}  // namespace

std::optional<Waist> waist_of(std::span<const glm::ivec2> pixels) {
    if (pixels.size() < kLeastPixels) {
        return std::nullopt;
    }
    const Axes axes = axes_of(pixels);
    if (axes.ratio < kLeastLength2) {
        return std::nullopt;
    }
    double first = glm::dot(axes.centre, axes.along);
    double last = first;
    for (const glm::ivec2& pixel : pixels) {
        const double at = glm::dot(glm::dvec2(pixel), axes.along);
        first = std::min(first, at);
        last = std::max(last, at);
    }
    const std::vector<double> widths = widths_along(pixels, axes.along, first, last);
    const auto quarter = static_cast<std::ptrdiff_t>(widths.size() / 4);
    const auto narrowest = std::min_element(widths.begin() + quarter, widths.end() - quarter);
    const double left = *std::max_element(widths.begin(), narrowest + 1);
    const double right = *std::max_element(narrowest, widths.end());
    if (*narrowest >= kNarrow * std::min(left, right)) {
        return std::nullopt;
    }
    return Waist{axes.along, first + static_cast<double>(narrowest - widths.begin())};
}

}  // namespace raks::capture
