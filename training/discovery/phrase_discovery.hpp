#pragma once

#include <vector>

#include "base/expected.hpp"
#include "motion/figures/phrase_tempo.hpp"
#include "training/discovery/repeat_discovery.hpp"

/// Phrase discovery: a clip that is danced once, as one repeat.
namespace raks::motion {

/// The whole clip as one phrase, from its first pose that is no rest pose (leading_rest_poses) to
/// its last. Its beats are `options.beats`, those of `options.bpm` or of the music, or else those
/// that the motion most probably has (count_phrase): FoundRepeats::counts has all ways that are
/// worth saying. With music what lies before its first beat and behind its last one is left out,
/// with a warning.
///
/// Errors (one line): motion that is not finite, without movement, or shorter than two beats; music
/// without beats there. Deterministic. Threads: workers. Real-time: no.
[[nodiscard]] Expected<FoundRepeats> whole_phrase(const TrainingClip& clip,
                                                  const DiscoveryOptions& options = {});

/// The phrase in parts that figures can hold, each of as many whole bars as the others or one more,
/// in their order; itself where it has 64 beats or fewer. The last part has what is over.
[[nodiscard]] std::vector<FoundRepeats> phrase_parts(const FoundRepeats& phrase, int beats_per_bar);

/// Counts phrases that are danced in one dance at tempi of one octave: where a phrase may as well
/// have twice or half as many beats, it gets those with which it goes with the others.
void agree_on_octaves(const std::vector<FoundRepeats*>& phrases);

}  // namespace raks::motion
