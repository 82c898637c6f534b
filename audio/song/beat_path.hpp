#pragma once

#include <span>
#include <vector>

#include "audio/beat/network/beat_network.hpp"
#include "audio/beat/pointer_states.hpp"

namespace raks::audio {

/// What is known of one hop of a song for its beats.
struct SongHop {
    float onset_strength = 0.0F;  ///< Onset::strength
    BeatEvidence evidence;        ///< of all networks, of this hop; all 0 without one
    BeatEvidence own_evidence;    ///< likewise, of our own (TrackedHop)
    bool has_evidence = false;    ///< whether a network gave it
    /// Too soft for too long to hold a beat: the pointer only moves on.
    bool is_blind = false;
};

/// One beat of a song.
struct PathBeat {
    double hop = 0.0;  ///< when it sounds, in hops from the start
    /// The pointer began anew here: this beat does not follow the one before.
    bool is_restart = false;
};

/// The most likely beats of a whole song, in order: the pointer's states and likelihoods, with the
/// best path through all hops instead of the belief after each (Viterbi 1967). The tempo may change
/// at any beat; where another song begins, the path starts anew at the cost of the pointer's leak.
///
/// Cost: about 5 us a hop; 76 bytes a hop of memory. Threads: any. Real-time: no.
[[nodiscard]] std::vector<PathBeat> find_beats(std::span<const SongHop> hops,
                                               const PointerStates& states);

/// Moves beats off the hops' raster of 10 ms: each gets the place that a steady tempo around it
/// gives it (Rauch, Tung and Striebel 1965, a Kalman filter and its smoother over place and
/// length of the beat). Sequences between restarts are smoothed by themselves.
void smooth_beats(std::vector<PathBeat>& beats);

}  // namespace raks::audio
