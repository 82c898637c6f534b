#include "models/hmm_scorer.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/assert.hpp"
#include "models/whitening.hpp"

namespace raks::models {
namespace {

constexpr double kLogTwoPi = 1.8378770664093454836;  // ln 2 pi
constexpr double kNegligible = -40.0;                // 1 + exp(of less) is 1 in doubles
constexpr double kUnderflow = -745.14;               // exp(of less) is 0 in doubles

// ln of a probability; kImpossible for 0.
double log_or_impossible(double chance) noexcept {
    return chance > 0.0 ? std::log(chance) : kImpossible;
}

// exp, not computed where the result is 0 in doubles: most posteriors are.
double exp_or_zero(double log) noexcept { return log < kUnderflow ? 0.0 : std::exp(log); }

/// ln of the sum over arcs of exp(value at the other end + arc's ln), in two passes: the largest
/// term first, then the others relative to it. Most sums have two terms far apart, so terms that
/// cannot change the sum are not computed.
template <typename Value>
double log_sum_over(std::span<const HmmScorer::Arc> arcs, const Value& value) noexcept {
    double best = kImpossible;
    for (const HmmScorer::Arc& arc : arcs) {
        best = std::max(best, value(arc.state) + arc.log_chance);
    }
    if (best == kImpossible) {
        return kImpossible;
    }
    double sum = 0.0;
    for (const HmmScorer::Arc& arc : arcs) {
        const double below = value(arc.state) + arc.log_chance - best;
        sum += below == 0.0 ? 1.0 : below < kNegligible ? 0.0 : std::exp(below);
    }
    return sum == 1.0 ? best : best + std::log(sum);
}

// Row t of a table as a span.
std::span<const double> row_of(const Frames& frames, Eigen::Index t) noexcept {
    return {frames.data() + t * frames.cols(), static_cast<std::size_t>(frames.cols())};
}

std::span<double> row_of(Frames& frames, Eigen::Index t) noexcept {
    return {frames.data() + t * frames.cols(), static_cast<std::size_t>(frames.cols())};
}

/// Forward variables, T x N: ln alpha (Rabiner 1989, eq. 19-20).
Frames forward_table(const HmmScorer& scorer, const Frames& emissions) {
    Frames alpha(emissions.rows(), emissions.cols());
    for (Eigen::Index t = 0; t < emissions.rows(); ++t) {
        for (std::size_t n = 0; n < scorer.states(); ++n) {
            const double reached = t == 0
                                       ? scorer.log_initial()[n]
                                       : log_sum_over(scorer.arcs_into(n), [&](std::size_t from) {
                                             return alpha(t - 1, static_cast<Eigen::Index>(from));
                                         });
            const Eigen::Index column = static_cast<Eigen::Index>(n);
            alpha(t, column) = reached + emissions(t, column);
        }
    }
    return alpha;
}

/// Backward variables, T x N: ln beta (eq. 24-25). The last row holds the exits instead of ln 1.
Frames backward_table(const HmmScorer& scorer, const Frames& emissions) {
    Frames beta(emissions.rows(), emissions.cols());
    for (Eigen::Index t = emissions.rows() - 1; t >= 0; --t) {
        for (std::size_t n = 0; n < scorer.states(); ++n) {
            beta(t, static_cast<Eigen::Index>(n)) =
                t + 1 == emissions.rows()
                    ? scorer.log_exit()[n]
                    : log_sum_over(scorer.arcs_from(n), [&](std::size_t to) {
                          const Eigen::Index column = static_cast<Eigen::Index>(to);
                          return emissions(t + 1, column) + beta(t + 1, column);
                      });
        }
    }
    return beta;
}

// ln p of the whole sequence from the last row of alpha: every state, weighted by its exit.
double ending(const HmmScorer& scorer, std::span<const double> log_alpha) {
    std::vector<double> ends(log_alpha.begin(), log_alpha.end());
    for (std::size_t n = 0; n < ends.size(); ++n) {
        ends[n] += scorer.log_exit()[n];
    }
    return log_sum(ends);
}

}  // namespace

// The largest value is taken out first, so that no exp overflows.
double log_sum(std::span<const double> logs) noexcept RAKS_NONBLOCKING {
    double best = kImpossible;
    for (const double value : logs) {
        best = std::max(best, value);
    }
    if (best == kImpossible) {
        return kImpossible;
    }
    double sum = 0.0;
    for (const double value : logs) {
        sum += std::exp(value - best);
    }
    return best + std::log(sum);
}

Expected<HmmScorer> HmmScorer::create(const GaussianHmm& model) {
    if (auto ok = validate(model); !ok) {
        return fail(std::move(ok.error()));
    }
    HmmScorer scorer;
    scorer.dimension_ = static_cast<std::size_t>(model.dimension());
    scorer.mixtures_ = static_cast<std::size_t>(model.mixtures());
    scorer.take_topology(model);
    scorer.take_emissions(model);
    return scorer;
}

// Lists the transitions from both sides; those with probability 0 never appear, which makes
// left-to-right models cheap.
void HmmScorer::take_topology(const GaussianHmm& model) {
    const std::size_t n = static_cast<std::size_t>(model.states());
    into_.resize(n);
    from_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Index row = static_cast<Eigen::Index>(i);
        log_initial_.push_back(log_or_impossible(model.initial[row]));
        log_exit_.push_back(model.exit.size() == 0 ? 0.0 : log_or_impossible(model.exit[row]));
        for (std::size_t j = 0; j < n; ++j) {
            const double chance = model.transition(row, static_cast<Eigen::Index>(j));
            if (chance > 0.0) {
                from_[i].push_back({j, std::log(chance)});
                into_[j].push_back({i, std::log(chance)});
            }
        }
    }
}

// One whitening for each covariance, one component for each mean.
void HmmScorer::take_emissions(const GaussianHmm& model) {
    const bool is_triangle = model.covariance_type == CovarianceType::full ||
                             model.covariance_type == CovarianceType::tied;
    const Eigen::Index d = model.dimension();
    std::vector<double> log_determinants;
    for (const Eigen::MatrixXd& covariance : model.covariances) {
        Whitening whitening{is_triangle, {}};
        double log_determinant = 0.0;
        // Full or tied: covariance = L L^T. The inverse of L whitens, and ln |covariance| is twice
        // the sum of the logarithms of L's diagonal.
        if (is_triangle) {
            const Eigen::MatrixXd factor = Eigen::LLT<Eigen::MatrixXd>(covariance).matrixL();
            const Eigen::MatrixXd inverse =
                factor.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(d, d));
            for (Eigen::Index i = 0; i < d; ++i) {
                log_determinant += 2.0 * std::log(factor(i, i));
                for (Eigen::Index j = 0; j <= i; ++j) {
                    whitening.values.push_back(inverse(i, j));
                }
            }
        } else {
            // Diagonal, or spherical: then the one variance serves all features.
            for (Eigen::Index i = 0; i < d; ++i) {
                const double variance = covariance(std::min(i, covariance.rows() - 1), 0);
                log_determinant += std::log(variance);
                whitening.values.push_back(1.0 / std::sqrt(variance));
            }
        }
        log_determinants.push_back(log_determinant);
        whitenings_.push_back(std::move(whitening));
    }
    // Component c belongs to state c / K. Its constant is ln weight - (D ln 2 pi + ln |covariance|)
    // / 2.
    for (Eigen::Index c = 0; c < model.means.rows(); ++c) {
        const std::size_t which =
            model.covariance_type == CovarianceType::tied ? 0 : static_cast<std::size_t>(c);
        const double weight = model.weights(c / model.mixtures(), c % model.mixtures());
        components_.push_back(
            {log_or_impossible(weight) -
                 0.5 * (static_cast<double>(d) * kLogTwoPi + log_determinants[which]),
             which});
        for (Eigen::Index i = 0; i < d; ++i) {
            means_.push_back(model.means(c, i));
        }
    }
}

// Gaussian log density and the component's weight: the constant minus half the squared Mahalanobis
// distance of the frame.
double HmmScorer::log_component(std::span<const double> frame,
                                std::size_t component) const noexcept RAKS_NONBLOCKING {
    const double* mean = means_.data() + component * dimension_;
    const Whitening& whitening = whitenings_[components_[component].whitening];
    double distance = 0.0;
    if (whitening.is_triangle) {
        distance = squared_distance(whitening.values.data(), frame, mean);
    } else {
        for (std::size_t i = 0; i < dimension_; ++i) {
            const double white = whitening.values[i] * (frame[i] - mean[i]);
            distance += white * white;
        }
    }
    return components_[component].log_scale - 0.5 * distance;
}

void HmmScorer::log_components(std::span<const double> frame,
                               std::size_t state,
                               std::span<double> out) const noexcept RAKS_NONBLOCKING {
    for (std::size_t k = 0; k < mixtures_; ++k) {
        out[k] = log_component(frame, state * mixtures_ + k);
    }
}

void HmmScorer::log_emissions(std::span<const double> frame,
                              std::span<double> out) const noexcept RAKS_NONBLOCKING {
    RAKS_ASSERT(frame.size() == dimension_ && out.size() == states());
    for (std::size_t n = 0; n < states(); ++n) {
        // Log-sum-exp over the components in one pass: `sum` is relative to the largest value so
        // far, so no buffer is needed.
        double best = log_component(frame, n * mixtures_);
        double sum = 1.0;
        for (std::size_t k = 1; k < mixtures_; ++k) {
            const double value = log_component(frame, n * mixtures_ + k);
            if (value <= best) {
                sum += value == kImpossible ? 0.0 : std::exp(value - best);
            } else {
                sum = sum * std::exp(best - value) + 1.0;
                best = value;
            }
        }
        out[n] = best + std::log(sum);
    }
}

Frames HmmScorer::log_emissions(const Frames& frames) const {
    Frames result(frames.rows(), static_cast<Eigen::Index>(states()));
    // Only full covariances are worth it: whitening is O(D^2) a frame. The rest is done frame by
    // frame.
    const Eigen::Index in_blocks = whitenings_[0].is_triangle ? take_blocks(frames, result) : 0;
    for (Eigen::Index t = in_blocks; t < frames.rows(); ++t) {
        log_emissions(row_of(frames, t), row_of(result, t));
    }
    return result;
}

// kFrameBlock frames at a time, so that squared_distances works on whole registers.
Eigen::Index HmmScorer::take_blocks(const Frames& frames, Frames& out) const {
    constexpr Eigen::Index kBlock = kFrameBlock;
    std::vector<FeatureBlock> centred(dimension_);
    FeatureBlock distances;
    Eigen::Index first = 0;
    for (; first + kBlock <= frames.rows(); first += kBlock) {
        for (std::size_t n = 0; n < states(); ++n) {  // mixtures are for diagonal only
            const double* const mean = means_.data() + n * dimension_;
            // Transposed to one row a feature, with the state's mean subtracted.
            for (std::size_t i = 0; i < dimension_; ++i) {
                for (Eigen::Index b = 0; b < kBlock; ++b) {
                    centred[i].frames[static_cast<std::size_t>(b)] =
                        frames(first + b, static_cast<Eigen::Index>(i)) - mean[i];
                }
            }
            squared_distances(whitenings_[components_[n].whitening].values.data(),
                              centred.data(),
                              dimension_,
                              distances);
            for (Eigen::Index b = 0; b < kBlock; ++b) {
                out(first + b, static_cast<Eigen::Index>(n)) =
                    components_[n].log_scale - 0.5 * distances.frames[static_cast<std::size_t>(b)];
            }
        }
    }
    return first;
}

double log_likelihood(const HmmScorer& scorer, const Frames& frames) {
    if (frames.rows() == 0) {
        return 0.0;
    }
    // The forward pass alone gives the likelihood.
    const Frames alpha = forward_table(scorer, scorer.log_emissions(frames));
    return ending(scorer, row_of(alpha, alpha.rows() - 1));
}

ViterbiResult viterbi(const HmmScorer& scorer, const Frames& log_emissions) {
    const Eigen::Index frames = log_emissions.rows();
    if (frames == 0) {
        return {};
    }
    const std::size_t states = scorer.states();
    // Best predecessor of each state at each frame.
    std::vector<std::size_t> from(static_cast<std::size_t>(frames) * states, 0);
    std::vector<double> score(states);
    std::vector<double> next(states);
    // Initialization, recursion, end and backtracking, as in the paper.
    for (std::size_t n = 0; n < states; ++n) {
        score[n] = scorer.log_initial()[n] + log_emissions(0, static_cast<Eigen::Index>(n));
    }
    for (Eigen::Index t = 1; t < frames; ++t) {
        // Strictly greater: arcs come by rising state, so ties go to the lower one.
        for (std::size_t n = 0; n < states; ++n) {
            double best = kImpossible;
            for (const HmmScorer::Arc& arc : scorer.arcs_into(n)) {
                const double value = score[arc.state] + arc.log_chance;
                if (value > best) {
                    best = value;
                    from[static_cast<std::size_t>(t) * states + n] = arc.state;
                }
            }
            next[n] = best + log_emissions(t, static_cast<Eigen::Index>(n));
        }
        std::swap(score, next);
    }
    ViterbiResult result;
    // The end: every state, weighted by its exit.
    std::size_t state = 0;
    for (std::size_t n = 0; n < states; ++n) {
        const double value = score[n] + scorer.log_exit()[n];
        if (value > result.log_probability) {
            result.log_probability = value;
            state = n;
        }
    }
    // Backwards along the best predecessors.
    result.path.resize(static_cast<std::size_t>(frames));
    for (std::size_t t = result.path.size(); t-- > 0;) {
        result.path[t] = state;
        state = from[t * states + state];
    }
    return result;
}

ForwardBackward forward_backward(const HmmScorer& scorer, const Frames& log_emissions) {
    const Eigen::Index n = static_cast<Eigen::Index>(scorer.states());
    ForwardBackward result{
        kImpossible, Frames::Zero(log_emissions.rows(), n), Eigen::MatrixXd::Zero(n, n)};
    if (log_emissions.rows() == 0) {
        return result;
    }
    const Frames alpha = forward_table(scorer, log_emissions);
    const Frames beta = backward_table(scorer, log_emissions);
    // Not finite: the model cannot produce the sequence, and posteriors do not exist.
    result.log_likelihood = ending(scorer, row_of(alpha, alpha.rows() - 1));
    if (!std::isfinite(result.log_likelihood)) {
        return result;
    }
    // gamma: alpha beta / p.
    for (Eigen::Index t = 0; t < alpha.rows(); ++t) {
        for (Eigen::Index i = 0; i < n; ++i) {
            result.posteriors(t, i) = exp_or_zero(alpha(t, i) + beta(t, i) - result.log_likelihood);
        }
    }
    // Sum over t of xi_t(i, j) = alpha_t(i) a_ij b_j(o_t+1) beta_t+1(j) / p, for existing arcs
    // only.
    for (Eigen::Index i = 0; i < n; ++i) {
        for (const HmmScorer::Arc& arc : scorer.arcs_from(static_cast<std::size_t>(i))) {
            const Eigen::Index j = static_cast<Eigen::Index>(arc.state);
            double count = 0.0;
            for (Eigen::Index t = 0; t + 1 < alpha.rows(); ++t) {
                count += exp_or_zero(alpha(t, i) + arc.log_chance + log_emissions(t + 1, j) +
                                     beta(t + 1, j) - result.log_likelihood);
            }
            result.transitions(i, j) = count;
        }
    }
    return result;
}

StreamingForward::StreamingForward(const HmmScorer& scorer)
    : scorer_(&scorer),
      alpha_(scorer.states(), kImpossible),
      next_(scorer.states(), kImpossible),
      emissions_(scorer.states(), 0.0) {}

double StreamingForward::process(std::span<const double> frame) noexcept RAKS_NONBLOCKING {
    // The same recursion as forward_table, with the last row alone kept.
    scorer_->log_emissions(frame, emissions_);
    for (std::size_t n = 0; n < alpha_.size(); ++n) {
        const double reached = is_started_
                                   ? log_sum_over(scorer_->arcs_into(n),
                                                  [this](std::size_t from) { return alpha_[from]; })
                                   : scorer_->log_initial()[n];
        next_[n] = reached + emissions_[n];
    }
    alpha_.swap(next_);
    is_started_ = true;
    return log_sum(alpha_);
}

}  // namespace raks::models
