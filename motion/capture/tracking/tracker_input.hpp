// Tracker input: what is tracked, and how.
#pragma once

#include <optional>
#include <vector>

#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/edits.hpp"
#include "motion/capture/markers/labels.hpp"
#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/observations.hpp"

namespace raks::capture {

/// What is tracked.
struct TrackerInput {
    const Rig& rig;
    const MarkerSet& markers;
    const Observations& seen;
    const std::vector<Clock>& clocks;        ///< one for each film
    const std::vector<MarkerLabel>& labels;  ///< each marker at least once in two cameras, at one
                                             ///< moment
    const std::vector<Edit>& edits;          ///< what a person corrected; applied in order
};

/// How it is tracked.
struct TrackerOptions {
    double frames_per_second = 60.0;  ///< of the tracks
    std::optional<double>
        first_time;              ///< capture time of frame 0; none: as soon as two cameras see
    double sigma = 1.0;          ///< standard deviation of a detection's coordinates, pixels
    double acceleration = 20.0;  ///< of a marker, m/s^2: how far it may leave its prediction
    double smoothing = 12.0;     ///< the same when the tracks are smoothed afterwards
    double height = 0.0;         ///< of the dancer, metres; 0: the mannequin's
    bool check_order = true;     ///< refuse films that fit better exchanged or mirrored
};

}  // namespace raks::capture
