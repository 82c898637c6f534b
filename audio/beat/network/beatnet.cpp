#include "audio/beat/network/beatnet.hpp"

#include <algorithm>
#include <utility>

#include "audio/features/log_magnitudes.hpp"
#include "base/simd_clones.hpp"
#include "models/dense_product.hpp"
#include "models/gates.hpp"

namespace raks::audio {
namespace {

// Magnitudes of 2,048 samples are so much greater than those of 1,411 at 22.05 kHz.
constexpr float kFromTrainingSize = 1411.0F / 2048.0F;
constexpr float kLog10OfE = 0.434294482F;

/// One step of a layer from the sums of its gates. (Hochreiter, Schmidhuber 1997)
RAKS_SIMD_CLONES void open_memory(float* __restrict gates,
                                  std::size_t units,
                                  float* __restrict cell,
                                  float* __restrict hidden) noexcept {
    // tanh x = 2 logistic(2 x) - 1. Clamping in loops of its own, so that all are vectorized.
    for (std::size_t i = 0; i < 4 * units; ++i) {
        const float scale = i >= 2 * units && i < 3 * units ? 2.0F : 1.0F;
        gates[i] = models::gate_range(scale * gates[i]);
    }
    for (std::size_t i = 0; i < 4 * units; ++i) {
        gates[i] = models::logistic_in_range(gates[i]);
    }
    for (std::size_t i = 0; i < units; ++i) {
        cell[i] = gates[units + i] * cell[i] + gates[i] * (2.0F * gates[2 * units + i] - 1.0F);
    }
    for (std::size_t i = 0; i < units; ++i) {
        hidden[i] = models::gate_range(2.0F * cell[i]);
    }
    for (std::size_t i = 0; i < units; ++i) {
        hidden[i] = gates[3 * units + i] * (2.0F * models::logistic_in_range(hidden[i]) - 1.0F);
    }
}

}  // namespace

BeatNetStream::BeatNetStream(std::shared_ptr<const BeatNet> network)
    : network_(std::move(network)),
      spectrum_(hann_window(static_cast<int>(kWindow)), static_cast<int>(kWindow)) {}

void BeatNetStream::reset() noexcept RAKS_NONBLOCKING {
    has_frame_ = false;
    hidden_ = {};
    cell_ = {};
}

BeatNetEvidence BeatNetStream::next(std::span<const float, kWindow> samples) noexcept
    RAKS_NONBLOCKING {
    std::array<float, BeatNet::kBands> magnitudes{};
    network_->bank.apply(spectrum_.compute_magnitudes(samples), magnitudes);
    log_magnitudes(magnitudes, kFromTrainingSize, bands_);
    for (float& band : bands_) {
        band *= kLog10OfE;
    }
    return next_from_bands(bands_);
}

BeatNetEvidence BeatNetStream::next_from_bands(
    std::span<const float, BeatNet::kBands> bands) noexcept RAKS_NONBLOCKING {
    const BeatNet& network = *network_;
    for (std::size_t band = 0; band < BeatNet::kBands; ++band) {
        const float rise = has_frame_ ? std::max(0.0F, bands[band] - inputs_[band]) : 0.0F;
        inputs_[BeatNet::kBands + band] = rise;
        inputs_[band] = bands[band];
    }
    has_frame_ = true;
    pool_filters();
    Units below{};
    std::copy_n(network.dense_bias.data(), BeatNet::kUnits, below.begin());
    models::add_product(
        pooled_.data(), pooled_.size(), network.dense.data(), below.size(), below.data());
    remember(0, below);
    remember(1, hidden_[0]);
    std::array<float, BeatNet::kOutputs> logits{};
    std::copy_n(network.outputs_bias.data(), logits.size(), logits.begin());
    models::add_product(
        hidden_[1].data(), BeatNet::kUnits, network.outputs.data(), logits.size(), logits.data());
    // Softmax; the greatest is subtracted first, so that exp does not overflow.
    const float most = *std::max_element(logits.begin(), logits.end());
    float sum = 0.0F;
    for (float& logit : logits) {
        logit = models::fast_exp(std::max(-60.0F, logit - most));
        sum += logit;
    }
    return {(logits[0] + logits[1]) / sum, logits[1] / sum};
}

// Convolution over the inputs, without negative values; of each two neighbours the greater.
void BeatNetStream::pool_filters() noexcept {
    const auto at = [this](std::size_t filter, std::size_t first) {
        const float* const taps = network_->kernel.data() + filter * BeatNet::kTaps;
        float sum = network_->kernel_bias[filter];
        for (std::size_t tap = 0; tap < BeatNet::kTaps; ++tap) {
            sum += taps[tap] * inputs_[first + tap];
        }
        return sum;
    };
    for (std::size_t filter = 0; filter < BeatNet::kFilters; ++filter) {
        for (std::size_t i = 0; i < BeatNet::kPooled; ++i) {
            pooled_[filter * BeatNet::kPooled + i] =
                std::max({0.0F, at(filter, 2 * i), at(filter, 2 * i + 1)});
        }
    }
}

void BeatNetStream::remember(std::size_t layer, const Units& below) noexcept {
    const BeatNet::Memory& weights = network_->memory[layer];
    std::copy_n(weights.bias.data(), gates_.size(), gates_.begin());
    models::add_product(
        below.data(), below.size(), weights.input.data(), gates_.size(), gates_.data());
    models::add_product(
        hidden_[layer].data(), BeatNet::kUnits, weights.state.data(), gates_.size(), gates_.data());
    open_memory(gates_.data(), BeatNet::kUnits, cell_[layer].data(), hidden_[layer].data());
}

}  // namespace raks::audio
