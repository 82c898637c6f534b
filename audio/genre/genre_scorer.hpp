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

/// Which dance the last seconds are, by recurrent networks that hear every hop's mel magnitudes.
///
/// Each network says each hop how likely each class is; a window's answer is the mean of these
/// logarithms over networks and hops, so that a window speaks for its own seconds (a network itself
/// remembers somewhat longer) and what one network alone has learnt by heart weighs less. Sums are
/// kept by blocks of 100 ms and added anew for each window: nothing drifts.
///
/// Threads: one. Real-time: next, log_chances, reset yes.
class GenreScorer {
 public:
    static constexpr int kBlockHops = 10;
    static constexpr int kBlocks =
        BarPatterns::kSegments * BarPatterns::kSegmentHops / kBlockHops;  ///< of the longest window
    static constexpr std::size_t kMostNetworks = 4;
    /// A hop's chance counts as no less than e^this: a single hop must not decide a window.
    static constexpr float kLeastLog = -7.0F;

    /// Takes a hop of music (leave silence out). `networks`: the same every time, 1 to
    /// kMostNetworks; inputs NetworkInput::kSize, outputs alike. `mel`: the magnitudes of the onset
    /// detector.
    void next(std::span<const models::RecurrentNetwork> networks,
              std::span<const float, BarPatterns::kMelBands> mel) noexcept RAKS_NONBLOCKING;
    /// Blocks that are closed, at most kBlocks.
    [[nodiscard]] int blocks() const noexcept { return closed_ < kBlocks ? closed_ : kBlocks; }
    /// Mean ln of each class' chance over the newest `blocks` closed blocks, 1 to blocks().
    /// `out`: the networks' outputs.
    void log_chances(int blocks, std::span<float> out) const noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING { *this = GenreScorer(); }

 private:
    using Sums = std::array<float, PatternNetwork::kMaxClasses>;
    static_assert(BarPatterns::kMelBands == NetworkInput::kBands);
    static_assert(PatternNetwork::kMaxClasses <= models::RecurrentNetwork::kMaxOutputs);

    NetworkInput input_;
    std::array<models::RecurrentStream, kMostNetworks> streams_;
    Sums open_{};
    int open_hops_ = 0;
    std::array<Sums, kBlocks> ring_{};
    int newest_ = 0;
    int closed_ = 0;
};

}  // namespace raks::audio
