#pragma once

#include "motion/evaluate/body_track.hpp"

/// Two published metrics for sliding feet, defined at 30 frames a second: a track of another rate
/// is thinned to every round(rate / 30)th frame first.
namespace raks::motion {

/// Physical foot contact (PFC; Tseng 2023, EDGE, eval_pfc.py), times 10,000, in its units of
/// metres^2: mean over frames of (the slower of left ankle and toe tip, metres a frame over the
/// floor) x (the same of the right) x (hips' acceleration, its downward part left out, as a share
/// of its largest). That largest makes it fragile: one fault of the capture changes it tenfold. 0
/// for less than 3 frames at 30 a second, and for hips that never accelerate.
/// Threads: workers. Real-time: no.
[[nodiscard]] double physical_foot_contact(const BodyTrack& track);

/// Foot skating ratio (Li 2024, Lodge, foot_skating.py), mean of both feet: among the frames with
/// the ankle at most 8 cm and the toe tip at most 5 cm over the floor (5th percentile of the toe
/// tip's height), the share in which either has |vx + vz| / 2 over 1 cm a frame. (Slides along one
/// diagonal cancel out and are missed.) Threads: workers. Real-time: no.
[[nodiscard]] double foot_skating_ratio(const BodyTrack& track);

}  // namespace raks::motion
