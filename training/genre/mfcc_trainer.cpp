#include "training/genre/mfcc_trainer.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/dice.hpp"
#include "models/hmm_scorer.hpp"
#include "training/hmm/hmm_training.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

using models::Frames;
using models::GaussianHmm;

constexpr int kFramesTogether = 50;  // of a stretch, 0.5 s: the unit that is drawn
constexpr double kStay = 0.9;        // initial chance to stay in a state

using Pieces = std::vector<const PieceFeatures*>;

// kFramesTogether frames from `from` on, with the selected features only: T x D.
Frames stretch_of(const PieceFeatures& piece, std::size_t from, const GenreFeatures& features) {
    const std::size_t count = std::min<std::size_t>(kFramesTogether, piece.frames.size() - from);
    Frames frames(static_cast<Eigen::Index>(count), features.dimension());
    for (std::size_t i = 0; i < count; ++i) {
        features.select(piece.frames[from + i],
                        {frames.data() + i * static_cast<std::size_t>(frames.cols()),
                         static_cast<std::size_t>(frames.cols())});
    }
    return frames;
}

/// Draws half-second stretches: every piece equally often, recordings and written music by their
/// share, up to plan.frames frames in all.
std::vector<Frames> draw_stretches(const Pieces& pieces,
                                   const GenreFeatures& features,
                                   const MfccTrainingPlan& plan,
                                   std::uint64_t stream) {
    Pieces recorded;
    Pieces written;
    // Pieces shorter than a stretch are left out.
    for (const PieceFeatures* piece : pieces) {
        if (piece->frames.size() >= static_cast<std::size_t>(kFramesTogether)) {
            (piece->is_recorded() ? recorded : written).push_back(piece);
        }
    }
    std::vector<Frames> stretches;
    if (recorded.empty() && written.empty()) {
        return stretches;
    }
    Dice dice(plan.seed, stream);
    for (int i = 0; i < plan.frames / kFramesTogether; ++i) {
        const bool is_recorded =
            written.empty() || (!recorded.empty() && dice.chance(plan.recorded_share));
        const PieceFeatures& piece =
            *dice.pick<const PieceFeatures*>(is_recorded ? recorded : written);
        const int last = static_cast<int>(piece.frames.size()) - kFramesTogether;
        stretches.push_back(
            stretch_of(piece, static_cast<std::size_t>(dice.whole(0, last)), features));
    }
    return stretches;
}

/// Start of an ergodic HMM with one Gaussian a state: means are frames drawn at random, variances
/// those of all frames.
GaussianHmm ergodic_start(const models::TrainingSet& set, int states, Dice& dice) {
    const Eigen::Index dimension = set.sequences.front().cols();
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(dimension);
    Eigen::VectorXd square = Eigen::VectorXd::Zero(dimension);
    double count = 0.0;
    for (const Frames& frames : set.sequences) {
        mean += frames.colwise().sum().transpose();
        square += frames.array().square().matrix().colwise().sum().transpose();
        count += static_cast<double>(frames.rows());
    }
    mean /= count;
    // The floor keeps a constant feature from a variance of 0.
    const Eigen::VectorXd variance = (square / count - mean.cwiseProduct(mean)).cwiseMax(1e-6);
    GaussianHmm model;
    model.initial = Eigen::VectorXd::Constant(states, 1.0 / states);
    // Staying is likely, all other states are equally likely.
    model.transition =
        Eigen::MatrixXd::Constant(states, states, states > 1 ? (1.0 - kStay) / (states - 1) : 0.0);
    model.transition.diagonal().setConstant(states > 1 ? kStay : 1.0);
    model.means.resize(states, dimension);
    model.weights = Eigen::MatrixXd::Ones(states, 1);
    for (Eigen::Index state = 0; state < states; ++state) {
        const Frames& frames = dice.pick<Frames>(set.sequences);
        const auto row = dice.whole(0, static_cast<int>(frames.rows()) - 1);
        // A single state starts at the mean; several states must differ, or Baum-Welch never parts
        // them.
        model.means.row(state) =
            states == 1 ? mean.transpose() : Eigen::RowVectorXd(frames.row(row));
        model.covariances.emplace_back(variance);
    }
    return model;
}

/// Frames in the pieces that are long enough to draw stretches from.
Eigen::Index frames_of(const Pieces& pieces) {
    Eigen::Index frames = 0;
    for (const PieceFeatures* piece : pieces) {
        const auto own = static_cast<Eigen::Index>(piece->frames.size());
        frames += own >= kFramesTogether ? own : 0;
    }
    return frames;
}

Eigen::Index frames_of(const models::TrainingSet& set) {
    Eigen::Index frames = 0;
    for (const Frames& sequence : set.sequences) {
        frames += sequence.rows();
    }
    return frames;
}

/// Trains a model by doubling its mixtures until there are enough, with Baum-Welch rounds after
/// each step. `heard`: distinct frames that the set was drawn from (it may repeat some).
Expected<GaussianHmm> train_model(models::TrainingSet set,
                                  Eigen::Index scored,
                                  const MfccTrainingPlan& plan,
                                  const std::string& name) {
    const Eigen::Index frames = std::min(scored, frames_of(set));
    const Eigen::Index dimension = set.sequences.empty() ? 0 : set.sequences.front().cols();
    // Means and variances; too few distinct frames cannot determine them.
    const Eigen::Index parameters = 2 * dimension * plan.states * plan.mixtures;
    if (frames == 0) {
        return fail(name + ": no half second of sound to learn from; add music");
    }
    if (frames < parameters) {
        return fail(
            fmt::format("{}: {} frames of sound, fewer than the {} parameters of its "
                        "model; add music or lower --states and --mixtures",
                        name,
                        frames,
                        parameters));
    }
    // The same stream for every model: genres differ by their frames only.
    Dice dice(plan.seed, 5);
    GaussianHmm model = ergodic_start(set, plan.states, dice);
    const models::BaumWelchOptions options{.iterations = plan.iterations,
                                           .tolerance = 1e-4,
                                           .variance_floor = 0.02,
                                           .threads = plan.threads};
    while (true) {
        auto trained = models::baum_welch(model, set, options);
        if (!trained) {
            return fail(name + ": " + trained.error().message);
        }
        model = std::move(trained->model);
        const auto mixtures = static_cast<int>(model.mixtures());
        if (mixtures == plan.mixtures) {
            return model;
        }
        // At most doubles, and stops at the number wanted, which need not be a power of 2.
        for (int i = mixtures; i < std::min(2 * mixtures, plan.mixtures); ++i) {
            model = models::split_heaviest(model);
        }
    }
}

/// ln of the sum of the state densities at each frame, T values: transitions do not count, so every
/// state weighs alike.
std::vector<double> densities(const models::HmmScorer& scorer, const Frames& frames) {
    const Frames emissions = scorer.log_emissions(frames);
    std::vector<double> result;
    for (Eigen::Index t = 0; t < frames.rows(); ++t) {
        result.push_back(models::log_sum(
            {emissions.data() + t * emissions.cols(), static_cast<std::size_t>(emissions.cols())}));
    }
    return result;
}

// Frames by whether their own genre's model scores highest.
struct Sorted {
    std::vector<models::TrainingSet> own;  // frames whose genre wins, as sequences of their own
    models::TrainingSet confused;
};

/// Splits each stretch into the frames where its own genre's model scores highest and the rest.
/// Ties count as won.
Expected<Sorted> sort_frames(const std::vector<models::TrainingSet>& sets,
                             const std::vector<GaussianHmm>& genres) {
    std::vector<models::HmmScorer> scorers;
    for (const GaussianHmm& genre : genres) {
        auto scorer = models::HmmScorer::create(genre);
        if (!scorer) {
            return fail(scorer.error());
        }
        scorers.push_back(std::move(*scorer));
    }
    Sorted sorted;
    sorted.own.resize(sets.size());
    for (std::size_t truth = 0; truth < sets.size(); ++truth) {
        for (const Frames& frames : sets[truth].sequences) {
            std::vector<std::vector<double>> scores;
            scores.reserve(scorers.size());
            for (const models::HmmScorer& scorer : scorers) {
                scores.push_back(densities(scorer, frames));
            }
            std::vector<Eigen::Index> won;
            std::vector<Eigen::Index> lost;
            for (Eigen::Index t = 0; t < frames.rows(); ++t) {
                // Wins against all genres at once.
                const auto at = static_cast<std::size_t>(t);
                const bool wins = std::all_of(scores.begin(), scores.end(), [&](const auto& s) {
                    return s[at] <= scores[truth][at];
                });
                (wins ? won : lost).push_back(t);
            }
            if (!won.empty()) {
                sorted.own[truth].sequences.emplace_back(frames(won, Eigen::all));
            }
            if (!lost.empty()) {
                sorted.confused.sequences.emplace_back(frames(lost, Eigen::all));
            }
        }
    }
    return sorted;
}

}  // namespace

Expected<MfccModels> train_mfcc(std::span<const PieceFeatures* const> pieces,
                                std::span<const std::size_t> classes,
                                std::span<const std::string> genres,
                                const GenreFeatures& features,
                                const MfccTrainingPlan& plan) {
    MfccModels result;
    // Every genre's frames are drawn once and used in all similarity rounds.
    std::vector<models::TrainingSet> sets(genres.size());
    models::TrainingSet all;
    for (std::size_t genre = 0; genre < genres.size(); ++genre) {
        Pieces own;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            if (classes[i] == genre) {
                own.push_back(pieces[i]);
            }
        }
        // A stream of draws for each genre.
        sets[genre].sequences = draw_stretches(own, features, plan, 10 + genre);
        auto model = train_model(sets[genre], frames_of(own), plan, genres[genre]);
        if (!model) {
            return fail(model.error());
        }
        result.genres.push_back(std::move(*model));
    }
    const Pieces every(pieces.begin(), pieces.end());
    // The background is trained on all music, none of the dances included.
    all.sequences = draw_stretches(every, features, plan, 9);
    auto background = train_model(std::move(all), frames_of(every), plan, "all music");
    if (!background) {
        return fail(background.error());
    }
    result.background = std::move(*background);
    // result.genres keep the models of all frames; `current` become sharper by each round.
    std::vector<GaussianHmm> current = result.genres;
    for (int round = 0; round < plan.similarity_rounds && genres.size() > 1; ++round) {
        auto sorted = sort_frames(sets, current);
        if (!sorted) {
            return fail(sorted.error());
        }
        const Eigen::Index confused = frames_of(sorted->confused);
        auto similarity = train_model(std::move(sorted->confused), confused, plan, "similarity");
        if (!similarity) {
            break;  // the genres confuse too few frames for a model
        }
        result.similarity = std::move(*similarity);
        for (std::size_t genre = 0; genre < current.size(); ++genre) {
            const Eigen::Index own = frames_of(sorted->own[genre]);
            if (auto model = train_model(std::move(sorted->own[genre]), own, plan, "own")) {
                current[genre] = std::move(*model);
            }
        }
    }
    return result;
}

}  // namespace raks::audio
