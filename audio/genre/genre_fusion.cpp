#include "audio/genre/genre_fusion.hpp"

namespace raks::audio {

GenreScores::Values nats_above_background(const GenreScores& scores,
                                          GenreEvidence evidence,
                                          std::size_t classes) noexcept RAKS_NONBLOCKING {
    // Without a similarity model its scores are all 0, and so are the differences.
    const bool is_of_rest = evidence == GenreEvidence::mfcc_similarity;
    GenreScores::Values nats = is_of_rest ? scores.similarity : scores.mfcc;
    const float background = nats[classes - 1];
    for (std::size_t c = 0; c < classes; ++c) {
        nats[c] -= background;
    }
    return nats;
}

GenreScores::Values fuse(const GenreScores& scores,
                         const GenreFusion& fusion,
                         GenreEvidence evidence,
                         std::size_t classes) noexcept RAKS_NONBLOCKING {
    // The HMMs' scores enter as likelihood ratios to the background: what all music has in common
    // cancels out.
    const GenreScores::Values mfcc = nats_above_background(scores, evidence, classes);
    GenreScores::Values logs{};
    for (std::size_t c = 0; c < classes; ++c) {
        const EvidenceWeights& weights = c + 1 == classes ? fusion.none : fusion.dances;
        // A sum of weighted logarithms: a product of experts.
        logs[c] = fusion.offsets[c] + (uses_mfcc(evidence) ? weights.mfcc * mfcc[c] : 0.0F) +
                  (uses_rhythm(evidence) ? weights.rhythm * scores.rhythm[c] : 0.0F) +
                  (uses_sound(evidence) ? weights.sound * scores.sound[c] : 0.0F) +
                  (uses_network(evidence) ? weights.network * scores.network[c] : 0.0F);
    }
    // normalize_logs makes probabilities of the sums.
    normalize_logs(std::span(logs).first(classes));
    return logs;
}

}  // namespace raks::audio
