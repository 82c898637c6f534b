#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "audio/genre/pattern_network.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Parts of a model whose scores count: all of them fused, or one by itself.
enum class GenreEvidence : std::uint8_t { fused, mfcc, mfcc_similarity, rhythm, sound, network };
/// Whether the HMMs' scores count.
[[nodiscard]] constexpr bool uses_mfcc(GenreEvidence evidence) noexcept {
    return evidence == GenreEvidence::fused || evidence == GenreEvidence::mfcc ||
           evidence == GenreEvidence::mfcc_similarity;
}
/// Whether the rhythm network's scores count.
[[nodiscard]] constexpr bool uses_rhythm(GenreEvidence evidence) noexcept {
    return evidence == GenreEvidence::rhythm || evidence == GenreEvidence::fused;
}
/// Whether the sound network's scores count.
[[nodiscard]] constexpr bool uses_sound(GenreEvidence evidence) noexcept {
    return evidence == GenreEvidence::sound || evidence == GenreEvidence::fused;
}
/// Whether the recurrent networks' scores count.
[[nodiscard]] constexpr bool uses_network(GenreEvidence evidence) noexcept {
    return evidence == GenreEvidence::network || evidence == GenreEvidence::fused;
}

/// One weight for each kind of evidence.
struct EvidenceWeights {
    /// Factor of the log-likelihood a frame, in nats, by which each class' HMM is above the
    /// background's: 1 / temperature. The class "none of the genres" is the background, so for it
    /// this is 0.
    float mfcc = 0.0F;
    float rhythm = 1.0F;   ///< factor of the rhythm network's ln probabilities
    float sound = 1.0F;    ///< factor of the sound network's ln probabilities
    float network = 1.0F;  ///< factor of the recurrent networks' mean ln probabilities
};

/// How the scores of a window of one length become probabilities: weighted sums of logarithms, then
/// normalized. What tells dances from each other is not what tells them from other music, so the
/// class "none of them" has weights of its own. Fitted on artists that the models were not trained
/// on.
struct GenreFusion {
    EvidenceWeights dances;                                    ///< for each genre
    EvidenceWeights none;                                      ///< for "none of the genres"
    std::array<float, PatternNetwork::kMaxClasses> offsets{};  ///< added to each class' sum
};

/// Scores of one window by each part of a model; classes as in GenreModel.
struct GenreScores {
    /// One value a class.
    using Values = std::array<float, PatternNetwork::kMaxClasses>;
    Values mfcc{};  ///< log-likelihood a frame, nats
    /// As `mfcc`, over the frames that the similarity model does not claim; all 0 without one.
    Values similarity{};
    Values rhythm{};   ///< ln probability
    Values sound{};    ///< ln probability
    Values network{};  ///< mean ln probability of the hops
};

/// Log-likelihood a frame, in nats, of each class minus that of the last, the background.
/// `classes`: at least one. Real-time: yes.
[[nodiscard]] GenreScores::Values nats_above_background(const GenreScores& scores,
                                                        GenreEvidence evidence,
                                                        std::size_t classes) noexcept
    RAKS_NONBLOCKING;

/// ln probabilities of the classes (at least one; the last is none of the genres) by this evidence.
/// exp of the values sums to 1. Real-time: yes.
[[nodiscard]] GenreScores::Values fuse(const GenreScores& scores,
                                       const GenreFusion& fusion,
                                       GenreEvidence evidence,
                                       std::size_t classes) noexcept RAKS_NONBLOCKING;

}  // namespace raks::audio
