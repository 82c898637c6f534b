#include "render/scene/scene.hpp"

#include <algorithm>
#include <cmath>

namespace raks::render {
namespace {

// The ring starts at the feet and slows down on its way out, as a wave does.
constexpr float kFirstRadius = 0.30F;    // metres
constexpr float kReach = 1.05F;          // metres from the first to the last radius
constexpr float kRunSeconds = 0.55F;     // time constant of the way out
constexpr float kFadeSeconds = 0.40F;    // time constant of the light
constexpr float kDarkest = 0.02F;        // below it nothing is drawn
constexpr float kBeatBrightness = 0.6F;  // of a beat that is no downbeat
constexpr float kLeastConfidence = 0.05F;

}  // namespace

BeatRing beat_ring(float age, BeatAccent accent) noexcept {
    // Written so that NaN is refused, too.
    if (!(age >= 0.0F)) {
        return {};
    }
    const float full = accent == BeatAccent::downbeat ? 1.0F : kBeatBrightness;
    const float brightness = full * std::exp(-age / kFadeSeconds);
    if (brightness < kDarkest) {
        return {};
    }
    return {kFirstRadius + kReach * (1.0F - std::exp(-age / kRunSeconds)), brightness};
}

BeatRings beat_rings(const BeatGrid& grid, StreamTime time) noexcept {
    BeatRings rings{};
    if (!(grid.confidence >= kLeastConfidence)) {
        return rings;
    }
    // The last beat and the two before it; the ring of any older one is faint.
    double beat = std::floor(grid.beats_at(time).count());
    for (BeatRing& ring : rings) {
        const Nanos age = time - grid.time_of(Beats(beat));
        // Positions are whole at a beat up to rounding: 0 is the downbeat.
        const bool is_downbeat = grid.bar_position(Beats(beat)) < 0.5;
        ring = beat_ring(static_cast<float>(to_seconds(age)),
                         is_downbeat ? BeatAccent::downbeat : BeatAccent::beat);
        beat -= 1.0;
    }
    return rings;
}

StageBeat stage_beat(const BeatGrid& grid, StreamTime time) noexcept {
    constexpr double kRound = 16.0;
    const double beats = grid.beats_at(time).count();
    const double position = beats - kRound * std::floor(beats / kRound);
    return {static_cast<float>(position), std::clamp(grid.confidence, 0.0F, 1.0F)};
}

float floor_size_for(float reach) noexcept {
    constexpr float kUsualReach = 1.4F;  // metres: of three side by side
    constexpr float kByMetre = 0.3F;
    return 1.0F + kByMetre * std::max(reach - kUsualReach, 0.0F);
}

}  // namespace raks::render
