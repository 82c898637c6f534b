// Key moments: where a dance can be stopped.
#pragma once

#include "base/beats.hpp"
#include "base/realtime.hpp"
#include "motion/dance/dance_sequence.hpp"

namespace raks::motion {

/// The calmest moment of the dance from one phase to another, of those in which both feet stand;
/// without any the calmest of all. Threads: any. Real-time: yes (some ten poses).
[[nodiscard]] Beats key_moment(const DanceSequence& sequence,
                               Beats from,
                               Beats to) noexcept RAKS_NONBLOCKING;

/// Until when both feet stand, from a phase on and at most to another. Threads: any. Real-time: yes
/// (five poses a beat).
[[nodiscard]] Beats stands_until(const DanceSequence& sequence,
                                 Beats from,
                                 Beats to) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
