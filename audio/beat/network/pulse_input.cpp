#include "audio/beat/network/pulse_input.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

constexpr float kLevelHops = 500.0F;      // memory of a band's level
constexpr float kRiseCompression = 8.0F;  // log(1 + 8 x magnitude / level)
constexpr float kOfAllBands = 0.05F;      // share of all bands' mean level, added to each band's
constexpr float kNoSound = 1e-9F;         // magnitude of digital silence
constexpr int kUsualBeats = 12;           // memory of the usual rise
constexpr float kOfAllGroups = 0.1F;      // share of all groups' usual rise, added to each group's
constexpr float kUsualRise = 0.7F;        // ln 2: a twelfth with the usual rise
constexpr double kBeatHops = 50.0;        // of a beat at 120 BPM

}  // namespace

void PulseInput::add_hop(std::span<const float> mel_magnitudes,
                         double passed) noexcept RAKS_NONBLOCKING {
    ++heard_;
    const float share = 1.0F / std::min(static_cast<float>(heard_), kLevelHops);
    float floor = kNoSound;
    for (std::size_t band = 0; band < kBands; ++band) {
        level_[band] += share * (mel_magnitudes[band] - level_[band]);
        floor += kOfAllBands * level_[band] / float{kBands};
    }
    const auto twelfth = std::min(
        kTwelfths - 1, static_cast<std::size_t>(std::max(0.0, passed) * double{kTwelfths}));
    constexpr std::size_t kBandsAGroup = kBands / kGroups;
    Bands log{};
    for (std::size_t band = 0; band < kBands; ++band) {
        log[band] = std::log1p(kRiseCompression * mel_magnitudes[band] / (level_[band] + floor));
        if (heard_ > 2) {
            rises_[twelfth][band / kBandsAGroup] += std::max(0.0F, log[band] - logs_[1][band]);
        }
        sum_[band] += log[band];
    }
    logs_[1] = logs_[0];
    logs_[0] = log;
    ++hops_;
}

PulseInput::Frame PulseInput::next_beat() noexcept RAKS_NONBLOCKING {
    const float share = 1.0F / static_cast<float>(std::min(beats_ + 1, kUsualBeats));
    float floor = kNoSound;
    for (std::size_t group = 0; group < kGroups; ++group) {
        float rise = 0.0F;
        for (const Groups& twelfth : rises_) {
            rise += twelfth[group] / float{kTwelfths};
        }
        usual_[group] += share * (rise - usual_[group]);
        floor += kOfAllGroups * usual_[group] / float{kGroups};
    }
    Frame frame{};
    for (std::size_t i = 0; i < kTwelfths * kGroups; ++i) {
        const std::size_t group = i % kGroups;
        frame[i] = std::log1p(rises_[i / kGroups][group] / (usual_[group] + floor)) - kUsualRise;
    }
    float* const changes = &frame[kTwelfths * kGroups];
    for (std::size_t band = 0; band < kBands; ++band) {
        const float now = sum_[band] / static_cast<float>(std::max(1, hops_));
        if (beats_ > 0) {
            changes[band / (kBands / kChanges)] += std::abs(now - before_[band]);
        }
        before_[band] = now;
    }
    frame[kSize - 1] = static_cast<float>(std::log2(std::max(1, hops_) / kBeatHops));
    beats_ = std::min(beats_ + 1, kUsualBeats);
    rises_ = {};
    sum_ = {};
    hops_ = 0;
    return frame;
}

}  // namespace raks::audio
