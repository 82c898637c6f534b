#pragma once

#include <algorithm>

#include "audio/form/hop_sums.hpp"

/// What tells a breakdown, a drop and a build-up: the same for a stream and for a song that is
/// known.
namespace raks::audio {

/// How far a stretch fell under the full band, each share 0 (as full) to 1 (gone).
struct Fall {
    float low = 0.0F;         ///< low band: 1 at 8 dB
    float low_onsets = 0.0F;  ///< 1 at 45 % of them
    float onsets = 0.0F;      ///< 1 at 60 % of them
    float level = 0.0F;       ///< 1 at 6 dB
    /// All together, 0 to 4.
    [[nodiscard]] float sum() const noexcept { return low + low_onsets + onsets + level; }
    /// Whether the rhythm section is gone: a softer verse keeps its onsets.
    [[nodiscard]] bool is_breakdown() const noexcept {
        return sum() > 2.0F && low_onsets + onsets > 0.6F;
    }
    /// Whether the whole band plays.
    [[nodiscard]] bool is_full() const noexcept { return sum() < 1.3F && level < 0.6F; }
};

/// Compares a stretch of about a bar with the full band.
[[nodiscard]] inline Fall fall_of(const StretchSound& now, const StretchSound& full) noexcept {
    const auto share = [](float fallen) { return std::clamp(fallen, 0.0F, 1.0F); };
    return {share((full.low - now.low) / 8.0F),
            share((1.0F - now.low_onsets / (full.low_onsets + 1e-4F)) / 0.55F),
            share((1.0F - now.onsets / (full.onsets + 1e-4F)) / 0.4F),
            share((full.level - now.level) / 6.0F)};
}

/// How much the sound falls from one stretch to the next, in shares of the full band: where it is
/// greatest, the rhythm section leaves.
[[nodiscard]] inline float step_down(const StretchSound& before,
                                     const StretchSound& after,
                                     const StretchSound& full) noexcept {
    return (before.low - after.low) / 8.0F + (before.level - after.level) / 6.0F +
           (before.low_onsets - after.low_onsets) / (full.low_onsets + 1e-3F) +
           (before.onsets - after.onsets) / (full.onsets + 1e-3F);
}

/// What step_down() is where a rhythm section leaves; a song that fades out has less.
inline constexpr float kLeastStepDown = 1.4F;

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
