#pragma once

#include <algorithm>

#include "audio/form/hop_sums.hpp"

/// What tells a breakdown, a drop and a build-up: the same for a stream and for a song that is
/// known.
namespace raks::audio {

/// The full band: what the fuller bars around have.
struct FullBand {
    StretchSound usual;         ///< three quarters of the bars have less
    float low_spread = 0.0F;    ///< dB from the middle bar to that below which nine tenths lie
    float level_spread = 0.0F;  ///< likewise
    float top_spread = 0.0F;    ///< likewise

    /// `at(share, part)`: the value of a part of StretchSound below which this share of the bars
    /// lies.
    template <typename At>
    [[nodiscard]] static FullBand of(const At& at) {
        FullBand full;
        for (const auto part : {&StretchSound::low,
                                &StretchSound::level,
                                &StretchSound::top,
                                &StretchSound::low_onsets,
                                &StretchSound::onsets}) {
            full.usual.*part = at(0.75, part);
        }
        const auto spread = [&](auto part) { return at(0.9, part) - at(0.5, part); };
        full.low_spread = spread(&StretchSound::low);
        full.level_spread = spread(&StretchSound::level);
        full.top_spread = spread(&StretchSound::top);
        return full;
    }
};

/// Above 0 the rhythm section is gone, below it plays; about -3 to 4. What counts most is the top
/// of the spectrum and then the low band: cymbals, snare and kick are missed there whatever
/// guitars and pads do. A limiter leaves little of a fall, so it is measured in what the bars of
/// the full band differ by. The weights are a logistic regression's over annotated and generated
/// songs.
[[nodiscard]] inline float calmness(const StretchSound& now, const FullBand& full) noexcept {
    const auto fall = [](float usual, float level, float spread, float whole) {
        return std::clamp(
            (usual - level) / std::clamp(2.5F * spread, 0.5F * whole, whole), -0.5F, 1.5F);
    };
    const StretchSound& usual = full.usual;
    return 2.1F * fall(usual.top, now.top, full.top_spread, 10.0F) +
           1.3F * fall(usual.low, now.low, full.low_spread, 10.0F) +
           0.5F * fall(usual.level, now.level, full.level_spread, 6.0F) +
           0.4F * std::clamp(1.0F - now.onsets / (usual.onsets + 1e-4F), -0.5F, 1.0F) - 3.1F;
}

/// Below this calmness() the whole band plays.
inline constexpr float kFullBelow = -0.8F;
/// By how much calmness() must change within a bar where a rhythm section leaves; a song that fades
/// out, or a filter that closes slowly, has less.
inline constexpr float kLeastStep = 3.2F;

/// Whether the band of a song that began calm comes in between two stretches, of some seconds and
/// of half a second: everything is there that was not, and louder, which a further layer of a song
/// that grows is not.
[[nodiscard]] inline bool comes_in(const StretchSound& before, const StretchSound& after) noexcept {
    constexpr float kSpread = 4.0F;     // dB, as if the bars of the full band differed by so much
    constexpr float kLevelRise = 3.2F;  // dB
    constexpr float kLowRise = 3.5F;    // dB
    constexpr float kLeastCalm = 0.6F;  // calmness()
    return after.level - before.level > kLevelRise && after.low - before.low > kLowRise &&
           calmness(before, {after, kSpread, kSpread, kSpread}) > kLeastCalm;
}

/// How much it rises from one stretch to the next; above 1 it is the rise of a build-up.
[[nodiscard]] inline float rise_of(const StretchSound& before,
                                   const StretchSound& after,
                                   const StretchSound& full) noexcept {
    const float level = after.level - before.level;
    if (level < 1.5F) {
        return 0.0F;
    }
    return level / 8.0F + (after.brightness - before.brightness) / 16.0F +
           (after.onsets - before.onsets) / (full.onsets + 1e-3F);
}

}  // namespace raks::audio
