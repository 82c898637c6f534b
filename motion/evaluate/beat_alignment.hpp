#pragma once

#include <span>

#include "motion/evaluate/body_track.hpp"

/// The beat alignment score (BAS) in the two forms that papers report. In both a beat of the motion
/// is a local minimum of the body's speed, and a distance d to a beat scores exp(-d^2 / (2 s^2)), s
/// = 3 frames. The result depends on the frame rate: compare at 60 a second.
///
/// It is meant for reports beside those of others, not as a criterion: people dancing salsa score
/// *higher* when the beats are shifted by half a beat.
namespace raks::motion {

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

}  // namespace raks::motion
