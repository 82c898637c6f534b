#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "base/expected.hpp"
#include "base/realtime.hpp"
#include "models/gaussian_hmm.hpp"

/// Evaluation of Gaussian HMMs: emissions, likelihoods, Viterbi paths and posteriors.
namespace raks::models {

inline constexpr double kImpossible = -std::numeric_limits<double>::infinity();  ///< ln 0

/// A model prepared for evaluation: logarithms taken, covariances factorized, only existing
/// transitions listed. Immutable. Everything is computed in logarithms, so that no frame, however
/// unlikely, underflows.
class HmmScorer {
 public:
    /// A transition with probability > 0, seen from one of its states.
    struct Arc {
        std::size_t state = 0;    ///< the state at the other end
        double log_chance = 0.0;  ///< ln of the transition probability
    };

    /// Errors: those of validate(model).
    [[nodiscard]] static Expected<HmmScorer> create(const GaussianHmm& model);

    [[nodiscard]] std::size_t states() const noexcept { return log_initial_.size(); }  ///< N
    [[nodiscard]] std::size_t mixtures() const noexcept { return mixtures_; }          ///< K
    [[nodiscard]] std::size_t dimension() const noexcept { return dimension_; }        ///< D

    /// ln b_n(o) of every state n for one frame of D features.
    /// Threads: any. Real-time: yes (O(N D) or O(N D^2), no allocation).
    void log_emissions(std::span<const double> frame,
                       std::span<double> out) const noexcept RAKS_NONBLOCKING;
    /// ln (weight x density) of every component of one state; `out`: K values.
    /// Threads: any. Real-time: yes.
    void log_components(std::span<const double> frame,
                        std::size_t state,
                        std::span<double> out) const noexcept RAKS_NONBLOCKING;
    /// The same for all frames: T x N, the same bits as frame by frame. Real-time: no.
    [[nodiscard]] Frames log_emissions(const Frames& frames) const;

    /// N, ln of the probability to start in each state.
    [[nodiscard]] std::span<const double> log_initial() const noexcept { return log_initial_; }
    /// N, ln of the probability to end after each state; 0 where sequences may end anywhere.
    [[nodiscard]] std::span<const double> log_exit() const noexcept { return log_exit_; }
    /// Transitions that lead into a state, by rising origin.
    [[nodiscard]] std::span<const Arc> arcs_into(std::size_t state) const noexcept {
        return into_[state];
    }
    /// Transitions that leave a state, by rising destination.
    [[nodiscard]] std::span<const Arc> arcs_from(std::size_t state) const noexcept {
        return from_[state];
    }

 private:
    struct Component {
        double log_scale = 0.0;  // ln weight - (D ln 2 pi + ln |covariance|) / 2
        std::size_t whitening = 0;
    };
    /// Inverse of the Cholesky factor: rows of a lower triangle, packed; or D reciprocal standard
    /// deviations.
    struct Whitening {
        bool is_triangle = false;
        std::vector<double> values;
    };

    /// Emissions of as many whole blocks of frames as there are; returns how many frames.
    Eigen::Index take_blocks(const Frames& frames, Frames& out) const;
    [[nodiscard]] double log_component(std::span<const double> frame,
                                       std::size_t component) const noexcept RAKS_NONBLOCKING;
    void take_topology(const GaussianHmm& model);
    void take_emissions(const GaussianHmm& model);

    std::size_t dimension_ = 0;
    std::size_t mixtures_ = 1;
    std::vector<double> log_initial_;
    std::vector<double> log_exit_;
    std::vector<std::vector<Arc>> into_;
    std::vector<std::vector<Arc>> from_;
    std::vector<double> means_;  // component-major
    std::vector<Component> components_;
    std::vector<Whitening> whitenings_;
};

/// ln of the sum of exp of these numbers; kImpossible for an empty list or one of kImpossible
/// alone. Real-time: yes.
[[nodiscard]] double log_sum(std::span<const double> logs) noexcept RAKS_NONBLOCKING;

/// ln p(o_1..o_T) of a whole sequence, its end included where the model has exits; 0 for no frames.
/// Threads: any. Real-time: no.
[[nodiscard]] double log_likelihood(const HmmScorer& scorer, const Frames& frames);

/// A state path and its probability.
struct ViterbiResult {
    std::vector<std::size_t> path;         ///< T states; empty for no frames
    double log_probability = kImpossible;  ///< ln, with the observations
};
/// The most likely state path (Rabiner 1989, eq. 30-35). `log_emissions`: T x N. Ties go to the
/// lower state. Threads: any. Real-time: no.
[[nodiscard]] ViterbiResult viterbi(const HmmScorer& scorer, const Frames& log_emissions);

/// Posteriors of a sequence under a model.
struct ForwardBackward {
    double log_likelihood = kImpossible;  ///< as log_likelihood()
    Frames posteriors;                    ///< T x N, gamma; all 0 when the sequence is impossible
    Eigen::MatrixXd transitions;          ///< N x N, expected counts (sum of xi)
};
/// Forward-backward algorithm (Rabiner 1989) on T x N log emissions. Threads: any. Real-time: no.
[[nodiscard]] ForwardBackward forward_backward(const HmmScorer& scorer,
                                               const Frames& log_emissions);

/// Forward recursion one frame at a time.
/// Threads: one. Real-time: process, reset yes.
class StreamingForward {
 public:
    /// Keeps a reference to `scorer`, which must outlive this.
    explicit StreamingForward(const HmmScorer& scorer);

    /// Takes the next frame (D features) and returns ln p(o_1..o_t) of the frames so far, without
    /// exits (a prefix may go on).
    double process(std::span<const double> frame) noexcept RAKS_NONBLOCKING;
    void reset() noexcept { is_started_ = false; }  ///< next frame is the first

    /// ln alpha of every state after the last frame.
    [[nodiscard]] std::span<const double> log_alpha() const noexcept { return alpha_; }

 private:
    const HmmScorer* scorer_;
    std::vector<double> alpha_;
    std::vector<double> next_;
    std::vector<double> emissions_;
    bool is_started_ = false;
};

}  // namespace raks::models
