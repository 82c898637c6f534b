#include "training/genre/genre_trainer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.hpp"

#include "training/networks/adam.hpp"

namespace raks::audio {
namespace {

/// Deals groups to folds: in each genre the largest group first, each to the fold with the fewest
/// pieces of the genre so far. A group with several genres stays in one fold, so that no model is
/// scored on an artist that it was trained on.
std::map<std::string, int> deal_groups(std::span<const PieceFeatures> pieces,
                                       std::span<const std::string> genres,
                                       int folds) {
    std::map<std::size_t, std::map<std::string, int>> sizes;  // pieces of each group, by class
    for (const PieceFeatures& piece : pieces) {
        // Recordings and written music are dealt apart, so that each fold has its share of both.
        sizes[class_of(piece.genre, genres)][(piece.is_recorded() ? "r " : "w ") + piece.group] +=
            1;
    }
    std::map<std::string, int> fold_of;
    for (const auto& [genre, groups] : sizes) {
        std::vector<std::pair<int, std::string>> order;
        // Negative sizes: ascending order then has the largest first, ties by name.
        for (const auto& [group, size] : groups) {
            order.emplace_back(-size, group);
        }
        std::sort(order.begin(), order.end());
        // Pieces in each fold, apart for recordings ('r') and written music ('w').
        std::map<char, std::vector<int>> load;
        for (const auto& [negative_size, group] : order) {
            std::vector<int>& loads =
                load.try_emplace(group[0], static_cast<std::size_t>(folds)).first->second;
            // Dealt before, with another genre: stays there.
            const auto known = fold_of.find(group);
            const auto lightest = std::min_element(loads.begin(), loads.end()) - loads.begin();
            const int fold = known != fold_of.end() ? known->second : static_cast<int>(lightest);
            fold_of[group] = fold;
            loads[static_cast<std::size_t>(fold)] -= negative_size;
        }
    }
    return fold_of;
}

/// What the model of one fold is trained on, and what it scores.
struct Fold {
    std::vector<const PieceFeatures*> training;
    std::vector<std::size_t> held_out;  // indices; damaged recordings follow the pieces
};

// Every piece trains the models of all folds but its own.
std::vector<Fold> deal_folds(std::span<const PieceFeatures> pieces,
                             std::span<const PieceFeatures> damaged,
                             std::span<const std::string> genres,
                             int count) {
    const std::map<std::string, int> folds = deal_groups(pieces, genres, count);
    const auto fold_of = [&](const PieceFeatures& piece) {
        return static_cast<std::size_t>(
            folds.at((piece.is_recorded() ? "r " : "w ") + piece.group));
    };
    std::vector<Fold> dealt(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const std::size_t own = fold_of(pieces[i]);
        for (std::size_t fold = 0; fold < dealt.size(); ++fold) {
            if (fold != own) {
                dealt[fold].training.push_back(&pieces[i]);
            }
        }
        // Written pieces that the networks may have been trained on are not scored.
        if (pieces[i].is_recorded() || is_kept_out(pieces[i], i)) {
            dealt[own].held_out.push_back(i);
        }
    }
    for (std::size_t i = 0; i < damaged.size(); ++i) {
        dealt[fold_of(damaged[i])].held_out.push_back(pieces.size() + i);
    }
    return dealt;
}

/// Does every genre have two groups? Then something is left to train on while one is held out.
Expected<void> check_groups(std::span<const PieceFeatures> pieces,
                            std::span<const std::string> genres) {
    std::map<std::string, std::set<std::string>> groups;
    for (const PieceFeatures& piece : pieces) {
        groups[piece.genre].insert((piece.is_recorded() ? "r " : "w ") + piece.group);
    }
    for (const std::string& genre : genres) {
        if (groups[genre].size() < 2) {
            return fail(genre +
                        ": all its music is one file or by one artist, so that none can be held "
                        "out; add music, or use --no-validation");
        }
    }
    return {};
}

}  // namespace

std::vector<std::string> genres_of(std::span<const PieceFeatures> pieces,
                                   std::span<const std::string_view> order) {
    // Names in the caller's order first, then alphabetically (a set is sorted).
    std::set<std::string> left;
    for (const PieceFeatures& piece : pieces) {
        left.insert(piece.genre);
    }
    left.erase("");
    std::vector<std::string> genres;
    for (const std::string_view name : order) {
        if (left.erase(std::string(name)) > 0) {
            genres.emplace_back(name);
        }
    }
    genres.insert(genres.end(), left.begin(), left.end());
    return genres;
}

Expected<GenreModel> train_genres(std::span<const PieceFeatures* const> pieces,
                                  std::span<const std::string> genres,
                                  const GenreTrainingPlan& plan) {
    if (genres.empty()) {
        return fail("no piece is of a dance: nothing to learn");
    }
    std::vector<std::size_t> classes;
    for (const PieceFeatures* piece : pieces) {
        classes.push_back(class_of(piece->genre, genres));
    }
    GenreModel model;
    model.features = plan.features;
    model.genres.assign(genres.begin(), genres.end());
    // All parts of the model see the same classes; the last one is none of the dances.
    auto mfcc = train_mfcc(pieces, classes, genres, plan.features, plan.mfcc);
    if (!mfcc) {
        return fail(mfcc.error());
    }
    model.mfcc = std::move(mfcc->genres);
    model.background = std::move(mfcc->background);
    model.similarity = std::move(mfcc->similarity);
    model.rhythm = train_patterns(pieces, classes, genres.size() + 1, plan.rhythm);
    model.sound = train_patterns(pieces, classes, genres.size() + 1, plan.sound);
    // Networks trained on written music may come with the plan; tuning on recordings is done here.
    const auto& written = plan.written_networks;
    const std::size_t networks =
        written.empty() ? static_cast<std::size_t>(plan.network.networks) : written.size();
    for (std::size_t i = 0; i < networks; ++i) {
        const NetworkTrainingPlan own = plan.network.of_network(i);
        const auto learnt = written.empty()
                                ? std::make_shared<const models::RecurrentNetwork>(train_on_written(
                                      pieces, classes, model.classes(), own, [](const auto&) {}))
                                : written[i];
        if (learnt->outputs() != model.classes()) {
            return fail("the recurrent networks know other genres than these pieces have");
        }
        model.networks.push_back(tune_network(*learnt, pieces, classes, own));
    }
    return model;
}

Expected<std::vector<WindowScore>> cross_validate(std::span<const PieceFeatures> pieces,
                                                  std::span<const PieceFeatures> damaged,
                                                  std::span<const std::string> genres,
                                                  const GenreTrainingPlan& plan,
                                                  const std::function<void(int, int)>& on_fold) {
    if (auto enough = check_groups(pieces, genres); !enough) {
        return fail(enough.error());
    }
    const std::vector<Fold> folds = deal_folds(pieces, damaged, genres, plan.folds);
    std::vector<WindowScore> scores;
    for (int fold = 0; fold < plan.folds; ++fold) {
        // Scores of a fold come from a model that has no piece of their group.
        const std::vector<std::size_t>& held_out = folds[static_cast<std::size_t>(fold)].held_out;
        auto model = train_genres(folds[static_cast<std::size_t>(fold)].training, genres, plan);
        if (!model) {
            return fail(model.error());
        }
        // Each job fills its own slot: the order of scores does not depend on the threads.
        std::vector<std::vector<WindowScore>> parts(held_out.size());
        run_parallel(held_out.size(), plan.mfcc.threads, [&](std::size_t i) {
            const std::size_t number = held_out[i];
            const bool is_damaged = number >= pieces.size();
            parts[i] = score_piece(
                *model, is_damaged ? damaged[number - pieces.size()] : pieces[number], number);
        });
        for (std::vector<WindowScore>& part : parts) {
            for (WindowScore& score : part) {
                score.fold = fold;
                scores.push_back(score);
            }
        }
        on_fold(fold + 1, plan.folds);
    }
    return scores;
}

void calibrate(std::span<const WindowScore> held_out, GenreModel& model) {
    // Each window length has its own weights.
    for (std::size_t window = 0; window < kGenreWindows.size(); ++window) {
        model.fusion[window] = fit_fusion(held_out, window, model.classes(), GenreEvidence::fused);
    }
}

namespace {

constexpr std::size_t kWeights = 4;  // numbers in EvidenceWeights
// Weights of the dances, weights of none, an offset a class.
constexpr std::size_t kNumbers = 2 * kWeights + PatternNetwork::kMaxClasses;
using Numbers = std::array<double, kNumbers>;

// Weight of a recording against a written piece, because recordings are what is danced to. A higher
// weight improves recordings further, but then the generator's own maqsum is classified as hip-hop
// for seconds.
constexpr double kRecordedWeight = 1.5;
// L2 penalty, nats a squared nat: a few clips must not tilt a class.
constexpr double kOffsetPull = 0.1;

// Order of the weights within the vector of numbers: mfcc, rhythm, sound, network.
EvidenceWeights weights_of(const double* numbers) {
    return {static_cast<float>(numbers[0]),
            static_cast<float>(numbers[1]),
            static_cast<float>(numbers[2]),
            static_cast<float>(numbers[3])};
}

/// Unpacks the vector: weights of the dances, of none of them, then the offsets.
GenreFusion fusion_of(const Numbers& numbers) {
    GenreFusion fusion{weights_of(numbers.data()), weights_of(numbers.data() + kWeights), {}};
    std::transform(
        numbers.begin() + 2 * kWeights, numbers.end(), fusion.offsets.begin(), [](double offset) {
            return static_cast<float>(offset);
        });
    return fusion;
}

/// 1 for each weight whose evidence is used, 0 for the others.
std::array<double, kWeights> mask_of(GenreEvidence evidence) {
    return {uses_mfcc(evidence) ? 1.0 : 0.0,
            uses_rhythm(evidence) ? 1.0 : 0.0,
            uses_sound(evidence) ? 1.0 : 0.0,
            uses_network(evidence) ? 1.0 : 0.0};
}

/// Gradient of the mean negative log-likelihood plus the L2 penalty, by every number. Softmax: by a
/// class' sum it is probability minus target.
Numbers slope_of(std::span<const WindowScore* const> scores,
                 const std::vector<double>& shares,
                 const Numbers& numbers,
                 GenreEvidence evidence,
                 std::size_t classes) {
    const GenreFusion fusion = fusion_of(numbers);
    Numbers slope{};
    for (std::size_t i = 0; i < scores.size(); ++i) {
        const WindowScore& score = *scores[i];
        const auto logs = fuse(score, fusion, evidence, classes);
        const auto mfcc = nats_above_background(score, evidence, classes);
        for (std::size_t c = 0; c < classes; ++c) {
            // One-hot target; shares sum to 1 over all windows.
            const double wanted = c == score.truth ? 1.0 : 0.0;
            const double error = shares[i] * (std::exp(static_cast<double>(logs[c])) - wanted);
            // The last class is none of the dances and has weights of its own.
            double* const weights = slope.data() + (c + 1 == classes ? kWeights : 0);
            weights[0] += error * static_cast<double>(mfcc[c]);
            weights[1] += error * static_cast<double>(score.rhythm[c]);
            weights[2] += error * static_cast<double>(score.sound[c]);
            weights[3] += error * static_cast<double>(score.network[c]);
            slope[2 * kWeights + c] += error;
        }
    }
    // The penalty is on the offsets only.
    for (std::size_t k = 2 * kWeights; k < kNumbers; ++k) {
        slope[k] += 2.0 * kOffsetPull * numbers[k];
    }
    return slope;
}

/// Weight of each window in the mean: balanced, recordings heavier, sum 1.
std::vector<double> shares_of(std::span<const WindowScore* const> scores) {
    std::vector<double> shares = balanced_weights(scores);
    double sum = 0.0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        shares[i] *= scores[i]->is_recorded ? kRecordedWeight : 1.0;
        sum += shares[i];
    }
    for (double& share : shares) {
        share /= sum;
    }
    return shares;
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
    // Starts from weights of 1 for the evidence that is used and 0 for the rest.
    const std::array<double, kWeights> mask = mask_of(evidence);
    Numbers numbers{};
    std::copy(mask.begin(), mask.end(), numbers.begin());
    std::copy(mask.begin(), mask.end(), numbers.begin() + kWeights);
    const std::vector<double> shares = shares_of(used);
    // Adam on all windows at once. The log-likelihood is concave in the numbers, so no optimum is
    // merely local; the rate falls linearly to 0.
    Adam<double> adam(kNumbers, {.square_decay = 0.99, .epsilon = 1e-9});
    constexpr int kSteps = 400;
    for (int step = 1; step <= kSteps && !used.empty(); ++step) {
        const Numbers slope = slope_of(used, shares, numbers, evidence, classes);
        const double rate = 0.08 * (1.0 - static_cast<double>(step) / (kSteps + 1));
        adam.step(slope, rate, numbers);
        // Projection: unused evidence stays at 0, and no weight may become negative.
        for (std::size_t k = 0; k < 2 * kWeights; ++k) {
            numbers[k] = mask[k % kWeights] * std::max(0.0, numbers[k]);
        }
    }
    return fusion_of(numbers);
}

}  // namespace raks::audio
