#include "audio/form/hop_sound.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "audio/features/log_magnitudes.hpp"

namespace raks::audio {
namespace {

// Mel bands (30 to 15,500 Hz in 36) up to 200 Hz and up to 4 kHz.
constexpr std::array<std::size_t, kFormBands + 1> kEdges = {0, 2, 21, HopListener::kMelBands};
// The first mel band above 6 kHz.
constexpr std::size_t kFirstTopBand = 28;
// The usual magnitude follows a louder sound within 0.3 s, a softer one within 6 s, so that pauses
// and soft passages stay soft.
constexpr float kRise = 1.0F / 30.0F;
constexpr float kFall = 1.0F / 600.0F;
constexpr float kLeastUsual = 1e-6F;  // keeps digital silence from being divided by 0
constexpr float kSoftShare = 0.05F;   // of the usual: sounds 26 dB under it still count
constexpr float kLeastPower = 1e-12F;

// Mean rise of the logarithms against the maximum of two and three hops before, as OnsetDetector.
template <typename Logs>
std::array<float, kFormBands> rises(const Logs& now, const Logs& two_ago, const Logs& three_ago) {
    std::array<float, kFormBands> result{};
    for (std::size_t group = 0; group < kFormBands; ++group) {
        for (std::size_t i = kEdges[group]; i < kEdges[group + 1]; ++i) {
            result[group] += std::max(0.0F, now[i] - std::max(two_ago[i], three_ago[i]));
        }
        result[group] /= static_cast<float>(kEdges[group + 1] - kEdges[group]);
    }
    return result;
}

float power_of_decibels(float decibels) { return std::pow(10.0F, 0.1F * decibels); }

}  // namespace

float HopSound::brightness() const noexcept {
    return bands[2] - 10.0F * std::log10(power_of_decibels(bands[0]) + power_of_decibels(bands[1]));
}

HopSound HopListener::advance(float level_dbfs,
                              std::span<const float, kMelBands> mel) noexcept RAKS_NONBLOCKING {
    HopSound sound;
    sound.level = level_dbfs;
    const auto decibels = [&](std::size_t from, std::size_t to) {
        float power = kLeastPower;
        for (std::size_t i = from; i < to; ++i) {
            power += mel[i] * mel[i];
        }
        return 10.0F * std::log10(power);
    };
    for (std::size_t group = 0; group < kFormBands; ++group) {
        sound.bands[group] = decibels(kEdges[group], kEdges[group + 1]);
    }
    sound.top = decibels(kFirstTopBand, mel.size());
    const float mean = std::accumulate(mel.begin(), mel.end(), 0.0F) / kMelBands;
    // The first sound sets the level, as nothing is known before.
    usual_ += (usual_ <= kLeastUsual ? 1.0F : mean > usual_ ? kRise : kFall) * (mean - usual_);
    usual_ = std::max(usual_, kLeastUsual);
    Logs& soft = soft_[hops_ % kHistory];
    Logs& loud = loud_[hops_ % kHistory];
    log_magnitudes(mel, 1.0F / (kSoftShare * usual_), soft);
    log_magnitudes(mel, 1.0F / usual_, loud);
    if (hops_ >= 3) {
        const std::size_t two_ago = (hops_ - 2) % kHistory;
        const std::size_t three_ago = (hops_ - 3) % kHistory;
        sound.novelty = rises(soft, soft_[two_ago], soft_[three_ago]);
        sound.hits = rises(loud, loud_[two_ago], loud_[three_ago]);
    }
    ++hops_;
    return sound;
}

}  // namespace raks::audio
