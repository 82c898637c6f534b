// Frame fit: the posture of one frame alone, for the smoother to start from.
#pragma once

#include "motion/capture/solving/frame_system.hpp"

namespace raks::capture {

/// Whether a bone moves with the trunk, so that its markers tell where the body is and faces.
[[nodiscard]] bool is_of_trunk(motion::Bone bone) noexcept;

/// A posture and how well it fits.
struct FittedFrame {
    BodyState state;
    double cost = 0.0;  ///< half of the weighted sum of squares
};

/// Fits one frame by Levenberg's steps from a posture near it.
[[nodiscard]] FittedFrame fit_frame(const FrameContext& context,
                                    const FrameSight& sight,
                                    const BodyState& start,
                                    int most_steps);

/// Fits one frame from nothing: the hips by the markers of the trunk, the arms from several
/// postures, of which the best is kept. `otherwise`: where fewer than 3 markers of the trunk are
/// seen, the posture whose hips are taken.
[[nodiscard]] FittedFrame find_frame(const FrameContext& context,
                                     const FrameSight& sight,
                                     const BodyState& otherwise);

/// Fits every frame, from the one in which most markers are seen forward and backward.
[[nodiscard]] std::vector<BodyState> fit_frames(const FrameContext& context,
                                                const std::vector<FrameSight>& sights);

}  // namespace raks::capture
