#include "audio/form/accent_detector.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

// An accent is told so many hops after its own.
constexpr std::size_t kLateHops = 2;
// An accent that is so many seconds from a beat at most is on it.
constexpr double kOnBeatSeconds = 0.07;
constexpr std::size_t kHopsABlock = 100;
// The low band has few mel bands and rises by more than the middle one does.
constexpr std::array<float, kFormBands> kWeights = {0.6F, 1.0F, 0.8F};

}  // namespace

float AccentDetector::weight(const HopSound& sound) noexcept {
    float sum = 0.0F;
    for (std::size_t i = 0; i < kFormBands; ++i) {
        sum += kWeights[i] * sound.hits[i];
    }
    return sum;
}

MusicAccent AccentDetector::accent(HopIndex hop,
                                   const HopSound& sound,
                                   float strength,
                                   const BeatGrid& grid) noexcept {
    MusicAccent accent;
    accent.time = time_of_hop(hop);
    accent.strength = strength;
    std::size_t band = 0;
    for (std::size_t i = 1; i < kFormBands; ++i) {
        band = kWeights[i] * sound.hits[i] > kWeights[band] * sound.hits[band] ? i : band;
    }
    accent.band = static_cast<MusicAccent::Band>(band);
    const double beats = grid.beats_at(accent.time).count();
    const double apart = std::abs(beats - std::round(beats)) * grid.tempo.seconds_per_beat();
    accent.is_on_beat = grid.confidence >= BeatGrid::kDanceable && apart <= kOnBeatSeconds;
    return accent;
}

MusicAccent AccentDetector::advance(HopIndex hop,
                                    const HopSound& sound,
                                    const BeatGrid& grid) noexcept RAKS_NONBLOCKING {
    sounds_[hops_ % kAround] = sound;
    ++hops_;
    if (hops_ < kAround) {
        return {};
    }
    const auto ago = [this](std::size_t hops) -> const HopSound& {
        return sounds_[(hops_ - 1 - hops) % kAround];
    };
    const float here = weight(ago(kLateHops));
    // A second's strongest onset is forgotten after half a minute.
    float& block = strongest_[hops_ / kHopsABlock % kBlocks];
    if (hops_ % kHopsABlock == 0) {
        block = 0.0F;
    }
    block = std::max(block, here);
    const float strongest = *std::max_element(strongest_.begin(), strongest_.end());
    const bool is_peak = here > weight(ago(0)) && here > weight(ago(1)) && here >= weight(ago(3)) &&
                         here >= weight(ago(4));
    const HopIndex own = hop - static_cast<HopIndex>(kLateHops);
    chord_.advance(own, ago(kLateHops), is_peak ? here : 0.0F);
    if (!is_peak || here < kLeast || here < kStrong * strongest || own - last_ < kApart) {
        return {};
    }
    last_ = own;
    return accent(own, ago(kLateHops), here / strongest, grid);
}

}  // namespace raks::audio
