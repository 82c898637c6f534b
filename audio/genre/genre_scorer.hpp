#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "audio/features/network_input.hpp"
#include "audio/genre/bar_patterns.hpp"
#include "audio/genre/pattern_network.hpp"
#include "base/realtime.hpp"
#include "models/recurrent_network.hpp"

namespace raks::audio {

/// Genre scores of the last seconds by recurrent networks that take every hop's mel magnitudes.
///
/// In each hop every network gives a probability for each class; a window's score is the mean of
/// their logarithms over networks and hops. So a window stands for its own seconds (a network's
/// state reaches back somewhat longer), and what only one network has learnt by heart weighs less.
/// Sums are kept by blocks of 100 ms and added anew for each window: no rounding errors pile up.
///
/// Threads: one. Real-time: next, log_chances, reset yes.
class GenreScorer {
 public:
    static constexpr int kBlockHops = 10;  ///< 100 ms
    /// Blocks of the longest window.
    static constexpr int kBlocks = BarPatterns::kSegments * BarPatterns::kSegmentHops / kBlockHops;
    static constexpr std::size_t kMostNetworks = 4;  ///< that can be averaged
    /// Lowest ln probability that a hop may contribute: one hop must not decide a window.
    static constexpr float kLeastLog = -7.0F;

    /// Takes a hop of music (leave silence out). `networks`: the same in each call, 1 to
    /// kMostNetworks, each with NetworkInput::kSize inputs and the same number of outputs. `mel`:
    /// the onset detector's magnitudes without noise.
    void next(std::span<const models::RecurrentNetwork> networks,
              std::span<const float, BarPatterns::kMelBands> mel) noexcept RAKS_NONBLOCKING;
    /// Number of closed blocks that log_chances() can use, at most kBlocks.
    [[nodiscard]] int blocks() const noexcept { return closed_ < kBlocks ? closed_ : kBlocks; }
    /// Mean ln probability of each class over the newest `blocks` closed blocks, 1 to blocks().
    /// `out`: one value for each output of the networks. The mean is not normalized.
    void log_chances(int blocks, std::span<float> out) const noexcept RAKS_NONBLOCKING;
    /// Forgets the music and the networks' states.
    void reset() noexcept RAKS_NONBLOCKING { *this = GenreScorer(); }

 private:
    using Sums = std::array<float, PatternNetwork::kMaxClasses>;
    static_assert(BarPatterns::kMelBands == NetworkInput::kBands);
    static_assert(PatternNetwork::kMaxClasses <= models::RecurrentNetwork::kMaxOutputs);

    NetworkInput input_;
    std::array<models::RecurrentStream, kMostNetworks> streams_;
    Sums open_{};  // ln probabilities of the current block
    int open_hops_ = 0;
    std::array<Sums, kBlocks> ring_{};  // closed blocks
    int newest_ = 0;                    // place of the newest one
    int closed_ = 0;                    // number of closed blocks, at most kBlocks
};

}  // namespace raks::audio
