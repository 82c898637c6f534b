#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/realtime.hpp"
#include "models/hmm_scorer.hpp"

namespace raks::models {

/// Log-likelihoods of the most recent windows of several lengths under one model: exact, at a cost
/// a frame that does not depend on the length of the stream.
///
/// Frames are gathered in blocks. A closed block is one N x N matrix, the product of its frames'
/// transitions and emissions; a window's score is its entry vector times its blocks. A walk from
/// the newest block backwards,
///     v = P_m 1,   score_m = initial . v,   v <- P_(m-1) A v,
/// yields the windows of 1, 2, ... blocks in turn. It is spread over the frames of the block that
/// follows: N^3 for the product and a few N^2 a frame. No long sums are subtracted, so no digits
/// cancel; every matrix carries the logarithm of its own scale.
///
/// Forward: sums over paths, in doubles rescaled at every frame; paths below e^-700 of the best one
/// within a block count as impossible. Viterbi: the best path, in logarithms.
/// Threads: one. Real-time: all but the constructor.
class SlidingScore {
 public:
    /// Sum over all paths, or the best path alone.
    enum class Kind : std::uint8_t { forward, viterbi };
    /// What is scored.
    struct Plan {
        Kind kind = Kind::forward;  ///< of the recursion
        int block = 10;             ///< frames, >= 1
        int blocks = 100;           ///< of the longest window, >= 1
    };

    /// Takes initial and transition probabilities from the model; sequences may end anywhere.
    SlidingScore(const HmmScorer& scorer, const Plan& plan);

    /// Takes the next frame's ln b_n(o) of each of the N states. For a frame without information
    /// pass zeros: then only time passes.
    void process(std::span<const double> log_emissions) noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING;  ///< as after construction

    /// ln p of the `blocks` newest blocks as one sequence; kImpossible where the stream has fewer
    /// yet. The newest block is the last one whose walk is complete: one block before the last
    /// closed one.
    [[nodiscard]] double score(int blocks) const noexcept RAKS_NONBLOCKING;
    /// Frames from the start of the stream to the end of those windows.
    [[nodiscard]] std::int64_t frames_scored() const noexcept { return scored_blocks_ * block_; }
    /// The largest number of blocks that score() has a value for.
    [[nodiscard]] int blocks_scored() const noexcept RAKS_NONBLOCKING;

 private:
    /// A vector or matrix and what it was divided by (forward; for Viterbi the scale stays 0).
    struct Scaled {
        std::vector<double> values;
        double log_scale = 0.0;
    };

    void take_frame(std::span<const double> log_emissions) noexcept;
    void close_block() noexcept;
    void walk(int steps) noexcept;
    void finish_walk() noexcept;
    void step_back(const Scaled& block) noexcept;
    [[nodiscard]] double entry_score() const noexcept;
    [[nodiscard]] const Scaled& block_at(std::int64_t number) const noexcept;

    Kind kind_;
    int block_;
    int blocks_;
    std::size_t states_;
    std::vector<double> initial_;     // chances, or their logarithms (Viterbi)
    std::vector<double> transition_;  // row-major, from x to; the same
    Scaled open_;                     // product of the block that is being filled
    std::vector<double> work_;
    std::vector<Scaled> closed_;  // ring
    int filled_ = 0;              // frames in open_
    std::int64_t closed_blocks_ = 0;

    Scaled vector_;   // of the walk
    int walked_ = 0;  // blocks
    bool is_walking_ = false;
    std::int64_t scored_blocks_ = 0;
    std::vector<double> scores_;  // by blocks - 1, of the last walk that was finished
    std::vector<double> next_scores_;
};

}  // namespace raks::models
