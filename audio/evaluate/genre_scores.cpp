#include "audio/evaluate/genre_scores.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "audio/genre/genre_recognizer.hpp"
#include "audio/genre/genre_scorer.hpp"
#include "models/hmm_scorer.hpp"
#include "models/sliding_score.hpp"

namespace raks::audio {
namespace {

constexpr int kBlock = 10;  // frames in a block of SlidingScore, as in GenreRecognizer
constexpr int kBlocksASegment = BarPatterns::kSegmentHops / kBlock;

// The HMMs of a genre model over a stream of frames: sliding scores over all frames, and over the
// frames that the similarity model does not claim.
class Streams {
 public:
    explicit Streams(const GenreModel& model) : model_(model) {
        std::for_each(model.mfcc.begin(), model.mfcc.end(), [this](const auto& hmm) { add(hmm); });
        add(model.background);
        if (model.similarity) {
            similarity_ = *models::HmmScorer::create(*model.similarity);
            similarity_work_.resize(similarity_->states());
        }
        selected_.resize(static_cast<std::size_t>(model.features.dimension()));
    }

    // One frame: emissions of every class, into the sliding scores.
    void process(const MfccVector& vector) {
        model_.features.select(vector, selected_);
        double best = models::kImpossible;
        for (std::size_t c = 0; c < scorers_.size(); ++c) {
            scorers_[c].log_emissions(selected_, emissions_[c]);
            sliding_[c].process(emissions_[c]);
            // The background (the last class) does not compete with the similarity model.
            if (c < model_.genres.size()) {
                best = std::max(best, frame_density(emissions_[c]));
            }
        }
        if (!similarity_) {
            return;
        }
        // A frame that what all genres share explains best counts as no evidence: emissions of 0
        // let only time pass (inter-genre similarity, Bagci and Erzin 2007).
        similarity_->log_emissions(selected_, similarity_work_);
        const bool is_shared = frame_density(similarity_work_) > best;
        for (std::size_t c = 0; c < scorers_.size(); ++c) {
            if (is_shared) {
                std::fill(emissions_[c].begin(), emissions_[c].end(), 0.0);
            }
            sliding_rest_[c].process(emissions_[c]);
        }
    }
    // Mean log-likelihood a frame, in nats, of class `c` over the newest segments.
    [[nodiscard]] float nats(std::size_t c, int segments) const {
        return nats_of(sliding_[c], segments);
    }
    // The same without the shared frames; 0 without a similarity model.
    [[nodiscard]] float nats_of_rest(std::size_t c, int segments) const {
        return similarity_ ? nats_of(sliding_rest_[c], segments) : 0.0F;
    }

 private:
    void add(const models::GaussianHmm& hmm) {
        // As in GenreRecognizer: blocks of 100 ms, as many as the longest window has.
        const models::SlidingScore::Plan plan{.block = kBlock,
                                              .blocks = BarPatterns::kSegments * kBlocksASegment};
        scorers_.push_back(*models::HmmScorer::create(hmm));
        emissions_.emplace_back(scorers_.back().states());
        sliding_.emplace_back(scorers_.back(), plan);
        sliding_rest_.emplace_back(scorers_.back(), plan);
    }
    // Divided by the number of all frames, shared ones included: GenreRecognizer does the same.
    [[nodiscard]] static float nats_of(const models::SlidingScore& sliding, int segments) {
        const int blocks = segments * kBlocksASegment;
        return static_cast<float>(sliding.score(blocks) / (blocks * kBlock));
    }

    const GenreModel& model_;
    std::vector<models::HmmScorer> scorers_;
    std::optional<models::HmmScorer> similarity_;
    std::vector<models::SlidingScore> sliding_;
    std::vector<models::SlidingScore> sliding_rest_;
    std::vector<std::vector<double>> emissions_;
    std::vector<double> selected_;
    std::vector<double> similarity_work_;
};

}  // namespace

std::size_t class_of(std::string_view genre, std::span<const std::string> genres) noexcept {
    return static_cast<std::size_t>(std::find(genres.begin(), genres.end(), genre) -
                                    genres.begin());
}

// Weight = 1 / (windows of the piece x pieces of that class and origin x origins of that class x
// classes that occur).
std::vector<double> balanced_weights(std::span<const WindowScore* const> scores) {
    using Origin = std::pair<std::size_t, bool>;
    std::map<std::size_t, double> windows_of_piece;
    std::map<Origin, std::set<std::size_t>> pieces_of_origin;
    std::map<std::size_t, std::set<bool>> origins_of_class;
    for (const WindowScore* score : scores) {
        windows_of_piece[score->piece] += 1.0;
        pieces_of_origin[{score->truth, score->is_recorded}].insert(score->piece);
        origins_of_class[score->truth].insert(score->is_recorded);
    }
    std::vector<double> weights;
    for (const WindowScore* score : scores) {
        const std::size_t pieces = pieces_of_origin[{score->truth, score->is_recorded}].size();
        const std::size_t parts = origins_of_class[score->truth].size() * origins_of_class.size();
        weights.push_back(1.0 /
                          (windows_of_piece[score->piece] * static_cast<double>(pieces * parts)));
    }
    return weights;
}

namespace {

// Fills in the scores of the recurrent networks, hop by hop over the piece's mel magnitudes.
void score_with_networks(const GenreModel& model,
                         const PieceFeatures& piece,
                         std::span<WindowScore> scores) {
    // A segment must be a whole number of blocks for both the HMMs and the networks.
    static_assert(GenreScorer::kBlockHops == kBlock);
    GenreScorer scorer;
    std::size_t next = 0;  // index of the window; windows ascend by their ends
    for (std::size_t frame = 0; frame < piece.frames.size(); ++frame) {
        const std::span<const float> mel(piece.mel);
        scorer.next(model.networks,
                    mel.subspan(frame * BarPatterns::kMelBands)
                        .first<static_cast<std::size_t>(BarPatterns::kMelBands)>());
        const auto end = static_cast<int>(frame) + 1;
        for (; next < scores.size() && piece.windows[next].end_frame == end; ++next) {
            scorer.log_chances(piece.windows[next].segments * kBlocksASegment,
                               std::span(scores[next].network).first(model.classes()));
        }
    }
}

}  // namespace

std::vector<WindowScore> score_piece(const GenreModel& model,
                                     const PieceFeatures& piece,
                                     std::size_t piece_index) {
    // The index one past the genres is the class "none of them".
    const std::size_t truth = class_of(piece.genre, model.genres);
    std::vector<WindowScore> scores;
    if (piece.windows.empty()) {
        return scores;  // silence, or too short
    }
    scores.reserve(piece.windows.size());
    for (const WindowFeatures& window : piece.windows) {
        WindowScore& score = scores.emplace_back();
        score.piece = piece_index;
        score.truth = truth;
        score.is_recorded = piece.is_recorded();
        score.window = static_cast<std::size_t>(
            std::find(kGenreWindows.begin(), kGenreWindows.end(), window.segments) -
            kGenreWindows.begin());
        std::array<float, PatternNetwork::kInputs> inputs{};
        // Pattern networks need no stream: each window carries its bar-pattern features.
        model.rhythm.standardize(window.features, window.segments, inputs);
        model.rhythm.log_chances(inputs, std::span(score.rhythm).first(model.classes()));
        model.sound.standardize(window.features, window.segments, inputs);
        model.sound.log_chances(inputs, std::span(score.sound).first(model.classes()));
    }
    score_with_networks(model, piece, scores);
    Streams streams(model);
    std::size_t next = 0;  // index of the window; windows ascend by their ends
    // SlidingScore knows a window's score one block after its end: the last frame is repeated for
    // that long.
    for (std::size_t frame = 0; frame < piece.frames.size() + kBlock; ++frame) {
        streams.process(piece.frames[std::min(frame, piece.frames.size() - 1)]);
        const auto end = static_cast<int>(frame) + 1 - kBlock;
        for (; next < scores.size() && piece.windows[next].end_frame == end; ++next) {
            const int segments = piece.windows[next].segments;
            for (std::size_t c = 0; c < model.classes(); ++c) {
                scores[next].mfcc[c] = streams.nats(c, segments);
                scores[next].similarity[c] = streams.nats_of_rest(c, segments);
            }
        }
    }
    return scores;
}

}  // namespace raks::audio
