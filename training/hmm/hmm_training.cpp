#include "training/hmm/hmm_training.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "training/hmm/hmm_statistics.hpp"

namespace raks::models {
namespace {

// Sequences of a chunk: fixed, so that threads do not change the order of sums.
constexpr std::size_t kChunk = 32;

// 1 where the set has no weights.
double weight_of(const TrainingSet& set, std::size_t sequence) {
    return set.weights.empty() ? 1.0 : set.weights[sequence];
}

// Weights and shapes agree, all values are finite.
Expected<void> check(const TrainingSet& set, Eigen::Index dimension) {
    if (!set.weights.empty() && set.weights.size() != set.sequences.size()) {
        return fail(fmt::format("{} weights for {} sequences, must be as many or none",
                                set.weights.size(),
                                set.sequences.size()));
    }
    for (std::size_t s = 0; s < set.sequences.size(); ++s) {
        const Frames& frames = set.sequences[s];
        if (frames.cols() != dimension) {
            return fail(fmt::format(
                "sequence {} has {} features, must have {}", s, frames.cols(), dimension));
        }
        // Below 1e100, squares and sums stay finite.
        if (!(frames.rows() == 0 || (frames.allFinite() && frames.cwiseAbs().maxCoeff() < 1e100))) {
            return fail(fmt::format("sequence {} has a value that is not finite or too large", s));
        }
        if (const double weight = weight_of(set, s); !(weight >= 0.0 && std::isfinite(weight))) {
            return fail(fmt::format("weight {} is {}, must be finite and >= 0", s, weight));
        }
    }
    return {};
}

/// Floor under the variance of each feature: a share of its weighted variance over the whole set, T
/// frames of all sequences together.
Eigen::VectorXd floor_of(const TrainingSet& set,
                         Eigen::Index dimension,
                         const BaumWelchOptions& options) {
    double frames = 0.0;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(dimension);
    for (std::size_t s = 0; s < set.sequences.size(); ++s) {
        frames += weight_of(set, s) * static_cast<double>(set.sequences[s].rows());
        mean += weight_of(set, s) * set.sequences[s].colwise().sum().transpose();
    }
    if (!(frames > 0.0)) {
        return Eigen::VectorXd::Constant(dimension, options.absolute_floor);
    }
    mean /= frames;
    // A second pass about the mean, because sums of squares would cancel.
    Eigen::VectorXd variance = Eigen::VectorXd::Zero(dimension);
    for (std::size_t s = 0; s < set.sequences.size(); ++s) {
        const Frames centred = set.sequences[s].rowwise() - mean.transpose();
        variance += weight_of(set, s) * centred.cwiseAbs2().colwise().sum().transpose();
    }
    return (options.variance_floor / frames * variance).cwiseMax(options.absolute_floor);
}

// E-step of one chunk. Empty sequences and those of weight 0 are skipped.
HmmStatistics chunk_statistics(const GaussianHmm& model,
                               const HmmScorer& scorer,
                               const TrainingSet& set,
                               std::size_t chunk) {
    HmmStatistics sum = HmmStatistics::zero(model);
    const std::size_t end = std::min((chunk + 1) * kChunk, set.sequences.size());
    for (std::size_t s = chunk * kChunk; s < end; ++s) {
        if (set.sequences[s].rows() > 0 && weight_of(set, s) > 0.0) {
            sum.add(model, scorer, set.sequences[s], weight_of(set, s));
        }
    }
    return sum;
}

/// E-step. Chunks are computed on any thread in any order, and merged in their own order, so the
/// result has the same bits for any number of threads.
HmmStatistics expectations(const GaussianHmm& model,
                           const HmmScorer& scorer,
                           const TrainingSet& set,
                           int threads) {
    const std::size_t chunks = (set.sequences.size() + kChunk - 1) / kChunk;
    std::vector<HmmStatistics> results(chunks);
    run_parallel(chunks, threads, [&](std::size_t c) {
        results[c] = chunk_statistics(model, scorer, set, c);
    });
    HmmStatistics sum = HmmStatistics::zero(model);
    for (const HmmStatistics& result : results) {
        sum.merge(result);
    }
    return sum;
}

// Weighted number of frames.
double total_frames(const TrainingSet& set) {
    double frames = 0.0;
    for (std::size_t s = 0; s < set.sequences.size(); ++s) {
        frames += weight_of(set, s) * static_cast<double>(set.sequences[s].rows());
    }
    return frames;
}

/// Turns a known path into posteriors and transition counts that are all 0 or 1.
ForwardBackward certain(const std::vector<std::size_t>& path, Eigen::Index states) {
    ForwardBackward result{0.0,
                           Frames::Zero(static_cast<Eigen::Index>(path.size()), states),
                           Eigen::MatrixXd::Zero(states, states)};
    for (std::size_t t = 0; t < path.size(); ++t) {
        const Eigen::Index state = static_cast<Eigen::Index>(path[t]);
        result.posteriors(static_cast<Eigen::Index>(t), state) = 1.0;
        if (t > 0) {
            result.transitions(static_cast<Eigen::Index>(path[t - 1]), state) += 1.0;
        }
    }
    return result;
}

}  // namespace

Expected<TrainingResult> baum_welch(const GaussianHmm& start,
                                    const TrainingSet& set,
                                    const BaumWelchOptions& options) {
    if (auto ok = check(set, start.dimension()); !ok) {
        return fail(std::move(ok.error()));
    }
    const Eigen::VectorXd floor = floor_of(set, start.dimension(), options);
    TrainingResult result{start, {}, 0};
    double before = 0.0;
    // The E-step also gives the log-likelihood of the model that it starts from, so the last round
    // only evaluates.
    for (int i = 0;; ++i) {
        Expected<HmmScorer> scorer = HmmScorer::create(result.model);
        if (!scorer) {
            return fail(std::move(scorer.error()));
        }
        const HmmStatistics sum = expectations(result.model, *scorer, set, options.threads);
        if (sum.used == 0) {
            return fail(
                "no sequence that the start model can produce; give it other data or "
                "fewer states");
        }
        result.log_likelihoods.push_back(sum.log_likelihood);
        result.skipped = set.sequences.size() - sum.used;
        // The first round has nothing to compare with.
        const bool has_stalled =
            i > 0 && options.tolerance > 0.0 &&
            sum.log_likelihood - before < options.tolerance * total_frames(set);
        if (i >= options.iterations || has_stalled) {
            return result;
        }
        before = sum.log_likelihood;
        result.model = re_estimated(result.model, sum, floor);
    }
}

Expected<GaussianHmm> from_alignment(const GaussianHmm& start,
                                     const TrainingSet& set,
                                     std::span<const std::vector<std::size_t>> states_of,
                                     const BaumWelchOptions& options) {
    if (auto ok = check(set, start.dimension()); !ok) {
        return fail(std::move(ok.error()));
    }
    Expected<HmmScorer> scorer = HmmScorer::create(start);
    if (!scorer) {
        return fail(std::move(scorer.error()));
    }
    // The same M-step as Baum-Welch, with certain posteriors.
    HmmStatistics sum = HmmStatistics::zero(start);
    for (std::size_t s = 0; s < set.sequences.size(); ++s) {
        const std::size_t frames = static_cast<std::size_t>(set.sequences[s].rows());
        // One state a frame, all of them within the model.
        if (states_of.size() != set.sequences.size() || states_of[s].size() != frames) {
            return fail(fmt::format("sequence {} has no state for each of its frames", s));
        }
        if (frames == 0) {
            continue;
        }
        if (*std::max_element(states_of[s].begin(), states_of[s].end()) >= scorer->states()) {
            return fail(fmt::format("sequence {} is aligned to a state that does not exist", s));
        }
        sum.add_aligned(start,
                        *scorer,
                        set.sequences[s],
                        certain(states_of[s], start.states()),
                        weight_of(set, s));
    }
    // Paths may use transitions that the topology forbids; those stay 0.
    const auto exists = (start.transition.array() > 0.0).cast<double>();
    sum.transitions = sum.transitions.array() * exists;
    return re_estimated(start, sum, floor_of(set, start.dimension(), options));
}

Expected<GaussianHmm> sliced_start(Eigen::Index states,
                                   CovarianceType type,
                                   const TrainingSet& set,
                                   const BaumWelchOptions& options) {
    if (states < 1 || set.sequences.empty()) {
        return fail("needs at least one state and one sequence");
    }
    const std::size_t n = static_cast<std::size_t>(states);
    TrainingSet long_enough;
    std::vector<std::vector<std::size_t>> states_of;
    for (std::size_t s = 0; s < set.sequences.size(); ++s) {
        const std::size_t frames = static_cast<std::size_t>(set.sequences[s].rows());
        // A shorter sequence cannot visit every state.
        if (frames < n) {
            continue;
        }
        long_enough.sequences.push_back(set.sequences[s]);
        long_enough.weights.push_back(weight_of(set, s));
        std::vector<std::size_t> path(frames);
        for (std::size_t t = 0; t < frames; ++t) {
            path[t] = t * n / frames;
        }
        states_of.push_back(std::move(path));
    }
    if (long_enough.sequences.empty()) {
        return fail(fmt::format("no sequence has the {} frames that {} states need", n, n));
    }
    // Frames per state and sequence: the mean stay.
    const double duration =
        total_frames(long_enough) / static_cast<double>(n * long_enough.sequences.size());
    // Only the topology of this start counts: the alignment replaces chances and emissions.
    return from_alignment(left_to_right(states, set.sequences[0].cols(), type, duration),
                          long_enough,
                          states_of,
                          options);
}

Expected<GaussianHmm> segmental_start(Eigen::Index states,
                                      CovarianceType type,
                                      const TrainingSet& set,
                                      const BaumWelchOptions& options) {
    Expected<GaussianHmm> model = sliced_start(states, type, set, options);
    if (!model) {
        return model;
    }
    TrainingSet long_enough;  // one frame a state at least, or no path leads to the exit
    for (std::size_t s = 0; s < set.sequences.size(); ++s) {
        if (set.sequences[s].rows() >= states) {
            long_enough.sequences.push_back(set.sequences[s]);
            long_enough.weights.push_back(weight_of(set, s));
        }
    }
    constexpr int kMostRounds = 30;
    std::vector<std::vector<std::size_t>> before;
    for (int round = 0; round < kMostRounds; ++round) {
        const Expected<HmmScorer> scorer = HmmScorer::create(*model);
        if (!scorer) {
            return fail(scorer.error());
        }
        std::vector<std::vector<std::size_t>> paths;
        for (const Frames& frames : long_enough.sequences) {
            paths.push_back(viterbi(*scorer, scorer->log_emissions(frames)).path);
        }
        // No path has changed: the model would not change either.
        if (paths == before) {
            break;
        }
        model = from_alignment(*model, long_enough, paths, options);
        if (!model) {
            return model;
        }
        before = std::move(paths);
    }
    return model;
}

GaussianHmm split_heaviest(const GaussianHmm& model) {
    GaussianHmm split = model;
    const Eigen::Index n = model.states();
    const Eigen::Index k = model.mixtures();
    split.weights = Eigen::MatrixXd(n, k + 1);
    split.means = Eigen::MatrixXd(n * (k + 1), model.dimension());
    split.covariances.clear();
    for (Eigen::Index i = 0; i < n; ++i) {
        Eigen::Index heaviest = 0;
        model.weights.row(i).maxCoeff(&heaviest);
        // Each half gets half of the weight, so the density hardly changes.
        const double half = 0.5 * model.weights(i, heaviest);
        for (Eigen::Index c = 0; c <= k; ++c) {
            const Eigen::Index from = c < k ? c : heaviest;
            const bool is_half = from == heaviest;
            const Eigen::MatrixXd& variance =
                model.covariances[static_cast<std::size_t>(i * k + from)];
            // One standard deviation a feature; the halves move apart by 0.2 of it to each side.
            const Eigen::RowVectorXd apart = 0.2 * variance.col(0).cwiseSqrt().transpose();
            const double side = !is_half ? 0.0 : (c < k ? 1.0 : -1.0);
            split.weights(i, c) = is_half ? half : model.weights(i, from);
            split.means.row(i * (k + 1) + c) = model.means.row(i * k + from) + side * apart;
            split.covariances.push_back(variance);
        }
    }
    return split;
}

}  // namespace raks::models
