#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "motion/figures/phrase_signals.hpp"
#include "motion/skeleton/pose.hpp"

/// Phrase tempo: into how many beats a phrase of motion divides, from the motion alone.
namespace raks::motion {

/// One way to count a phrase.
struct PhraseCount {
    int beats = 0;             ///< of the whole phrase, at least 2
    double bpm = 0.0;          ///< its tempo then
    double probability = 0.0;  ///< beside all other ways, [0, 1]
};

/// Ways to count a phrase of 2 beats or more at 40 to 240 BPM, the likeliest first; at least one
/// where it lasts 1.5 s or more. A phrase is likelier to have 4, 8, 16 or 32 beats (of three: 3, 6,
/// 12, 24) than another number, least an odd one, and what repeats in it to have 2, 4 or 8.
/// Deterministic. Threads: workers. Real-time: no.
[[nodiscard]] std::vector<PhraseCount> count_phrase(const PhraseSignals& signals,
                                                    int beats_per_bar = 4);

/// Whether a pose may be the one that a clip was made with: trunk, legs and elbows are straight and
/// both arms held alike. Threads: any. Real-time: no.
[[nodiscard]] bool is_rest_pose(const Pose& pose) noexcept;

/// Poses at the start that are no dance but a rest pose: nothing moves, for 0.3 s or until a leap.
/// 0 where the clip holds it throughout. Threads: any. Real-time: no.
[[nodiscard]] std::size_t leading_rest_poses(std::span<const Pose> poses,
                                             double frames_per_second) noexcept;

}  // namespace raks::motion
