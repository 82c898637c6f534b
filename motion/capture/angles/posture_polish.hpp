// Posture polish: a short least-squares fit of a posture to the spots that its markers have.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/capture/angles/frame_marks.hpp"
#include "motion/capture/solving/body_model.hpp"
#include "motion/capture/solving/frame_system.hpp"

namespace raks::capture {

/// A marker and the mark that it has in a picture.
struct MatchedMark {
    std::size_t marker = 0;
    std::size_t picture = 0;
    std::size_t mark = 0;   ///< index in the frame's marks
    double distance = 0.0;  ///< pixels
};

/// In each picture the pairs of a marker and a spot that are nearest to each other first, each spot
/// and each marker once, within `gate` pixels. `places`: of the markers, world. In order of the
/// markers, then of the pictures.
[[nodiscard]] std::vector<MatchedMark> match_marks(const std::vector<glm::dvec3>& places,
                                                   const FrameMarks& marks,
                                                   double gate);

/// Likelihood::reprojection of markers at these places, with the bound c.
[[nodiscard]] double reprojection_energy(const std::vector<glm::dvec3>& places,
                                         const FrameMarks& marks,
                                         double bound);

/// Where the markers of a posture are.
[[nodiscard]] std::vector<glm::dvec3> marker_places_of(const FrameContext& context,
                                                       const BodyState& state);

/// What a posture is expected to be.
struct PosturePrior {
    const BodyState& state;
    const std::vector<double>& deviations;  ///< by variable: how far it may be from that
};

/// Improves a posture: its markers are matched with spots, and moved onto these by six steps of
/// Levenberg and Marquardt, with Cauchy's weights, three times; the prior and the limits of joints
/// hold it where little is seen. `sigma`: error of a spot, in pixels of its camera. Returns the
/// posture that it began with where the energy (bound 3 pixels) has not fallen.
[[nodiscard]] BodyState polish(const FrameContext& context,
                               const FrameMarks& marks,
                               double sigma,
                               const PosturePrior& prior,
                               const BodyState& start);

/// Fits a posture of which the frames before and after are known: as polish(), but what its prior
/// and the spots say together is what falls.
[[nodiscard]] BodyState refine(const FrameContext& context,
                               const FrameMarks& marks,
                               double sigma,
                               const PosturePrior& prior,
                               const BodyState& start);

}  // namespace raks::capture
