#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "audio/genre/pattern_network.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Which parts of a model speak.
enum class GenreEvidence : std::uint8_t { fused, mfcc, mfcc_similarity, rhythm, sound, network };
[[nodiscard]] constexpr bool uses_mfcc(GenreEvidence evidence) noexcept {
    return evidence == GenreEvidence::fused || evidence == GenreEvidence::mfcc ||
           evidence == GenreEvidence::mfcc_similarity;
}
[[nodiscard]] constexpr bool uses_rhythm(GenreEvidence evidence) noexcept {
    return evidence == GenreEvidence::rhythm || evidence == GenreEvidence::fused;
}
[[nodiscard]] constexpr bool uses_sound(GenreEvidence evidence) noexcept {
    return evidence == GenreEvidence::sound || evidence == GenreEvidence::fused;
}
[[nodiscard]] constexpr bool uses_network(GenreEvidence evidence) noexcept {
    return evidence == GenreEvidence::network || evidence == GenreEvidence::fused;
}

/// One number for each part of the evidence.
struct EvidenceWeights {
    /// Times nats a frame by which each class' model is above the background's: 1 / temperature.
    /// Of none of the genres, which is the background, it says nothing.
    float mfcc = 0.0F;
    float rhythm = 1.0F;   ///< times ln of the rhythm network's chances
    float sound = 1.0F;    ///< times ln of the sound network's chances
    float network = 1.0F;  ///< times mean ln of the recurrent networks' chances
};

/// How the scores of a window of one length become chances: the logarithms are added with these
/// weights. Dances are told apart by other evidence than what is none of them is told from dances,
/// so that class has weights of its own. Fitted on artists that the models were not trained on.
struct GenreFusion {
    EvidenceWeights dances;
    EvidenceWeights none;
    std::array<float, PatternNetwork::kMaxClasses> offsets{};  ///< added to each class' sum
};

/// What the parts of a model say of one window; classes as in GenreModel.
struct GenreScores {
    using Values = std::array<float, PatternNetwork::kMaxClasses>;
    Values mfcc{};        ///< nats a frame
    Values similarity{};  ///< the same without the frames that all genres share; all 0 without such
                          ///< a model
    Values rhythm{};      ///< ln chance
    Values sound{};       ///< ln chance
    Values network{};     ///< mean ln chance of the hops
};

/// Nats a frame of each class above those of the last. Real-time: yes.
[[nodiscard]] GenreScores::Values nats_above_background(const GenreScores& scores,
                                                        GenreEvidence evidence,
                                                        std::size_t classes) noexcept
    RAKS_NONBLOCKING;

/// ln chances of the classes (at least one; the last is none of the genres) by some of the
/// evidence. Real-time: yes.
[[nodiscard]] GenreScores::Values fuse(const GenreScores& scores,
                                       const GenreFusion& fusion,
                                       GenreEvidence evidence,
                                       std::size_t classes) noexcept RAKS_NONBLOCKING;

}  // namespace raks::audio
