// Distance limits: how far apart two markers of one body can be.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "motion/capture/markers/marker_set.hpp"

namespace raks::capture {

/// Two markers and the distances between them that the body allows.
struct DistanceLimit {
    std::size_t one = 0;    ///< index of a marker
    std::size_t other = 0;  ///< index of a marker, greater
    double least = 0.0;     ///< metres
    double most = 0.0;      ///< metres
    bool is_rigid = false;  ///< both lie on one bone, so that their distance stays the same
};

/// The limits of all pairs of markers that lie on one bone, or on bones that a joint or two join,
/// by the mannequin's bones scaled to `height` (metres; 0: the mannequin's), with a margin for
/// other proportions and for markers that sit elsewhere.
[[nodiscard]] std::vector<DistanceLimit> distance_limits(const MarkerSet& markers, double height);

/// Narrows limits to what a first pose shows: rigid pairs keep the distance that they have there,
/// give or take 4 cm. `places`: by marker; NaN where not known.
void narrow_to(const std::vector<glm::dvec3>& places, std::vector<DistanceLimit>& limits);

/// How many times larger than the body of these limits one is with markers at these places: the
/// middle of those factors for which most limits hold. None: fewer than 6 limits are between places
/// that are known. `places`: by marker; NaN where not known.
[[nodiscard]] std::optional<double> scale_of(const std::vector<glm::dvec3>& places,
                                             const std::vector<DistanceLimit>& limits);

}  // namespace raks::capture
