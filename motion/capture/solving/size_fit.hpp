// Size fit: bone lengths and the places of the markers, found from a dance itself.
#pragma once

#include <vector>

#include "motion/capture/solving/body_size.hpp"
#include "motion/capture/solving/frame_system.hpp"

namespace raks::capture {

/// What is known of a body before it is measured: standard deviations.
struct SizePrior {
    double whole = 1.0;             ///< height / the mannequin's, as far as it is known
    double whole_deviation = 0.15;  ///< of its logarithm
    double part_deviation = 0.03;   ///< of the logarithm of a part's length
    /// Of the logarithm of a single bone's length beyond its part's; 0: bones are as their parts
    /// have them, alike on both sides.
    double bone_deviation = 0.0;
    double marker_deviation = 0.015;  ///< of a marker's place along each axis, metres
};

/// How tall a body is / the mannequin, from the distances of its trunk's markers alone: where a fit
/// may begin. 1 where no two are seen together.
[[nodiscard]] double guess_size(const BodyModel& model,
                                const MarkerSet& markers,
                                const std::vector<FrameSight>& sights);

/// A frame's markers as a size is fitted to them. A model is never quite the body: so every marker
/// may lie a centimetre farther off, and its deviation grows, because the next frames repeat the
/// same error. Without both, lengths of which a dance hardly shows anything stray far from what is
/// usual.
[[nodiscard]] FrameSight sight_for_size(FrameSight sight);

/// Fits the size of the body and the postures of some frames together: Gauss-Newton over all of
/// them, of which each frame's posture is eliminated (Schur complement), so that the size moves
/// as if all postures followed at once. `size`: where it begins, and what its single bones are
/// likely to be. `states`: by sight; where the fit begins, and its result.
/// Cost: frames x (variables + parameters)^2 x variables, eight times.
[[nodiscard]] BodySize fit_size(const BodyModel& model,
                                const MarkerSet& markers,
                                const SizePrior& prior,
                                const FrameWeights& weights,
                                const std::vector<FrameSight>& sights,
                                BodySize size,
                                std::vector<BodyState>& states);

}  // namespace raks::capture
