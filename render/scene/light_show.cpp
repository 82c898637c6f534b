#include "render/scene/light_show.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace raks::render {
namespace {

using Band = MusicAccent::Band;
using EventKind = MusicEvent::Kind;

constexpr double kLightHop = to_seconds(kHop);

// Time constants of the mood: it brightens sooner than it darkens.
constexpr double kBrightenSeconds = 0.5;
constexpr double kDarkenSeconds = 1.0;
constexpr double kSlowerWhenCalm = 4.0;  // times as slow with Liveliness::calm
constexpr float kCalmShare = 0.4F;       // of the way from 1, with Liveliness::calm
constexpr float kCalmRings = 0.35F;
constexpr double kSwellRise = 0.05;      // of a swell
constexpr double kSwellFade = 0.26;      // of a swell
constexpr double kBuildUpSeconds = 8.0;  // after which a build-up is at its brightest
// Accents weaker than this are no swell.
constexpr float kLeastAccent = 0.45F;

// What a full swell adds.
constexpr float kFloorSwell = 0.34F;
constexpr float kBackdropSwell = 0.26F;
constexpr float kRimSwell = 0.45F;
constexpr float kKeySwell = 0.10F;

float share_in_hop(double seconds) noexcept {
    return 1.0F - static_cast<float>(std::exp(-kLightHop / seconds));
}

LightLevels limited(const LightLevels& levels) noexcept {
    const auto limit = [](float level) {
        return std::clamp(level, LightShow::kDarkest, LightShow::kBrightest);
    };
    return {limit(levels.key),
            limit(levels.rim),
            limit(levels.floor),
            limit(levels.backdrop),
            levels.rings};
}

void approach(float& level, float aim, double slowness) noexcept {
    const double seconds = aim > level ? kBrightenSeconds : kDarkenSeconds;
    level += share_in_hop(slowness * seconds) * (aim - level);
}

}  // namespace

LightLevels between(const LightLevels& from, const LightLevels& to, float share) noexcept {
    return {glm::mix(from.key, to.key, share),
            glm::mix(from.rim, to.rim, share),
            glm::mix(from.floor, to.floor, share),
            glm::mix(from.backdrop, to.backdrop, share),
            glm::mix(from.rings, to.rings, share)};
}

void LightShow::Swell::advance() noexcept {
    now += share_in_hop(kSwellRise) * (given - now);
    given -= share_in_hop(kSwellFade) * given;
}

const LightLevels& LightShow::advance(const MusicState& music) noexcept {
    if (!last_hop_ || music.hop != *last_hop_ + 1) {
        *this = LightShow(liveliness_);
    }
    last_hop_ = music.hop;
    since_swell_ += kLightHop;
    since_build_up_ = music.part == MusicPart::build_up ? since_build_up_ + kLightHop : 0.0;
    take_accents(music);
    const LightLevels to = aim(music);
    const double slowness = liveliness_ == Liveliness::calm ? kSlowerWhenCalm : 1.0;
    approach(mood_.key, to.key, slowness);
    approach(mood_.rim, to.rim, slowness);
    approach(mood_.floor, to.floor, slowness);
    approach(mood_.backdrop, to.backdrop, slowness);
    low_.advance();
    middle_.advance();
    high_.advance();
    shown_ = limited({mood_.key + kKeySwell * (high_.now + 0.5F * middle_.now),
                      mood_.rim + kRimSwell * (middle_.now + 0.5F * high_.now),
                      mood_.floor + kFloorSwell * low_.now,
                      mood_.backdrop + kBackdropSwell * low_.now,
                      liveliness_ == Liveliness::calm ? kCalmRings : 1.0F});
    return shown_;
}

// An onset, or a drop, which is one in all bands. What comes too soon after the last is left out.
void LightShow::take_accents(const MusicState& music) noexcept {
    if (liveliness_ == Liveliness::calm || since_swell_ < kSwellSeconds) {
        return;
    }
    if (music.event.kind == EventKind::drop) {
        low_.given = middle_.given = high_.given = 1.0F;
    } else if (music.accent.strength >= kLeastAccent) {
        Swell& swell = music.accent.band == Band::low      ? low_
                       : music.accent.band == Band::middle ? middle_
                                                           : high_;
        swell.given = std::min(music.accent.strength, 1.0F);
    } else {
        return;
    }
    since_swell_ = 0.0;
}

// Where the mood goes.
LightLevels LightShow::aim(const MusicState& music) const noexcept {
    const float energy = 0.5F * (music.energy.now + music.energy.lately);
    LightLevels levels;
    switch (music.part) {
        case MusicPart::stopped:
            levels = {0.80F, 0.75F, 0.72F, 0.62F};
            break;
        case MusicPart::playing:
            levels = {0.88F + 0.24F * energy,
                      0.75F + 0.50F * energy,
                      0.80F + 0.40F * energy,
                      0.75F + 0.50F * energy};
            break;
        case MusicPart::breakdown:
            levels = {0.76F, 1.15F, 0.70F, 0.60F};
            break;
        case MusicPart::build_up: {
            const auto way = static_cast<float>(std::min(since_build_up_ / kBuildUpSeconds, 1.0));
            levels = {
                0.80F + 0.15F * way, 1.10F + 0.15F * way, 0.75F + 0.25F * way, 0.65F + 0.40F * way};
            break;
        }
    }
    return liveliness_ == Liveliness::calm ? between({}, levels, kCalmShare) : levels;
}

}  // namespace raks::render
