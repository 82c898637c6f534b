#include "training/figures/state_selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/parallel.hpp"
#include "models/hmm_scorer.hpp"
#include "motion/figures/figure_hmm.hpp"
#include "training/figures/repeat_features.hpp"
#include "training/hmm/hmm_training.hpp"

namespace raks::motion {
namespace {

/// Splits the clips that have repeats into folds: clip indices, dealt out in turn.
std::vector<std::vector<std::size_t>> folds_of(std::span<const FigureRepeat> repeats,
                                               std::size_t most_folds) {
    std::vector<std::size_t> takes;
    for (const FigureRepeat& repeat : repeats) {
        if (std::find(takes.begin(), takes.end(), repeat.clip) == takes.end()) {
            takes.push_back(repeat.clip);
        }
    }
    std::vector<std::vector<std::size_t>> folds(std::min(takes.size(), most_folds));
    for (std::size_t i = 0; i < takes.size(); ++i) {
        folds[i % folds.size()].push_back(takes[i]);
    }
    return folds;
}

/// Training set and held-out sequences of one part in one fold.
struct FoldFrames {
    models::TrainingSet training;
    std::vector<models::Frames> held_out;
};

// Held-out repeats enter neither the training set nor the joint means that define the features.
FoldFrames frames_of_fold(Part which,
                          std::span<const std::vector<Pose>> phased,
                          std::span<const FigureRepeat> repeats,
                          std::span<const std::size_t> left_out,
                          const FigureTrainingOptions& training) {
    const auto is_left_out = [&](const FigureRepeat& repeat) {
        return std::find(left_out.begin(), left_out.end(), repeat.clip) != left_out.end();
    };
    std::vector<std::vector<Pose>> learnt_from;
    FoldFrames fold;
    for (std::size_t r = 0; r < repeats.size(); ++r) {
        if (!is_left_out(repeats[r])) {
            learnt_from.push_back(phased[r]);
            fold.training.weights.push_back(repeats[r].weight);
        }
    }
    // The joints' mean rotations are part of the model, so only training repeats define them.
    const PartModel joints =
        mean_joints(which, learnt_from, fold.training.weights, training.features);
    for (const std::vector<Pose>& poses : learnt_from) {
        fold.training.sequences.push_back(part_frames(poses, joints, training.samples_per_beat));
    }
    for (std::size_t r = 0; r < repeats.size(); ++r) {
        if (is_left_out(repeats[r])) {
            fold.held_out.push_back(part_frames(phased[r], joints, training.samples_per_beat));
        }
    }
    return fold;
}

/// Sum over sequences of the mean log-likelihood of a sample.
double sum_of_means(const models::HmmScorer& scorer, std::span<const models::Frames> sequences) {
    double sum = 0.0;
    for (const models::Frames& frames : sequences) {
        sum += models::log_likelihood(scorer, frames) / static_cast<double>(frames.rows());
    }
    return sum;
}

// Scores of one number of states on one fold. Sums, not means, so that folds of different size
// weigh by their repeats.
struct FoldScore {
    double training = 0.0;  ///< sums of means
    double held_out = 0.0;
    std::optional<Error> error;
};

// Trains with that many states and scores both sides of the fold.
FoldScore score_of(const FoldFrames& fold, int states, const FigureTrainingOptions& training) {
    StateLearning learning = training.learning();
    learning.states = states;
    const Expected<models::TrainingResult> learnt = learn_states(fold.training, learning);
    if (!learnt) {
        return {0.0, 0.0, learnt.error()};
    }
    const Expected<models::HmmScorer> scorer = models::HmmScorer::create(learnt->model);
    if (!scorer) {
        return {0.0, 0.0, scorer.error()};
    }
    return {sum_of_means(*scorer, fold.training.sequences),
            sum_of_means(*scorer, fold.held_out),
            std::nullopt};
}

// The range of states and the number of folds; check_training has checked the rest.
Expected<void> check(std::span<const FigureRepeat> repeats,
                     const FigureTrainingOptions& training,
                     const StateSelectionOptions& options,
                     std::size_t folds) {
    const int samples = training.beats * training.samples_per_beat;
    if (options.fewest < 1 || options.most < options.fewest || options.most > samples) {
        return fail(fmt::format("states from {} to {}, must rise and lie in [1, {}]",
                                options.fewest,
                                options.most,
                                samples));
    }
    if (folds < 2) {
        return fail(
            fmt::format("{} {} of one take only: the number of states is judged by takes "
                        "left out, so give at least two",
                        repeats.size(),
                        repeats.size() == 1 ? "repeat" : "repeats"));
    }
    return {};
}

}  // namespace

void choose_states(PartSelection& part, double saturation) {
    const auto by_held_out = [](const StatesTried& a, const StatesTried& b) {
        return a.held_out < b.held_out;
    };
    const auto best = std::max_element(part.tried.begin(), part.tried.end(), by_held_out);
    // The gain up to the peak only: numbers of states after the peak do not count.
    const double worst = std::min_element(part.tried.begin(), best + 1, by_held_out)->held_out;
    const double enough = best->held_out - saturation * (best->held_out - worst);
    // The first of the rising numbers that is good enough, thus the smallest model.
    part.peak = best->states;
    part.chosen = std::find_if(part.tried.begin(), part.tried.end(), [&](const StatesTried& tried) {
                      return tried.held_out >= enough;
                  })->states;
}

Expected<StateSelection> select_states(std::span<const TrainingClip> clips,
                                       std::span<const FigureRepeat> repeats,
                                       const FigureTrainingOptions& training,
                                       const StateSelectionOptions& options) {
    if (auto ok = check_training(clips, repeats, training); !ok) {
        return fail(std::move(ok.error()));
    }
    const auto folds = folds_of(repeats, options.most_folds);
    if (auto ok = check(repeats, training, options, folds.size()); !ok) {
        return fail(std::move(ok.error()));
    }
    const std::vector<std::vector<Pose>> phased =
        phased_repeats(clips, repeats, training.samples_per_beat, training.low_pass_hz);
    // Jobs: parts x folds for the features, then x numbers of states for training. Every job writes
    // its own slot, so the number of threads does not change a bit.
    const std::span<const Part> parts = parts_of(training.features);
    std::vector<FoldFrames> frames(parts.size() * folds.size());
    run_parallel(frames.size(), options.threads, [&](std::size_t i) {
        frames[i] = frames_of_fold(
            parts[i / folds.size()], phased, repeats, folds[i % folds.size()], training);
    });
    const std::size_t numbers =
        static_cast<std::size_t>(options.most) + 1 - static_cast<std::size_t>(options.fewest);
    std::vector<FoldScore> scores(frames.size() * numbers);
    run_parallel(scores.size(), options.threads, [&](std::size_t i) {
        scores[i] =
            score_of(frames[i / numbers], options.fewest + static_cast<int>(i % numbers), training);
    });

    StateSelection selection;
    for (const std::vector<std::size_t>& fold : folds) {
        std::vector<std::string>& takes = selection.folds.emplace_back();
        for (const std::size_t clip : fold) {
            takes.push_back(clips[clip].name);
        }
    }
    // Every repeat is held out once, and trains in all other folds.
    const double all = static_cast<double>(repeats.size());
    const double in_training = all * static_cast<double>(folds.size() - 1);
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const auto name = static_cast<std::size_t>(parts[p]);
        PartSelection& part = selection.parts[name];
        for (std::size_t n = 0; n < numbers; ++n) {
            StatesTried tried{.states = options.fewest + static_cast<int>(n)};
            for (std::size_t f = 0; f < folds.size(); ++f) {
                const FoldScore& score = scores[(p * folds.size() + f) * numbers + n];
                if (score.error) {
                    return fail(Error(*score.error).in(std::string(kPartNames[name])));
                }
                tried.training += score.training / in_training;
                tried.held_out += score.held_out / all;
            }
            part.tried.push_back(tried);
        }
        choose_states(part, options.saturation);
    }
    return selection;
}

}  // namespace raks::motion
