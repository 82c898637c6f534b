// Published metrics: the scores of a dance that papers report, for comparison with theirs.
#pragma once

#include <span>

#include "motion/evaluate/body_track.hpp"

namespace raks::motion {

// The beat alignment score (BAS) in the two forms that papers report. In both a beat of the motion
// is a local minimum of the body's speed, and a distance d to a beat scores exp(-d^2 / (2 s^2)), s
// = 3 frames. The result depends on the frame rate: compare at 60 a second.
//
// It is meant for reports beside those of others, not as a criterion: people dancing salsa score
// *higher* when the beats are shifted by half a beat.

/// Mean over the *motion's* beats of the score to the nearest beat of the music (Li 2021, FACT;
/// google-research/mint, calculate_beat_scores.py). Beats of the motion: minima of the summed joint
/// speed that are lower than all of 10 frames to each side. 0 when either has none. `beat_times`:
/// seconds from the first frame, ascending; those beyond the track are left out. Threads: workers.
/// Real-time: no.
[[nodiscard]] double motion_beat_alignment(const BodyTrack& track,
                                           std::span<const double> beat_times);

/// Mean over the *music's* beats of the score to the nearest beat of the motion (Siyao 2022,
/// Bailando; metrics_new.py). Beats of the motion: minima of the mean joint speed under a Gaussian
/// of 5 frames. Threads: workers. Real-time: no.
[[nodiscard]] double music_beat_alignment(const BodyTrack& track,
                                          std::span<const double> beat_times);

// Two published metrics for sliding feet, defined at 30 frames a second: a track of another rate
// is thinned to every round(rate / 30)th frame first.

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
