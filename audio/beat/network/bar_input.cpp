#include "audio/beat/network/bar_input.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

constexpr int kLevelBeats = 10;           // memory of a band's level
constexpr float kCompression = 4.0F;      // log(1 + 4 x magnitude / level)
constexpr float kMiddle = 1.6F;           // ln(1 + kCompression): a band at its level
constexpr float kAudible = 0.02F;         // share of all bands' mean level, added to each band's
constexpr float kDigitalSilence = 1e-9F;  // digital silence
constexpr float kFirstChange = 0.3F;      // in place of the change at the first beat
constexpr float kUsualHops = 50.0F;       // of a beat at 120 BPM
// Brings the evidence to the size of the other inputs: downbeats are rarer than beats.
constexpr float kBeatScale = 2.0F;
constexpr float kDownbeatScale = 4.0F;
constexpr float kHalfScale = 2.0F;

}  // namespace

// Sums by quarter of the beat; each kind of evidence where it can occur in the beat.
void BarInput::add_hop(std::span<const float> mel_magnitudes,
                       double phase,
                       const BeatEvidence& evidence) noexcept RAKS_NONBLOCKING {
    const auto quarter =
        std::min(kQuarters - 1, static_cast<std::size_t>(std::max(0.0, phase) * double{kQuarters}));
    for (std::size_t band = 0; band < kBands; ++band) {
        sums_[quarter][band] += mel_magnitudes[band];
    }
    ++hops_[quarter];
    // Beat and downbeat belong to the beat's first quarter, the half beat to its middle ones.
    if (quarter == 0) {
        most_.beat = std::max(most_.beat, evidence.beat);
        most_.downbeat = std::max(most_.downbeat, evidence.downbeat);
    } else if (quarter < 3) {
        most_.half = std::max(most_.half, evidence.half);
    }
}

// Log magnitude relative to the band's level, about 0 at the level. `floor` keeps silent bands from
// being blown up.
float BarInput::compressed(float magnitude, std::size_t band, float floor) const noexcept {
    return std::log1p(kCompression * magnitude / (level_[band] + floor)) - kMiddle;
}

// Levels first (this beat included), then quarters, changes and the rest.
BarInput::Frame BarInput::next_beat() noexcept RAKS_NONBLOCKING {
    constexpr std::size_t kBandsAGroup = kBands / kGroups;
    // Mean magnitudes of the whole beat.
    int hops = 0;
    Bands whole{};
    for (std::size_t quarter = 0; quarter < kQuarters; ++quarter) {
        hops += hops_[quarter];
        for (std::size_t band = 0; band < kBands; ++band) {
            whole[band] += sums_[quarter][band];
        }
    }
    // A plain mean over the first beats, an exponential one later.
    const float share = 1.0F / static_cast<float>(std::min(beats_ + 1, kLevelBeats));
    float floor = kDigitalSilence;
    for (std::size_t band = 0; band < kBands; ++band) {
        whole[band] /= static_cast<float>(std::max(1, hops));
        level_[band] += share * (whole[band] - level_[band]);
        floor += kAudible * level_[band] / float{kBands};
    }
    Frame frame{};
    for (std::size_t quarter = 0; quarter < kQuarters; ++quarter) {
        // A quarter without a hop, as in a very short beat, stays 0: at its level.
        const auto count = static_cast<float>(hops_[quarter]);
        for (std::size_t band = 0; band < kBands && count > 0.0F; ++band) {
            frame[quarter * kGroups + band / kBandsAGroup] +=
                compressed(sums_[quarter][band] / count, band, floor) / float{kBandsAGroup};
        }
    }
    // Changes are summed over the bands of a group, not averaged.
    float* const changes = &frame[kQuarters * kGroups];
    for (std::size_t band = 0; band < kBands; ++band) {
        const float now = compressed(whole[band], band, floor);
        changes[band / kBandsAGroup] += beats_ > 0 ? std::abs(now - before_[band]) : kFirstChange;
        before_[band] = now;
    }
    float* const rest = changes + kGroups;
    rest[0] = kBeatScale * most_.beat;
    rest[1] = kDownbeatScale * most_.downbeat;
    rest[2] = kHalfScale * most_.half;
    rest[3] = std::log2(static_cast<float>(std::max(1, hops)) / kUsualHops);
    beats_ = std::min(beats_ + 1, kLevelBeats);
    sums_ = {};
    hops_ = {};
    most_ = {};
    return frame;
}

}  // namespace raks::audio
