#include "audio/evaluate/genre_tally.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace raks::audio {
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
        auto& bins = result_.reliability;
        // A probability of exactly 1 belongs to the last tenth.
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

}  // namespace raks::audio
