#include "render/scene/stage_show.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/ext/scalar_constants.hpp>

namespace raks::render {
namespace {

constexpr float kBeatsOfRound = 4.0F;  // each kind of tile swells once in so many beats
constexpr float kSwellRiseBeats = 0.12F;
constexpr float kSwellFadeBeats = 0.9F;
constexpr float kBeatShare = 0.62F;  // of a tile's swell; the rest is the music's band
constexpr float kDriftShare = 0.3F;  // of it where no beat is known
constexpr float kDriftSpeed = 0.6F;  // radians a second
constexpr float kBeatsOfSweep = 16.0F;
constexpr float kLampHeight = 4.4F;  // metres, and so on
constexpr float kLampDepth = -2.8F;
constexpr float kRowHalfWidth = 3.2F;
constexpr float kSweepAside = 1.5F;
constexpr float kSweepDepth = 1.1F;
constexpr float kBeamAtRest = 0.4F;  // of its brightness; the rest is the music's band

float fraction(float x) noexcept { return x - std::floor(x); }

// What is left of a swell that began so many beats ago.
float swell_after(float beats) noexcept {
    const float rise = glm::smoothstep(0.0F, kSwellRiseBeats, beats);
    // It has faded to nothing before the next one begins.
    const float rest = 1.0F - glm::smoothstep(2.5F, kBeatsOfRound, beats);
    return rise * rest * std::exp(-beats / kSwellFadeBeats);
}

}  // namespace

std::array<float, 4> tile_levels(const Scene& scene) noexcept {
    std::array<float, 4> levels{};
    const auto seconds = static_cast<float>(std::fmod(scene.seconds, 1e4));
    for (std::size_t kind = 0; kind < levels.size(); ++kind) {
        const auto number = static_cast<float>(kind);
        const float since =
            kBeatsOfRound * fraction((scene.beat.position - number) / kBeatsOfRound);
        const float drift = 0.5F + 0.5F * std::sin(kDriftSpeed * seconds + 1.57F * number);
        const float beat = glm::mix(kDriftShare * drift, swell_after(since), scene.beat.confidence);
        const float band = scene.light.bands[kind % scene.light.bands.size()];
        const float swell = scene.light.rings * kBeatShare * beat + (1.0F - kBeatShare) * band;
        levels[kind] = glm::mix(scene.theme->tiles.glow, 1.0F, std::clamp(swell, 0.0F, 1.0F));
    }
    return levels;
}

Beam beam_at(const Scene& scene, int number) noexcept {
    const LightBeams& beams = scene.theme->beams;
    const auto place = static_cast<float>(number);
    const float across =
        beams.count > 1 ? 2.0F * place / static_cast<float>(beams.count - 1) - 1.0F : 0.0F;
    const float turn =
        2.0F * glm::pi<float>() * fraction(scene.beat.position / kBeatsOfSweep + 0.23F * place);
    const float band =
        scene.light.bands[static_cast<std::size_t>(number) % scene.light.bands.size()];
    Beam beam;
    beam.lamp = {kRowHalfWidth * across, kLampHeight, kLampDepth};
    beam.end = {0.55F * beam.lamp.x + kSweepAside * std::sin(turn),
                0.0F,
                -0.4F + kSweepDepth * std::cos(turn)};
    const float level = kBeamAtRest + (1.0F - kBeamAtRest) * std::max(band, scene.light.drop);
    beam.brightness = std::clamp(level * scene.light.backdrop, 0.0F, 1.0F);
    return beam;
}

glm::vec3 stage_tint(const Scene& scene) noexcept {
    const Theme& theme = *scene.theme;
    return glm::mix(glm::vec3(1.0F), theme.breakdown_tint, scene.light.breakdown) *
           glm::mix(glm::vec3(1.0F), theme.drop_tint, scene.light.drop);
}

}  // namespace raks::render
