// Posture search: a body from the spots of one frame alone, without labels or a frame before.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "motion/capture/angles/frame_marks.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/solving/body_model.hpp"
#include "motion/capture/solving/frame_system.hpp"
#include "motion/capture/tracking/frame_views.hpp"

namespace raks::capture {

/// What is searched.
struct SearchedFrame {
    const Rig& rig;
    const std::vector<SeenSpot>& spots;       ///< of the frame
    const std::vector<std::size_t>& classes;  ///< by marker: its colour
    const FrameMarks& marks;                  ///< the same spots
    double sigma = 1.0;                       ///< error of a spot, pixels of its camera
};

/// Looks for the body in a frame: places that spots of one colour agree on are taken for three
/// markers of the trunk in every way that the distances on the body allow; where the whole trunk
/// fits best, limbs are fitted to the places that are left, as one finds a body from nothing
/// (find_frame). `at_least`: share of the trunk's markers that must be seen by two pictures within
/// 12 pixels. None: nothing fits so well.
[[nodiscard]] std::optional<BodyState> search_posture(const FrameContext& context,
                                                      const SearchedFrame& frame,
                                                      double at_least);

/// Share of these markers that two or more pictures see within `gate` pixels of where a posture has
/// them; 0 of no marker.
[[nodiscard]] double seen_share(const std::vector<glm::dvec3>& places,
                                const FrameMarks& marks,
                                const std::vector<std::size_t>& markers,
                                double gate);

}  // namespace raks::capture
