// Frame views: the spots that all cameras saw at about one moment, and which marker is which.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/observations.hpp"
#include "motion/capture/tracking/marker_filter.hpp"
#include "motion/capture/triangulation/triangulation.hpp"

namespace raks::capture {

/// A spot in the picture of one camera.
struct SeenSpot {
    std::size_t camera = 0;
    std::size_t colour = 0;  ///< class of the markers that it may be
    glm::dvec2 pixel{};
    glm::dvec2 direction{};  ///< direction_of() the pixel
    double late = 0.0;       ///< when its picture was taken, against the frame's moment; seconds
    bool is_used = false;    ///< a marker has it
};

/// What a person said of one view of a marker at a frame.
struct SaidView {
    std::size_t frame = 0;
    std::size_t camera = 0;
    std::size_t marker = 0;
    glm::dvec2 pixel{};
    double late = 0.0;  ///< seconds
};

/// The spots of each frame: every picture belongs to the frame that is nearest in time.
class FrameViews {
 public:
    /// Film i of `seen` belongs to camera `cameras[i]` of the rig and has clock `clocks[i]`; its
    /// colour i is class `classes[i]` of the markers, those without one are passed over.
    FrameViews(const Rig& rig,
               const Observations& seen,
               const std::vector<std::size_t>& cameras,
               const std::vector<Clock>& clocks,
               const std::vector<std::optional<std::size_t>>& classes,
               double first_time,
               double frames_per_second,
               std::size_t frame_count);

    /// The spots of a frame; `is_used` is free to be set.
    [[nodiscard]] std::vector<SeenSpot>& at(std::size_t frame) noexcept { return spots_[frame]; }

    /// Forgets what a camera saw in these frames, the last included.
    void forget(std::size_t camera, std::size_t first, std::size_t last);

 private:
    std::vector<std::vector<SeenSpot>> spots_;
};

/// A spot as a view of a marker with this velocity.
[[nodiscard]] PointView view_of(const SeenSpot& spot, const glm::dvec3& velocity);

/// The spots that markers are expected at: in each camera the pairs of a marker and a spot of its
/// colour within `gate` (squared standard deviations, 2 degrees of freedom) and within 60 pixels at
/// a focal length of 600, the nearest first, each spot once. `beliefs`: by marker, at the frame's
/// moment; none: not sought. Spots that are taken are marked. Result: by marker, indices of spots.
[[nodiscard]] std::vector<std::vector<std::size_t>> match_spots(
    const Rig& rig,
    const std::vector<std::optional<MarkerBelief>>& beliefs,
    const std::vector<std::size_t>& classes,
    double sigma,
    double gate,
    std::vector<SeenSpot>& spots);

/// A place that unused spots of one colour agree on.
struct SpotAgreement {
    TriangulatedPoint point;
    std::vector<std::size_t> spots;  ///< indices
};
/// All places that unused spots of a colour in `least_views` or more cameras agree on, each within
/// 3 sigma + 1 pixels; those that most cameras see first. A spot may be part of several.
[[nodiscard]] std::vector<SpotAgreement> agreements(const Rig& rig,
                                                    const std::vector<SeenSpot>& spots,
                                                    std::size_t colour,
                                                    double sigma,
                                                    std::size_t least_views);

}  // namespace raks::capture
