#pragma once

#include <span>
#include <vector>

#include "audio/beat/bar_belief.hpp"

namespace raks::audio {

/// Place of a beat in its bar.
struct BarPlace {
    int beats_per_bar = 4;    ///< one of BarModel::kMetres
    int position = 0;         ///< 0 on the downbeat
    float confidence = 0.0F;  ///< probability of this place, from all beats
};

/// The most likely bars of a whole song: BarBelief's places and transitions, with the best path
/// through all beats (Viterbi 1967), and how probable each of its places is (forward and backward
/// recursion, Rabiner 1989). `beats`: the product of each beat's likelihoods. The metre may
/// change at a downbeat; a bar may break off at the cost of the belief's leak.
/// Threads: any. Real-time: no.
[[nodiscard]] std::vector<BarPlace> find_bars(std::span<const BarLikelihood> beats);

}  // namespace raks::audio
