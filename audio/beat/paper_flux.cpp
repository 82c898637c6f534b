#include <algorithm>
#include <cmath>

#include "audio/beat/paper_beat.hpp"

namespace raks::audio {
namespace {

// Factor of |X| with a Hann window, full scale 256. Below 1 / kCompression arcsinh is nearly
// linear.
constexpr float kCompression = 30.0F;
// The threshold is this share of the moving median plus a floor, below which nothing is an onset.
constexpr float kMedianShare = 1.0F;
constexpr float kFloor = 2.0F;

}  // namespace

PaperFlux::PaperFlux() : spectrum_(hann_window(kWindow), kWindow) {
    // Smoothing s (half Hann, newest first) and the difference of neighbours in one filter: h(i) =
    // s(i) - s(i - 1). Its response to a step in G is s: immediate, then falling.
    std::array<float, kSmoothing + 2> smoothing{};
    float sum = 0.0F;
    for (std::size_t i = 0; i < kSmoothing; ++i) {
        const double angle = M_PI * static_cast<double>(i) / kSmoothing;
        smoothing[i + 1] = static_cast<float>(0.5 + 0.5 * std::cos(angle));
        sum += smoothing[i + 1];
    }
    for (std::size_t i = 0; i <= kSmoothing; ++i) {
        filter_[i] = (smoothing[i + 1] - smoothing[i]) / sum;
    }
}

void PaperFlux::reset() noexcept RAKS_NONBLOCKING {
    compressed_ = {};
    strengths_ = {};
    hops_ = 0;
}

// E(n, k) over the ring of spectra, then the sum over k of its positive part.
float PaperFlux::flux() const noexcept {
    std::array<float, kBins> energy{};
    for (std::size_t i = 0; i <= kSmoothing; ++i) {
        const auto& spectrum = compressed_[(hops_ + kSmoothing + 1 - i) % (kSmoothing + 1)];
        const float weight = filter_[i];
        for (std::size_t k = 0; k < kBins; ++k) {
            energy[k] += weight * spectrum[k];
        }
    }
    float sum = 0.0F;
    for (const float value : energy) {
        sum += std::max(0.0F, value);
    }
    return sum;
}

PaperFlux::Frame PaperFlux::add(std::span<const float> window) noexcept RAKS_NONBLOCKING {
    const std::span<const float> power = spectrum_.compute(window);
    std::transform(
        power.begin(), power.end(), compressed_[hops_ % (kSmoothing + 1)].begin(), [](float x) {
            return std::asinh(kCompression * std::sqrt(x));
        });
    // The filter's memory is not full in the first hops: the start of a stream is no onset.
    strengths_[hops_ % kMedian] = hops_ < kSmoothing + 1 ? 0.0F : flux();
    ++hops_;
    Frame frame;
    // The frame in the middle of the median's window.
    frame.strength = strengths_[(hops_ + kMedian - 1 - kDelay) % kMedian];
    auto sorted = strengths_;
    std::nth_element(sorted.begin(), sorted.begin() + kDelay, sorted.end());
    frame.threshold = kMedianShare * sorted[kDelay] + kFloor;
    return frame;
}

}  // namespace raks::audio
