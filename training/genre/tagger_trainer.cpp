#include "training/genre/tagger_trainer.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <utility>

#include "audio/evaluate/genre_scores.hpp"
#include "audio/genre/pattern_network.hpp"
#include "training/networks/adam.hpp"

namespace raks::audio {
namespace {

constexpr double kRowWeight = 0.001;  // of a row's likelihood beside half the squared weights
constexpr int kSteps = 500;
constexpr double kRate = 0.02;
constexpr std::size_t kFolds = 10;

std::string letters_of(std::string_view text) {
    std::string letters;
    for (const char each : text) {
        const auto letter = static_cast<unsigned char>(each);
        if (std::isalnum(letter) != 0) {
            letters.push_back(static_cast<char>(std::tolower(letter)));
        }
    }
    return letters;
}

// Standardized embeddings with their classes and weights.
struct Rows {
    std::vector<std::array<double, kTagFeatures>> inputs;
    std::vector<std::size_t> classes;
    std::vector<double> weights;
};

Rows rows_of(std::span<const TaggedPiece* const> pieces, std::span<const std::string> genres) {
    Rows rows;
    std::vector<double> counts(genres.size() + 1, 0.0);
    for (const TaggedPiece* piece : pieces) {
        for (const auto& patch : piece->patches) {
            std::copy(patch.begin(), patch.end(), rows.inputs.emplace_back().begin());
            rows.classes.push_back(class_of(piece->genre, genres));
            counts[rows.classes.back()] += 1.0;
        }
    }
    const double even =
        static_cast<double>(rows.inputs.size()) / static_cast<double>(counts.size());
    for (const std::size_t own : rows.classes) {
        rows.weights.push_back(kRowWeight * std::sqrt(even / counts[own]));
    }
    return rows;
}

void standardize(Rows& rows, const TaggerClasses& tagger) {
    for (auto& row : rows.inputs) {
        for (std::size_t i = 0; i < kTagFeatures; ++i) {
            row[i] = (row[i] - static_cast<double>(tagger.mean[i])) /
                     static_cast<double>(tagger.deviation[i]);
        }
    }
}

void standardize_by_itself(Rows& rows, TaggerClasses& tagger) {
    constexpr double kLeast = 1e-5;
    const auto n = static_cast<double>(rows.inputs.size());
    for (std::size_t i = 0; i < kTagFeatures; ++i) {
        double mean = 0.0;
        double square = 0.0;
        for (const auto& row : rows.inputs) {
            mean += row[i] / n;
        }
        for (const auto& row : rows.inputs) {
            square += (row[i] - mean) * (row[i] - mean) / n;
        }
        const double deviation = std::max(kLeast, std::sqrt(square));
        for (auto& row : rows.inputs) {
            row[i] = (row[i] - mean) / deviation;
        }
        tagger.mean.push_back(static_cast<float>(mean));
        tagger.deviation.push_back(static_cast<float>(deviation));
    }
}

// Weights (classes x features), and then biases; `held`: how many of them, from the first on, the
// penalty holds near `centre`.
struct Penalty {
    std::vector<double> centre;
    std::size_t held = 0;
};

// Slope of the penalized likelihood.
void add_slopes(const Rows& rows,
                std::size_t classes,
                const Penalty& penalty,
                const std::vector<double>& numbers,
                std::vector<double>& slopes) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        slopes[i] = i < penalty.held ? numbers[i] - penalty.centre[i] : 0.0;
    }
    std::vector<double> chances(classes);
    for (std::size_t r = 0; r < rows.inputs.size(); ++r) {
        double most = -1e300;
        for (std::size_t c = 0; c < classes; ++c) {
            double sum = numbers[classes * kTagFeatures + c];
            for (std::size_t i = 0; i < kTagFeatures; ++i) {
                sum += numbers[c * kTagFeatures + i] * rows.inputs[r][i];
            }
            chances[c] = sum;
            most = std::max(most, sum);
        }
        double all = 0.0;
        for (double& chance : chances) {
            chance = std::exp(chance - most);
            all += chance;
        }
        for (std::size_t c = 0; c < classes; ++c) {
            const double off =
                rows.weights[r] * (chances[c] / all - (c == rows.classes[r] ? 1.0 : 0.0));
            for (std::size_t i = 0; i < kTagFeatures; ++i) {
                slopes[c * kTagFeatures + i] += off * rows.inputs[r][i];
            }
            slopes[classes * kTagFeatures + c] += off;
        }
    }
}

// The numbers at which the penalized likelihood is greatest, from the centre on.
void climb(const Rows& rows, const Penalty& penalty, TaggerClasses& tagger) {
    const std::size_t classes = penalty.centre.size() / (kTagFeatures + 1);
    std::vector<double> numbers = penalty.centre;
    std::vector<double> slopes(numbers.size());
    Adam<double> adam(numbers.size());
    for (int step = 0; step < kSteps; ++step) {
        add_slopes(rows, classes, penalty, numbers, slopes);
        adam.step(slopes, kRate * (1.0 - static_cast<double>(step) / (kSteps + 1)), numbers);
    }
    const auto biases = numbers.begin() + static_cast<std::ptrdiff_t>(classes * kTagFeatures);
    tagger.weights.assign(numbers.begin(), biases);
    tagger.bias.assign(biases, numbers.end());
}

constexpr const char* kTooShort =
    "none of the music lasts for the 3 s that the tagger hears at once";

// Fold of each group: the largest first, each to the fold with the fewest pieces.
std::map<std::string, std::size_t> fold_of_groups(std::span<const TaggedPiece> pieces) {
    std::map<std::string, int> sizes;
    for (const TaggedPiece& piece : pieces) {
        ++sizes[piece.group];
    }
    std::vector<std::pair<int, std::string>> order;
    order.reserve(sizes.size());
    for (const auto& [group, size] : sizes) {
        order.emplace_back(-size, group);
    }
    std::sort(order.begin(), order.end());
    std::array<int, kFolds> loads{};
    std::map<std::string, std::size_t> folds;
    for (const auto& [size, group] : order) {
        const auto lightest = std::min_element(loads.begin(), loads.end());
        folds[group] = static_cast<std::size_t>(lightest - loads.begin());
        *lightest -= size;
    }
    return folds;
}

}  // namespace

bool tagger_knows(std::string_view dance) {
    return std::any_of(kTagNames.begin(), kTagNames.end(), [&](std::string_view tag) {
        return letters_of(tag) == letters_of(dance);
    });
}

Expected<TaggerClasses> fit_tagger(std::span<const TaggedPiece* const> pieces,
                                   std::span<const std::string> genres) {
    const std::size_t classes = genres.size() + 1;
    Rows rows = rows_of(pieces, genres);
    if (rows.inputs.empty()) {
        return fail(kTooShort);
    }
    TaggerClasses tagger;
    standardize_by_itself(rows, tagger);
    climb(rows,
          {std::vector<double>(classes * (kTagFeatures + 1), 0.0), classes * kTagFeatures},
          tagger);
    for (const std::string& genre : genres) {
        tagger.knows.push_back(tagger_knows(genre));
    }
    tagger.knows.push_back(true);  // none of the dances
    return tagger;
}

Expected<TaggerClasses> adapt_tagger(const TaggerClasses& base,
                                     std::span<const TaggedPiece* const> pieces,
                                     std::span<const std::string> genres) {
    if (auto fits = validate(base, genres.size() + 1); !fits) {
        return fail(fits.error());
    }
    Rows rows = rows_of(pieces, genres);
    if (rows.inputs.empty()) {
        return fail(kTooShort);
    }
    standardize(rows, base);
    std::vector<double> centre(base.weights.begin(), base.weights.end());
    centre.insert(centre.end(), base.bias.begin(), base.bias.end());
    const std::size_t held = centre.size();
    TaggerClasses tagger = base;
    climb(rows, {std::move(centre), held}, tagger);
    return tagger;
}

Expected<std::vector<std::vector<float>>> held_out_tagger(std::span<const TaggedPiece> pieces,
                                                          std::span<const std::string> genres) {
    const std::map<std::string, std::size_t> folds = fold_of_groups(pieces);
    std::vector<std::vector<float>> means(pieces.size(), std::vector<float>(genres.size() + 1));
    for (std::size_t fold = 0; fold < kFolds; ++fold) {
        std::vector<const TaggedPiece*> learnt;
        for (const TaggedPiece& piece : pieces) {
            if (folds.at(piece.group) != fold) {
                learnt.push_back(&piece);
            }
        }
        const auto tagger = fit_tagger(learnt, genres);
        if (!tagger) {
            return fail(tagger.error());
        }
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            if (folds.at(pieces[i].group) != fold) {
                continue;
            }
            std::vector<float> logs(genres.size() + 1);
            for (const auto& patch : pieces[i].patches) {
                tagger->log_chances(patch, logs);
                for (std::size_t c = 0; c < logs.size(); ++c) {
                    means[i][c] += logs[c] / static_cast<float>(pieces[i].patches.size());
                }
            }
        }
    }
    return means;
}

}  // namespace raks::audio
