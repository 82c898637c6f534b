// Track run: the frame-by-frame part of the marker tracker.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "motion/capture/tracking/distance_limits.hpp"
#include "motion/capture/tracking/frame_views.hpp"
#include "motion/capture/tracking/marker_filter.hpp"

namespace raks::capture {

/// A stretch of frames of a marker.
struct MarkerStretch {
    std::size_t marker = 0;
    std::size_t first = 0;
    std::size_t last = 0;  ///< included
};

/// Two markers that are each other from a frame on.
struct MarkerSwap {
    std::size_t frame = 0;
    std::size_t one = 0;
    std::size_t other = 0;
};

/// What a run needs to know beside the spots.
struct TrackRunInput {
    const Rig* rig = nullptr;
    std::vector<std::size_t> classes;   ///< by marker: its colour
    std::vector<DistanceLimit> limits;  ///< of the body
    std::vector<SaidView> said;         ///< by a person
    std::vector<MarkerStretch> hidden;  ///< spots that are not believed
    std::vector<MarkerSwap> swaps;
    double seconds = 0.0;       ///< of a frame
    double sigma = 1.0;         ///< pixels
    double acceleration = 0.0;  ///< m/s^2
};

/// A marker at one frame of a run.
struct TrackedMarker {
    std::optional<MarkerBelief> belief;     ///< after the frame; none: not known yet
    std::optional<MeasuredPlace> measured;  ///< none: not seen by two views
    bool is_of_body = false;   ///< `measured` is where the body has it: its views are too few
    std::size_t views = 0;     ///< that count
    double residual = 0.0;     ///< RMS, pixels
    bool jumps = false;        ///< its views agree on a place that it cannot have reached
    bool contradicts = false;  ///< a place was given up since the body does not allow it
};

/// Follows all markers through all frames. Result: frames x markers, row-major.
[[nodiscard]] std::vector<TrackedMarker> run_tracker(const TrackRunInput& input,
                                                     FrameViews& views,
                                                     std::size_t frame_count);

}  // namespace raks::capture
