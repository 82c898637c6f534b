#include "audio/features/onset.hpp"

#include <algorithm>
#include <cmath>

#include "audio/features/log_magnitudes.hpp"

namespace raks::audio {
namespace {

constexpr float kCompression = 20.0F;  // log(1 + 20 |X|): weak onsets count, noise does not
// In mel bands: low, middle, high.
constexpr std::array<int, kOnsetBands + 1> kBandEdges = {0, 6, 20, 36};
constexpr std::array<float, kOnsetBands> kBandWeights = {0.4F, 0.4F, 0.3F};  // of the strength
constexpr float kNormalizeHops = 400.0F;  // memory of mean and variance: 4 s
constexpr float kFirstHops = 20.0F;       // 1 / (n + 20) in the beginning: follows faster
constexpr float kFirstVariance = 0.1F;    // before anything is known
constexpr float kVarianceFloor = 1e-5F;   // keeps near silence from being divided by 0
constexpr float kLowest = -0.8F;          // a pause is not further below an onset than this
constexpr float kHighest = 3.5F;          // nor one loud onset stronger than this

// The bank of the detector and of white_magnitudes().
FilterBank mel_filters() {
    return triangular_filter_bank({OnsetDetector::kSampleRate,
                                   OnsetDetector::kWindow,
                                   OnsetDetector::kMelBands,
                                   30.0,
                                   15'500.0});
}

}  // namespace

OnsetDetector::OnsetDetector() : spectrum_(hann_window(kWindow), kWindow), filters_(mel_filters()) {
    reset();
}

std::array<float, OnsetDetector::kMelBands> OnsetDetector::white_magnitudes() {
    const std::vector<float> ones(kWindow / 2 + 1, 1.0F);
    std::array<float, kMelBands> magnitudes{};
    mel_filters().apply(ones, magnitudes);
    return magnitudes;
}

// A filter is whole when all its bins are below the limit.
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
    filters_.apply(spectrum_.compute_magnitudes(window), magnitudes_);
    // Bands above the source's limit would stay empty and lower the flux of the high group.
    std::fill(magnitudes_.begin() + static_cast<std::ptrdiff_t>(whole_bands_),
              magnitudes_.end(),
              magnitudes_[whole_bands_ - 1]);
    return compute_from_mel(magnitudes_, is_silent);
}

Onset OnsetDetector::compute_from_mel(std::span<const float> magnitudes,
                                      bool is_silent) noexcept RAKS_NONBLOCKING {
    LogMel now{};
    log_magnitudes(magnitudes, kCompression, now);
    // The flux needs the two windows before the last hop.
    Onset onset;
    if (hops_ >= 3) {
        onset.flux = flux_of(now);
    }
    history_[static_cast<std::size_t>(hops_ % kHistory)] = now;
    ++hops_;
    // No onset in silence, and mean and variance stand still: music finds them as it left them.
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

// Mean over each group's bands of the rise against the maximum of two and three hops before: the
// window of one hop before shares two thirds of its samples with this one. The maximum keeps a
// vibrato that comes back to a band from counting as an onset (Boeck, Widmer 2013).
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

// Makes groups comparable: flux minus its running mean, in running standard deviations, clamped.
void OnsetDetector::normalize(Onset& onset) noexcept {
    // 1 / (n + 20) until that is below 1 / 400: a plain mean first, an exponential one later.
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
    // The count saturates: it matters at the start only and must not overflow.
    hops_normalized_ = std::min(hops_normalized_, 1'000'000);
}

}  // namespace raks::audio
