#include "models/sliding_score.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"

namespace raks::models {
namespace {

/// Semiring of the forward recursion: sums of products.
struct SumProduct {
    static constexpr double kNothing = 0.0;
    static double both(double a, double b) noexcept { return a * b; }
    static double either(double a, double b) noexcept { return a + b; }
};

/// Semiring of Viterbi: maxima of sums of logarithms.
struct MaxSum {
    static constexpr double kNothing = kImpossible;
    static double both(double a, double b) noexcept { return a + b; }
    static double either(double a, double b) noexcept { return std::max(a, b); }
};

/// out = left x right in the semiring, all N x N, row-major.
template <class Ring>
void multiply(std::span<const double> left,
              std::span<const double> right,
              std::size_t states,
              std::span<double> out) noexcept {
    std::fill(out.begin(), out.end(), Ring::kNothing);
    for (std::size_t i = 0; i < states; ++i) {
        for (std::size_t k = 0; k < states; ++k) {
            const double factor = left[i * states + k];
            for (std::size_t j = 0; j < states; ++j) {
                double& sum = out[i * states + j];
                sum = Ring::either(sum, Ring::both(factor, right[k * states + j]));
            }
        }
    }
}

/// out = matrix x vector in the semiring.
template <class Ring>
void multiply_vector(std::span<const double> matrix,
                     std::span<const double> vector,
                     std::span<double> out) noexcept {
    const std::size_t states = vector.size();
    for (std::size_t i = 0; i < states; ++i) {
        double sum = Ring::kNothing;
        for (std::size_t j = 0; j < states; ++j) {
            sum = Ring::either(sum, Ring::both(matrix[i * states + j], vector[j]));
        }
        out[i] = sum;
    }
}

/// Divides by the largest value, so that the values stay near 1. Returns the logarithm of the
/// divisor; 0 where all values are 0.
double rescale(std::span<double> values) noexcept {
    const double largest = *std::max_element(values.begin(), values.end());
    if (!(largest > 0.0)) {
        return 0.0;
    }
    for (double& value : values) {
        value /= largest;
    }
    return std::log(largest);
}

}  // namespace

SlidingScore::SlidingScore(const HmmScorer& scorer, const Plan& plan)
    : kind_(plan.kind),
      block_(plan.block),
      blocks_(plan.blocks),
      states_(scorer.states()),
      initial_(scorer.log_initial().begin(), scorer.log_initial().end()),
      transition_(states_ * states_, kImpossible),
      work_(states_ * states_),
      closed_(static_cast<std::size_t>(plan.blocks) + 1),
      scores_(static_cast<std::size_t>(plan.blocks)),
      next_scores_(static_cast<std::size_t>(plan.blocks)) {
    // Logarithms from the scorer; forward needs the probabilities themselves.
    for (std::size_t from = 0; from < states_; ++from) {
        for (const HmmScorer::Arc& arc : scorer.arcs_from(from)) {
            transition_[from * states_ + arc.state] = arc.log_chance;
        }
    }
    if (kind_ == Kind::forward) {
        const auto chance = [](double log) { return std::exp(log); };
        std::transform(initial_.begin(), initial_.end(), initial_.begin(), chance);
        std::transform(transition_.begin(), transition_.end(), transition_.begin(), chance);
    }
    // All memory is allocated here, because process() is real-time.
    open_.values.resize(states_ * states_);
    for (Scaled& block : closed_) {
        block.values.resize(states_ * states_);
    }
    vector_.values.resize(states_);
    reset();
}

void SlidingScore::reset() noexcept RAKS_NONBLOCKING {
    // Matrices keep old values; they are overwritten before they are read.
    filled_ = 0;
    closed_blocks_ = 0;
    walked_ = 0;
    is_walking_ = false;
    scored_blocks_ = 0;
    std::fill(scores_.begin(), scores_.end(), kImpossible);
}

int SlidingScore::blocks_scored() const noexcept RAKS_NONBLOCKING {
    return static_cast<int>(std::min<std::int64_t>(scored_blocks_, blocks_));
}

// Scores of windows longer than the stream do not exist.
double SlidingScore::score(int blocks) const noexcept RAKS_NONBLOCKING {
    return blocks >= 1 && blocks <= blocks_scored() ? scores_[static_cast<std::size_t>(blocks - 1)]
                                                    : kImpossible;
}

// A closed block by its number since the start of the stream; old ones are overwritten.
const SlidingScore::Scaled& SlidingScore::block_at(std::int64_t number) const noexcept {
    return closed_[static_cast<std::size_t>(number) % closed_.size()];
}

void SlidingScore::process(std::span<const double> log_emissions) noexcept RAKS_NONBLOCKING {
    RAKS_ASSERT(log_emissions.size() == states_);
    // An equal share of the walk at each frame of a block, rounded up: it ends with the block.
    walk((blocks_ + block_ - 1) / block_);
    take_frame(log_emissions);
    // The walk ends before the new block is stored over the oldest one.
    if (++filled_ == block_) {
        finish_walk();
        close_block();
    }
}

/// open <- open x A x diag(b), or diag(b) for the first frame of a block.
void SlidingScore::take_frame(std::span<const double> log_emissions) noexcept {
    std::vector<double>& product = open_.values;
    const bool is_forward = kind_ == Kind::forward;
    // The first frame of a block has no transition before it: it is part of the step between
    // blocks.
    if (filled_ == 0) {
        std::fill(product.begin(), product.end(), is_forward ? 0.0 : kImpossible);
        for (std::size_t state = 0; state < states_; ++state) {
            product[state * states_ + state] = is_forward ? 1.0 : 0.0;
        }
        open_.log_scale = 0.0;
    } else {
        is_forward ? multiply<SumProduct>(product, transition_, states_, work_)
                   : multiply<MaxSum>(product, transition_, states_, work_);
        std::swap(product, work_);
    }
    // The largest emission is factored out, because emissions may all be below e^-745.
    const double best = *std::max_element(log_emissions.begin(), log_emissions.end());
    const double shift = is_forward && best > kImpossible ? best : 0.0;
    for (std::size_t to = 0; to < states_; ++to) {
        const double emission =
            is_forward ? std::exp(log_emissions[to] - shift) : log_emissions[to];
        for (std::size_t from = 0; from < states_; ++from) {
            double& value = product[from * states_ + to];
            value = is_forward ? value * emission : value + emission;
        }
    }
    open_.log_scale += shift + (is_forward ? rescale(product) : 0.0);
}

// Copies into the ring's own memory and starts the walk over the blocks that exist.
void SlidingScore::close_block() noexcept {
    Scaled& place = closed_[static_cast<std::size_t>(closed_blocks_) % closed_.size()];
    std::copy(open_.values.begin(), open_.values.end(), place.values.begin());
    place.log_scale = open_.log_scale;
    ++closed_blocks_;
    filled_ = 0;
    walked_ = 0;
    is_walking_ = true;
}

// Up to `steps` blocks further back; each gives the score of one more window.
void SlidingScore::walk(int steps) noexcept {
    const int all = static_cast<int>(std::min<std::int64_t>(closed_blocks_, blocks_));
    for (int i = 0; i < steps && is_walking_ && walked_ < all; ++i) {
        step_back(block_at(closed_blocks_ - 1 - walked_));
        next_scores_[static_cast<std::size_t>(walked_++)] = entry_score();
    }
}

void SlidingScore::finish_walk() noexcept {
    if (!is_walking_) {
        return;
    }
    walk(blocks_);
    // The finished scores are shown at once, for all lengths of window together.
    std::swap(scores_, next_scores_);
    scored_blocks_ = closed_blocks_;
    is_walking_ = false;
}

/// vector <- P x 1 for the newest block, P x A x vector for those before it.
void SlidingScore::step_back(const Scaled& block) noexcept {
    const bool is_forward = kind_ == Kind::forward;
    // Both products need a result that is not an operand.
    const std::span<double> next = std::span(work_).first(states_);
    if (walked_ == 0) {
        std::fill(vector_.values.begin(), vector_.values.end(), is_forward ? 1.0 : 0.0);
        vector_.log_scale = 0.0;
    } else {
        is_forward ? multiply_vector<SumProduct>(transition_, vector_.values, next)
                   : multiply_vector<MaxSum>(transition_, vector_.values, next);
        std::copy(next.begin(), next.end(), vector_.values.begin());
    }
    is_forward ? multiply_vector<SumProduct>(block.values, vector_.values, next)
               : multiply_vector<MaxSum>(block.values, vector_.values, next);
    std::copy(next.begin(), next.end(), vector_.values.begin());
    vector_.log_scale += block.log_scale + (is_forward ? rescale(vector_.values) : 0.0);
}

// initial . vector: the probability to start the window in each state.
double SlidingScore::entry_score() const noexcept {
    const bool is_forward = kind_ == Kind::forward;
    double sum = is_forward ? 0.0 : kImpossible;
    for (std::size_t state = 0; state < states_; ++state) {
        sum = is_forward ? sum + initial_[state] * vector_.values[state]
                         : std::max(sum, initial_[state] + vector_.values[state]);
    }
    if (!is_forward) {
        return sum;
    }
    return sum > 0.0 ? std::log(sum) + vector_.log_scale : kImpossible;
}

}  // namespace raks::models
