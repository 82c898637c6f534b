#include "audio/genre/genre_scorer.hpp"

#include <algorithm>

#include "base/assert.hpp"

namespace raks::audio {

void GenreScorer::next(std::span<const models::RecurrentNetwork> networks,
                       std::span<const float, BarPatterns::kMelBands> mel) noexcept
    RAKS_NONBLOCKING {
    RAKS_ASSERT(!networks.empty() && networks.size() <= streams_.size());
    // All networks see the same input, computed once.
    const NetworkInput::Frame frame = input_.next(mel);
    // Mean over the networks.
    const float share = 1.0F / static_cast<float>(networks.size());
    for (std::size_t i = 0; i < networks.size(); ++i) {
        models::RecurrentStream::Logits logits = streams_[i].next(networks[i], frame);
        const std::span<float> logs = std::span(logits).first(networks[i].outputs());
        normalize_logs(logs);
        for (std::size_t c = 0; c < logs.size(); ++c) {
            open_[c] += share * std::max(kLeastLog, logs[c]);
        }
    }
    // A full block goes into the ring; the oldest one is overwritten.
    if (++open_hops_ < kBlockHops) {
        return;
    }
    newest_ = (newest_ + 1) % kBlocks;
    ring_[static_cast<std::size_t>(newest_)] = open_;
    closed_ = std::min(closed_ + 1, kBlocks);
    open_ = {};
    open_hops_ = 0;
}

void GenreScorer::log_chances(int blocks, std::span<float> out) const noexcept RAKS_NONBLOCKING {
    RAKS_ASSERT(blocks >= 1 && blocks <= this->blocks() && out.size() <= open_.size());
    std::fill(out.begin(), out.end(), 0.0F);
    // From the newest block backwards.
    for (int back = 0; back < blocks; ++back) {
        const Sums& sums = ring_[static_cast<std::size_t>((newest_ + kBlocks - back) % kBlocks)];
        for (std::size_t c = 0; c < out.size(); ++c) {
            out[c] += sums[c];
        }
    }
    // Sums over hops become a mean.
    const float scale = 1.0F / static_cast<float>(blocks * kBlockHops);
    for (float& log : out) {
        log *= scale;
    }
}

}  // namespace raks::audio
