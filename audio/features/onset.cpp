#include "audio/features/onset.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

constexpr float kCompression = 20.0F;  // log(1 + 20 |X|): weak onsets count, noise does not
constexpr std::array<int, kOnsetBands + 1> kBandEdges = {0, 6, 20, 36};  // in mel bands
constexpr std::array<float, kOnsetBands> kBandWeights = {0.4F, 0.4F, 0.3F};
constexpr float kNormalizeHops = 400.0F;  // 4 s
constexpr float kFirstHops = 20.0F;       // faster at the start: 1 / (n + 20)
constexpr float kFirstVariance = 0.1F;
constexpr float kVarianceFloor = 1e-5F;
constexpr float kLowest = -0.8F;
constexpr float kHighest = 3.5F;

FilterBank mel_filters() {
    return triangular_filter_bank({OnsetDetector::kSampleRate,
                                   OnsetDetector::kWindow,
                                   OnsetDetector::kMelBands,
                                   30.0,
                                   15'500.0});
}

}  // namespace

OnsetDetector::OnsetDetector()
    : spectrum_(hann_window(kWindow), kWindow),
      filters_(mel_filters()),
      magnitude_(static_cast<std::size_t>(spectrum_.bins())) {
    reset();
}

std::array<float, OnsetDetector::kMelBands> OnsetDetector::white_magnitudes() {
    const std::vector<float> ones(kWindow / 2 + 1, 1.0F);
    std::array<float, kMelBands> magnitudes{};
    mel_filters().apply(ones, magnitudes);
    return magnitudes;
}

void OnsetDetector::limit_to(double hertz) noexcept {
    const int bin = static_cast<int>(hertz * kWindow / kSampleRate);
    whole_bands_ = static_cast<std::size_t>(std::max(1, filters_.size_below(bin)));
}

void OnsetDetector::reset() noexcept RAKS_NONBLOCKING {
    history_ = {};
    hops_ = hops_normalized_ = 0;
    mean_ = {};
    variance_.fill(kFirstVariance);
}

Onset OnsetDetector::compute(std::span<const float> window,
                             bool is_silent) noexcept RAKS_NONBLOCKING {
    const std::span<const float> power = spectrum_.compute(window);
    std::transform(
        power.begin(), power.end(), magnitude_.begin(), [](float p) { return std::sqrt(p); });
    filters_.apply(magnitude_, magnitudes_);
    std::fill(magnitudes_.begin() + static_cast<std::ptrdiff_t>(whole_bands_),
              magnitudes_.end(),
              magnitudes_[whole_bands_ - 1]);
    return compute_from_mel(magnitudes_, is_silent);
}

Onset OnsetDetector::compute_from_mel(std::span<const float> magnitudes,
                                      bool is_silent) noexcept RAKS_NONBLOCKING {
    LogMel now{};
    std::transform(magnitudes.begin(), magnitudes.end(), now.begin(), [](float magnitude) {
        return std::log1p(kCompression * magnitude);
    });
    Onset onset;
    if (hops_ >= 3) {
        onset.flux = flux_of(now);
    }
    history_[static_cast<std::size_t>(hops_ % kHistory)] = now;
    ++hops_;
    if (is_silent) {
        onset.flux = {};
        return onset;
    }
    for (const float flux : onset.flux) {
        onset.total += flux;
    }
    normalize(onset);
    return onset;
}

std::array<float, kOnsetBands> OnsetDetector::flux_of(const LogMel& now) const noexcept {
    const LogMel& two_ago = history_[static_cast<std::size_t>((hops_ - 2) % kHistory)];
    const LogMel& three_ago = history_[static_cast<std::size_t>((hops_ - 3) % kHistory)];
    std::array<float, kOnsetBands> flux{};
    for (std::size_t group = 0; group < flux.size(); ++group) {
        const int first = kBandEdges[group];
        const int end = kBandEdges[group + 1];
        for (int band = first; band < end; ++band) {
            const std::size_t i = static_cast<std::size_t>(band);
            flux[group] += std::max(0.0F, now[i] - std::max(two_ago[i], three_ago[i]));
        }
        flux[group] /= static_cast<float>(end - first);
    }
    return flux;
}

void OnsetDetector::normalize(Onset& onset) noexcept {
    const float share =
        std::max(1.0F / kNormalizeHops, 1.0F / (static_cast<float>(hops_normalized_) + kFirstHops));
    ++hops_normalized_;
    for (std::size_t i = 0; i < onset.flux.size(); ++i) {
        mean_[i] += share * (onset.flux[i] - mean_[i]);
        const float deviation = onset.flux[i] - mean_[i];
        variance_[i] += share * (deviation * deviation - variance_[i]);
        onset.normalized[i] =
            std::clamp(deviation / std::sqrt(variance_[i] + kVarianceFloor), kLowest, kHighest);
        onset.strength += kBandWeights[i] * onset.normalized[i];
    }
    hops_normalized_ = std::min(hops_normalized_, 1'000'000);
}

}  // namespace raks::audio
