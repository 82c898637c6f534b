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

// A part counts for so long, whatever the next one is.
constexpr double kLeastPartSeconds = 1.5;
// What a drop opens falls back to the music's own light with this time constant, and soon where the
// music does not go on.
constexpr double kOpenSeconds = 14.0;
constexpr double kCloseSeconds = 0.8;
constexpr double kOpeningSeconds = 0.09;
constexpr double kCalmOpeningSeconds = 2.5;
constexpr double kLeastBetweenDrops = 4.0;
// And what it adds.
constexpr float kOpenKey = 0.12F;
constexpr float kOpenRim = 0.10F;
constexpr float kOpenFloor = 0.25F;
constexpr float kOpenBackdrop = 0.35F;
constexpr float kOpenWidth = 0.5F;

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
            levels.rings,
            levels.width,
            levels.breakdown,
            levels.drop,
            levels.bands};
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
            glm::mix(from.rings, to.rings, share),
            glm::mix(from.width, to.width, share),
            glm::mix(from.breakdown, to.breakdown, share),
            glm::mix(from.drop, to.drop, share),
            {glm::mix(from.bands[0], to.bands[0], share),
             glm::mix(from.bands[1], to.bands[1], share),
             glm::mix(from.bands[2], to.bands[2], share)}};
}

void LightShow::Swell::advance() noexcept {
    now += share_in_hop(kSwellRise) * (given - now);
    given -= share_in_hop(kSwellFade) * given;
}

const LightLevels& LightShow::advance(const MusicState& music) noexcept {
    if (!last_hop_ || music.hop != *last_hop_ + 1) {
        *this = LightShow(liveliness_);
        part_ = music.part;
        since_drop_ = kLeastBetweenDrops;
    }
    last_hop_ = music.hop;
    since_swell_ += kLightHop;
    take_part(music);
    take_accents(music);
    open(music);
    const LightLevels to = aim(music);
    const bool is_calm = liveliness_ == Liveliness::calm;
    const double slowness = is_calm ? kSlowerWhenCalm : 1.0;
    approach(mood_.key, to.key, slowness);
    approach(mood_.rim, to.rim, slowness);
    approach(mood_.floor, to.floor, slowness);
    approach(mood_.backdrop, to.backdrop, slowness);
    approach(mood_.width, to.width, slowness);
    approach(mood_.breakdown, to.breakdown, slowness);
    mood_.drop +=
        share_in_hop(is_calm ? kCalmOpeningSeconds : kOpeningSeconds) * (to.drop - mood_.drop);
    low_.advance();
    middle_.advance();
    high_.advance();
    shown_ =
        limited({mood_.key + kKeySwell * (high_.now + 0.5F * middle_.now) + kOpenKey * mood_.drop,
                 mood_.rim + kRimSwell * (middle_.now + 0.5F * high_.now) + kOpenRim * mood_.drop,
                 mood_.floor + kFloorSwell * low_.now + kOpenFloor * mood_.drop,
                 mood_.backdrop + kBackdropSwell * low_.now + kOpenBackdrop * mood_.drop,
                 liveliness_ == Liveliness::calm ? kCalmRings : 1.0F,
                 mood_.width + kOpenWidth * mood_.drop,
                 mood_.breakdown,
                 mood_.drop,
                 {low_.now, middle_.now, high_.now}});
    return shown_;
}

// The part that counts. (Parts of music last for bars; this is for what is none.)
void LightShow::take_part(const MusicState& music) noexcept {
    since_part_ += kLightHop;
    if (music.part != part_ && since_part_ >= kLeastPartSeconds) {
        part_ = music.part;
        since_part_ = 0.0;
    }
    since_build_up_ = part_ == MusicPart::build_up ? since_build_up_ + kLightHop : 0.0;
}

void LightShow::open(const MusicState& music) noexcept {
    since_drop_ += kLightHop;
    opened_ -= share_in_hop(part_ == MusicPart::playing ? kOpenSeconds : kCloseSeconds) * opened_;
    if (music.event.kind == EventKind::drop && since_drop_ >= kLeastBetweenDrops) {
        opened_ = 1.0F;
        since_drop_ = 0.0;
        part_ = MusicPart::playing;
        since_part_ = 0.0;
    }
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
    switch (part_) {
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
            levels = {0.66F, 1.15F, 0.48F, 0.36F};
            levels.width = 0.6F;
            levels.breakdown = 1.0F;
            break;
        case MusicPart::build_up: {
            const auto way = static_cast<float>(std::min(since_build_up_ / kBuildUpSeconds, 1.0));
            levels = {
                0.68F + 0.24F * way, 1.15F + 0.10F * way, 0.52F + 0.40F * way, 0.42F + 0.55F * way};
            levels.width = 0.6F + 0.35F * way;
            levels.breakdown = 1.0F - way;
            break;
        }
    }
    levels.drop = opened_;
    return liveliness_ == Liveliness::calm ? between({}, levels, kCalmShare) : levels;
}

}  // namespace raks::render
