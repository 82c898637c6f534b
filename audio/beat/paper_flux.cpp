#include <algorithm>
#include <cmath>

#include "audio/beat/paper_beat.hpp"

namespace raks::audio {
namespace {

// Of |X| with a Hann window, full scale 256: below 1 / kCompression the arcsinh is about linear.
constexpr float kCompression = 30.0F;
// The threshold stands this far above the median, as a share of it, and above nothing at all.
constexpr float kMedianShare = 1.0F;
constexpr float kFloor = 2.0F;

}  // namespace

PaperFlux::PaperFlux() : spectrum_(hann_window(kWindow), kWindow) {
    // Smoothing s (half Hann, newest first), then the difference of neighbours: h(i) = s(i) - s(i -
    // 1). A step in G answers with s itself: at once, then fading.
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
    // The filter's memory is not full in the first hops: a start is not an onset.
    strengths_[hops_ % kMedian] = hops_ < kSmoothing + 1 ? 0.0F : flux();
    ++hops_;
    Frame frame;
    frame.strength = strengths_[(hops_ + kMedian - 1 - kDelay) % kMedian];
    auto sorted = strengths_;
    std::nth_element(sorted.begin(), sorted.begin() + kDelay, sorted.end());
    frame.threshold = kMedianShare * sorted[kDelay] + kFloor;
    return frame;
}

}  // namespace raks::audio
