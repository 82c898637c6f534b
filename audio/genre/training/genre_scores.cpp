#include "audio/genre/training/genre_scores.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "audio/genre/genre_listener.hpp"
#include "models/hmm_scorer.hpp"
#include "models/sliding_score.hpp"

namespace raks::audio {
namespace {

constexpr int kBlock = 10;  // frames
constexpr int kBlocksASegment = BarPatterns::kSegmentHops / kBlock;

/// The models of a genre model, streaming, with and without the frames that all genres share.
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

    void process(const MfccVector& vector) {
        model_.features.select(vector, selected_);
        double best = models::kImpossible;
        for (std::size_t c = 0; c < scorers_.size(); ++c) {
            scorers_[c].log_emissions(selected_, emissions_[c]);
            sliding_[c].process(emissions_[c]);
            if (c < model_.genres.size()) {
                best = std::max(best, frame_density(emissions_[c]));
            }
        }
        if (!similarity_) {
            return;
        }
        similarity_->log_emissions(selected_, similarity_work_);
        const bool is_shared = frame_density(similarity_work_) > best;
        for (std::size_t c = 0; c < scorers_.size(); ++c) {
            if (is_shared) {
                std::fill(emissions_[c].begin(), emissions_[c].end(), 0.0);
            }
            sliding_rest_[c].process(emissions_[c]);
        }
    }
    /// Nats a frame of a class; `rest`: by the frames that are not shared.
    [[nodiscard]] float nats(std::size_t c, int segments) const {
        return nats_of(sliding_[c], segments);
    }
    [[nodiscard]] float nats_of_rest(std::size_t c, int segments) const {
        return similarity_ ? nats_of(sliding_rest_[c], segments) : 0.0F;
    }

 private:
    void add(const models::GaussianHmm& hmm) {
        const models::SlidingScore::Plan plan{.block = kBlock,
                                              .blocks = BarPatterns::kSegments * kBlocksASegment};
        scorers_.push_back(*models::HmmScorer::create(hmm));
        emissions_.emplace_back(scorers_.back().states());
        sliding_.emplace_back(scorers_.back(), plan);
        sliding_rest_.emplace_back(scorers_.back(), plan);
    }
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

/// Weight of each window: classes alike, in each recordings and written music alike, pieces alike.
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

std::size_t best_of(const WindowScore::Values& logs, std::span<const std::size_t> among) {
    return *std::max_element(among.begin(), among.end(), [&](std::size_t a, std::size_t b) {
        return logs[a] < logs[b];
    });
}

/// Area under the curve by ranks: the chance that a `positive` value is above a `negative` one.
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

}  // namespace

std::size_t class_of(Genre genre, std::span<const Genre> genres) noexcept {
    return static_cast<std::size_t>(std::find(genres.begin(), genres.end(), genre) -
                                    genres.begin());
}

namespace {

void hear_with_network(const GenreModel& model,
                       const HeardPiece& piece,
                       std::span<WindowScore> scores) {
    static_assert(GenreListener::kBlockHops == kBlock);
    GenreListener listener;
    std::size_t next = 0;  // window; they ascend by their ends
    for (std::size_t frame = 0; frame < piece.frames.size(); ++frame) {
        const std::span<const float> mel(piece.mel);
        listener.next(model.network,
                      mel.subspan(frame * BarPatterns::kMelBands)
                          .first<static_cast<std::size_t>(BarPatterns::kMelBands)>());
        const auto end = static_cast<int>(frame) + 1;
        for (; next < scores.size() && piece.windows[next].end_frame == end; ++next) {
            listener.log_chances(piece.windows[next].segments * kBlocksASegment,
                                 std::span(scores[next].network).first(model.classes()));
        }
    }
}

}  // namespace

std::vector<WindowScore> score_piece(const GenreModel& model,
                                     const HeardPiece& piece,
                                     std::size_t piece_index) {
    const std::size_t truth = class_of(piece.genre, model.genres);
    std::vector<WindowScore> scores;
    if (piece.windows.empty()) {
        return scores;  // silence, or too short
    }
    scores.reserve(piece.windows.size());
    for (const HeardWindow& window : piece.windows) {
        WindowScore& score = scores.emplace_back();
        score.piece = piece_index;
        score.truth = truth;
        score.is_recorded = piece.is_recorded();
        score.window = static_cast<std::size_t>(
            std::find(kGenreWindows.begin(), kGenreWindows.end(), window.segments) -
            kGenreWindows.begin());
        std::array<float, PatternNetwork::kInputs> inputs{};
        model.rhythm.standardize(window.features, window.segments, inputs);
        model.rhythm.log_chances(inputs, std::span(score.rhythm).first(model.classes()));
        model.sound.standardize(window.features, window.segments, inputs);
        model.sound.log_chances(inputs, std::span(score.sound).first(model.classes()));
    }
    hear_with_network(model, piece, scores);
    Streams streams(model);
    std::size_t next = 0;  // window; they ascend by their ends
    // The scores of a window are known one block after its end: the last frame is held that long.
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

WindowScore::Values fuse(const WindowScore& score,
                         const GenreFusion& fusion,
                         GenreEvidence evidence,
                         std::size_t classes) {
    WindowScore::Values logs{};
    const auto& mfcc = evidence == GenreEvidence::mfcc_similarity ? score.similarity : score.mfcc;
    for (std::size_t c = 0; c < classes; ++c) {
        logs[c] = (uses_mfcc(evidence) ? fusion.mfcc * mfcc[c] : 0.0F) +
                  (uses_rhythm(evidence) ? fusion.rhythm * score.rhythm[c] : 0.0F) +
                  (uses_sound(evidence) ? fusion.sound * score.sound[c] : 0.0F) +
                  (uses_network(evidence) ? fusion.network * score.network[c] : 0.0F);
    }
    logs[classes - 1] += fusion.unknown;
    normalize_logs(std::span(logs).first(classes));
    return logs;
}

namespace {

/// Slope of the weighted negative log-likelihood in (mfcc, rhythm, sound, network, unknown).
std::array<double, 5> fusion_slope(std::span<const WindowScore* const> scores,
                                   const std::vector<double>& weights,
                                   const GenreFusion& fusion,
                                   GenreEvidence evidence,
                                   std::size_t classes) {
    std::array<double, 5> slope{};
    for (std::size_t i = 0; i < scores.size(); ++i) {
        const WindowScore& score = *scores[i];
        const auto logs = fuse(score, fusion, evidence, classes);
        const auto& mfcc =
            evidence == GenreEvidence::mfcc_similarity ? score.similarity : score.mfcc;
        for (std::size_t c = 0; c < classes; ++c) {
            const double wanted = c == score.truth ? 1.0 : 0.0;
            const double error = weights[i] * (std::exp(static_cast<double>(logs[c])) - wanted);
            slope[0] += error * static_cast<double>(mfcc[c]);
            slope[1] += error * static_cast<double>(score.rhythm[c]);
            slope[2] += error * static_cast<double>(score.sound[c]);
            slope[3] += error * static_cast<double>(score.network[c]);
            slope[4] += c + 1 == classes ? error : 0.0;
        }
    }
    return slope;
}

}  // namespace

GenreFusion fit_fusion(std::span<const WindowScore> scores,
                       std::size_t window,
                       std::size_t classes,
                       GenreEvidence evidence) {
    std::vector<const WindowScore*> used;
    for (const WindowScore& score : scores) {
        if (score.window == window) {
            used.push_back(&score);
        }
    }
    GenreFusion fusion{uses_mfcc(evidence) ? 1.0F : 0.0F,
                       uses_rhythm(evidence) ? 1.0F : 0.0F,
                       uses_sound(evidence) ? 1.0F : 0.0F,
                       uses_network(evidence) ? 1.0F : 0.0F,
                       0.0F};
    const std::vector<double> weights = balanced_weights(used);
    // Adam on five numbers; the likelihood is concave in them.
    std::array<double, 5> first{};
    std::array<double, 5> second{};
    constexpr int kSteps = 300;
    for (int step = 1; step <= kSteps && !used.empty(); ++step) {
        const auto slope = fusion_slope(used, weights, fusion, evidence, classes);
        const std::array<float*, 5> values = {
            &fusion.mfcc, &fusion.rhythm, &fusion.sound, &fusion.network, &fusion.unknown};
        for (std::size_t k = 0; k < values.size(); ++k) {
            first[k] = 0.9 * first[k] + 0.1 * slope[k];
            second[k] = 0.99 * second[k] + 0.01 * slope[k] * slope[k];
            const double rate = 0.08 * (1.0 - static_cast<double>(step) / (kSteps + 1));
            const double change = rate * first[k] / (1.0 - std::pow(0.9, step)) /
                                  (std::sqrt(second[k] / (1.0 - std::pow(0.99, step))) + 1e-9);
            *values[k] -= static_cast<float>(change);
        }
        fusion.mfcc = uses_mfcc(evidence) ? std::max(0.0F, fusion.mfcc) : 0.0F;
        fusion.rhythm = uses_rhythm(evidence) ? std::max(0.0F, fusion.rhythm) : 0.0F;
        fusion.sound = uses_sound(evidence) ? std::max(0.0F, fusion.sound) : 0.0F;
        fusion.network = uses_network(evidence) ? std::max(0.0F, fusion.network) : 0.0F;
    }
    return fusion;
}

namespace {

/// Adds up windows one by one.
class TallyMaker {
 public:
    TallyMaker(std::span<const Genre> genres, std::span<const std::size_t> asked)
        : asked_(asked),
          classes_(genres.size() + 1),
          two_{class_of(Genre::salsa, genres), class_of(Genre::belly, genres)},
          right_(classes_),
          all_(classes_) {
        result_.confusion.assign(classes_, std::vector<double>(classes_));
        result_.pieces.assign(classes_, 0);
    }

    void add(const WindowScore& score, const WindowScore::Values& logs, double weight) {
        ++result_.windows;
        class_of_piece_[score.piece] = score.truth;
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

    GenreTally finish() {
        for (const auto& [piece, truth] : class_of_piece_) {
            ++result_.pieces[truth];
        }
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
        for (const GenreTally::Bin& bin : result_.reliability) {
            result_.calibration_error +=
                std::abs(bin.right - bin.chance) / std::max(weight_seen, 1e-12);
        }
        return std::move(result_);
    }

 private:
    void add_asked(const WindowScore& score, const WindowScore::Values& logs, double weight) {
        const std::size_t decided = best_of(logs, asked_);
        const bool is_right = decided == score.truth;
        all_[score.truth] += weight;
        right_[score.truth] += is_right ? weight : 0.0;
        result_.confusion[score.truth][decided] += weight;
        double total = 1e-12;
        for (const std::size_t c : asked_) {
            total += std::exp(static_cast<double>(logs[c]));
        }
        const double chance = std::exp(static_cast<double>(logs[decided])) / total;
        auto& bins = result_.reliability;
        const auto tenth = static_cast<std::size_t>(chance * static_cast<double>(bins.size()));
        GenreTally::Bin& bin = bins[std::min(bins.size() - 1, tenth)];
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
                 std::span<const WindowScore::Values> log_chances,
                 std::size_t window,
                 std::span<const Genre> genres,
                 std::span<const std::size_t> asked) {
    std::vector<const WindowScore*> used;
    std::vector<const WindowScore::Values*> logs;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        if (scores[i].window == window) {
            used.push_back(&scores[i]);
            logs.push_back(&log_chances[i]);
        }
    }
    const std::vector<double> weights = balanced_weights(used);
    TallyMaker maker(genres, asked);
    for (std::size_t i = 0; i < used.size(); ++i) {
        maker.add(*used[i], *logs[i], weights[i]);
    }
    return maker.finish();
}

}  // namespace raks::audio
