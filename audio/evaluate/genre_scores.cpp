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

namespace {

// The class with the greatest ln probability among those asked for.
std::size_t best_of(const GenreScores::Values& logs, std::span<const std::size_t> among) {
    return *std::max_element(among.begin(), among.end(), [&](std::size_t a, std::size_t b) {
        return logs[a] < logs[b];
    });
}

// Area under the ROC curve by ranks (Mann-Whitney): the probability that a `positive` value is
// above a `negative` one, ties counting half. Without values on one side: 0.5, chance.
double area_under_curve(const std::vector<float>& positive, const std::vector<float>& negative) {
    if (positive.empty() || negative.empty()) {
        return 0.5;
    }
    std::vector<float> sorted = negative;
    std::sort(sorted.begin(), sorted.end());
    double above = 0.0;
    for (const float value : positive) {
        const auto [low, high] = std::equal_range(sorted.begin(), sorted.end(), value);
        above += static_cast<double>(low - sorted.begin()) + 0.5 * static_cast<double>(high - low);
    }
    return above / (static_cast<double>(positive.size()) * static_cast<double>(negative.size()));
}

// Adds up windows one by one; finish() turns sums into shares.
class TallyMaker {
 public:
    TallyMaker(std::span<const std::string> genres,
               std::span<const std::size_t> asked,
               std::span<const std::string> pair)
        // An unknown or missing name gives the class "none", which add() takes as "no pair".
        : asked_(asked),
          classes_(genres.size() + 1),
          two_{class_of(pair.empty() ? std::string() : pair[0], genres),
               class_of(pair.empty() ? std::string() : pair[1], genres)},
          right_(classes_),
          all_(classes_) {
        result_.confusion.assign(classes_, std::vector<double>(classes_));
        result_.pieces.assign(classes_, 0);
    }

    // `weight`: by balanced_weights, so that classes and pieces count alike.
    void add(const WindowScore& score, const GenreScores::Values& logs, double weight) {
        ++result_.windows;
        class_of_piece_[score.piece] = score.truth;
        // The ranking value for "none of them" is that class' ln probability.
        (score.truth + 1 == classes_ ? unknown_ : known_).push_back(logs[classes_ - 1]);
        if (std::find(asked_.begin(), asked_.end(), score.truth) != asked_.end()) {
            add_asked(score, logs, weight);
        }
        const std::size_t none = classes_ - 1;
        const auto* const side = std::find(two_.begin(), two_.end(), score.truth);
        if (side != two_.end() && two_[0] < none && two_[1] < none) {
            const auto at = static_cast<std::size_t>(side - two_.begin());
            two_all_[at] += weight;
            two_right_[at] += best_of(logs, two_) == score.truth ? weight : 0.0;
        }
    }

    // Divides sums by weights; to be called once.
    GenreTally finish() {
        for (const auto& [piece, truth] : class_of_piece_) {
            ++result_.pieces[truth];
        }
        // Classes without a piece drop out of the mean: their recall is undefined.
        double classes_seen = 0.0;
        double weight_seen = 0.0;
        for (const std::size_t c : asked_) {
            if (all_[c] <= 0.0) {
                continue;
            }
            result_.macro_recall += right_[c] / all_[c];
            classes_seen += 1.0;
            weight_seen += all_[c];
            for (double& share : result_.confusion[c]) {
                share /= all_[c];
            }
        }
        result_.macro_recall /= std::max(classes_seen, 1.0);
        if (two_all_[0] > 0.0 && two_all_[1] > 0.0) {
            result_.two_dances = 0.5 * (two_right_[0] / two_all_[0] + two_right_[1] / two_all_[1]);
        }
        result_.auroc_unknown = area_under_curve(unknown_, known_);
        // |accuracy - confidence| of each bin, weighted by the bin's share of the windows.
        for (const GenreTally::Bin& bin : result_.reliability) {
            result_.calibration_error +=
                std::abs(bin.right - bin.chance) / std::max(weight_seen, 1e-12);
        }
        return std::move(result_);
    }

 private:
    // Decision, confusion and calibration of one window among the asked classes.
    void add_asked(const WindowScore& score, const GenreScores::Values& logs, double weight) {
        const std::size_t decided = best_of(logs, asked_);
        const bool is_right = decided == score.truth;
        all_[score.truth] += weight;
        right_[score.truth] += is_right ? weight : 0.0;
        result_.confusion[score.truth][decided] += weight;
        // Probabilities among the asked classes alone: the others are excluded from the decision,
        // so the fused values are normalized anew. The small start avoids a division by 0.
        double total = 1e-12;
        for (const std::size_t c : asked_) {
            total += std::exp(static_cast<double>(logs[c]));
        }
        const double chance = std::exp(static_cast<double>(logs[decided])) / total;
        GenreTally::Bin& bin = result_.reliability[reliability_bin(static_cast<float>(chance))];
        bin.weight += weight;
        bin.chance += weight * chance;
        bin.right += is_right ? weight : 0.0;
    }

    std::span<const std::size_t> asked_;
    std::size_t classes_;
    std::array<std::size_t, 2> two_;
    GenreTally result_;
    std::vector<double> right_;
    std::vector<double> all_;
    std::map<std::size_t, std::size_t> class_of_piece_;
    std::vector<float> unknown_;
    std::vector<float> known_;
    std::array<double, 2> two_right_{};
    std::array<double, 2> two_all_{};
};

}  // namespace

GenreTally tally(std::span<const WindowScore> scores,
                 std::span<const GenreScores::Values> log_chances,
                 std::size_t window,
                 std::span<const std::string> genres,
                 std::span<const std::size_t> asked,
                 std::span<const std::string> pair) {
    // Weights are balanced within one window length: others would count a piece again.
    std::vector<const WindowScore*> used;
    std::vector<const GenreScores::Values*> logs;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        if (scores[i].window == window) {
            used.push_back(&scores[i]);
            logs.push_back(&log_chances[i]);
        }
    }
    const std::vector<double> weights = balanced_weights(used);
    TallyMaker maker(genres, asked, pair);
    for (std::size_t i = 0; i < used.size(); ++i) {
        maker.add(*used[i], *logs[i], weights[i]);
    }
    return maker.finish();
}

PieceScores whole_pieces(std::span<const WindowScore> scores,
                         std::span<const GenreScores::Values> log_chances,
                         std::size_t window) {
    PieceScores pieces;
    std::map<std::pair<std::size_t, bool>, std::size_t> places;  // by piece; written ones apart
    std::vector<float> counts;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        if (scores[i].window != window) {
            continue;
        }
        const auto [place, is_new] =
            places.try_emplace({scores[i].piece, scores[i].is_recorded}, pieces.scores.size());
        if (is_new) {
            pieces.scores.push_back(scores[i]);
            pieces.log_chances.emplace_back();
            counts.push_back(0.0F);
        }
        counts[place->second] += 1.0F;
        for (std::size_t c = 0; c < log_chances[i].size(); ++c) {
            pieces.log_chances[place->second][c] += log_chances[i][c];
        }
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
        for (float& value : pieces.log_chances[i]) {
            value /= counts[i];
        }
    }
    return pieces;
}

}  // namespace raks::audio
