#pragma once

#include "audio/form/hop_sums.hpp"

/// What tells a breakdown, a drop and a build-up: the same for a stream and for a song that is
/// known.
namespace raks::audio {

/// How far a stretch fell under the full band: counts of what is gone.
struct Fall {
    bool has_low = true;     ///< the low band is there
    bool has_beat = true;    ///< its onsets are there
    bool has_onsets = true;  ///< onsets of all bands are there
    float level = 0.0F;      ///< dB under the full band
    float low = 0.0F;        ///< dB of the low band under the full band's
    /// Whether the rhythm section is gone.
    [[nodiscard]] bool is_breakdown() const noexcept {
        const int gone = (has_low ? 0 : 1) + (has_beat ? 0 : 1) + (has_onsets ? 0 : 1);
        return gone >= 2 && level > 2.0F;
    }
    /// Whether the whole band plays.
    [[nodiscard]] bool is_full() const noexcept {
        return low < 5.0F && has_beat && has_onsets && level < 3.5F;
    }
};

/// Compares a stretch of about a bar with the full band.
[[nodiscard]] inline Fall fall_of(const StretchSound& now, const StretchSound& full) noexcept {
    constexpr float kLowGone = 8.0F;     // dB
    constexpr float kBeatGone = 0.45F;   // of the onsets of the low band
    constexpr float kOnsetsGone = 0.6F;  // of all onsets
    Fall fall;
    fall.low = full.low - now.low;
    fall.level = full.level - now.level;
    fall.has_low = fall.low < kLowGone;
    fall.has_beat = now.low_onsets > kBeatGone * full.low_onsets;
    fall.has_onsets = now.onsets > kOnsetsGone * full.onsets;
    return fall;
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
