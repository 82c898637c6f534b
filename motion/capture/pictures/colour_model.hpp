// Colour model: how the markers of one colour look to one camera, learnt from points that were
// shown.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/pictures/chroma.hpp"

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

namespace raks::capture {

/// Squared Mahalanobis distance below which a pixel has a colour: 99 % of two dimensions.
inline constexpr double kColourGate = 9.21;

/// A Gaussian over the chroma of a colour's pixels.
struct ColourModel {
    ChromaForm form = ChromaForm::normalised;
    glm::dvec2 mean{};           ///< in units of `form`
    glm::dmat2 covariance{1.0};  ///< likewise, squared; positive definite
    double area = 0.0;           ///< of the regions it was learnt from, on average; pixels

    /// Squared Mahalanobis distance of a chroma from the mean, whose pixel has noise of this
    /// variance beside that of the colour.
    [[nodiscard]] double distance2(const glm::dvec2& chroma, double noise2 = 0.0) const noexcept {
        const glm::dvec2 off = chroma - mean;
        const double xx = covariance[0][0] + noise2;
        const double yy = covariance[1][1] + noise2;
        const double xy = covariance[0][1];
        return (yy * off.x * off.x - 2.0 * xy * off.x * off.y + xx * off.y * off.y) /
               (xx * yy - xy * xy);
    }
};

/// A pixel of a marker, as somebody clicked it or wrote it down.
struct ColourPoint {
    std::size_t picture = 0;  ///< index among the pictures given
    glm::dvec2 pixel{};       ///< within the marker
};

/// Learns a colour from points, each in one of `pictures`. A region of one normalised chroma is
/// grown around each; the Gaussian is over the pixels of all regions, each of which counts alike,
/// with 1 grey level^2 added to both variances, without which a flat marker's would be singular.
/// Errors, one line with the point: outside of its picture; too dark or burnt out there; fewer than
/// 6 pixels of one colour around it; hardly a colour; a region of more than 64 pixels across, as
/// of a wall or a dress.
[[nodiscard]] Expected<ColourModel> learn_colour(std::span<const PictureView> pictures,
                                                 std::span<const ColourPoint> points,
                                                 ChromaForm form = ChromaForm::normalised);

/// How far two colours lie apart: the smaller of the Mahalanobis distances of their means (not
/// squared). Below 6 pixels of one may pass for the other.
[[nodiscard]] double separation(const ColourModel& a, const ColourModel& b) noexcept;

/// The largest rate of adapt(), a picture.
inline constexpr double kMostAdaption = 0.02;
/// Moves the mean towards the mean chroma of markers that were found, by `rate` of the way
/// (clamped to [0, kMostAdaption]), for light that changes slowly. To be left out where fewer than
/// two cameras agree on the marker.
void adapt(ColourModel& model, const glm::dvec2& seen_mean, double rate = kMostAdaption) noexcept;

}  // namespace raks::capture
