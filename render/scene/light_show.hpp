#pragma once

#include <array>
#include <optional>

#include "base/music_state.hpp"
#include "render/scene/liveliness.hpp"

namespace raks::render {

/// Factors on a theme's lights; 1: as the theme has them.
struct LightLevels {
    float key = 1.0F;       ///< main and filling light on the dancers
    float rim = 1.0F;       ///< light from behind
    float floor = 1.0F;     ///< light on the floor
    float backdrop = 1.0F;  ///< behind the stage
    float rings = 1.0F;     ///< of light on the floor (BeatRing)
    float width = 1.0F;     ///< of the pool of light on the floor, and of the backdrop's glow
    // Shares, [0, 1]; 0: as the theme has it
    float breakdown = 0.0F;        ///< of the theme's tint in a breakdown
    float drop = 0.0F;             ///< of its tint as a drop opens the stage
    std::array<float, 3> bands{};  ///< swells of low, middle and high onsets

    friend bool operator==(const LightLevels&, const LightLevels&) = default;
};

/// Between two levels: `share` 0 gives the first, 1 the second.
[[nodiscard]] LightLevels between(const LightLevels& from,
                                  const LightLevels& to,
                                  float share) noexcept;

/// Light that moves with the music: with its energy and parts within a second or so, and with
/// strong onsets in short swells: low ones on floor and backdrop, middle ones on the edges, high
/// ones on the dancers. A breakdown dims and narrows it, a build-up lets it rise, a drop opens it
/// wide for some bars.
///
/// Nobody is hurt by it: at most two swells a second, none steeper than a tenth of a second, a part
/// of the music counts for a second and a half at least, drops open every four at most, and all
/// factors within [kDarkest, kBrightest]. (WCAG 2.2, 2.3.1, allows three flashes a second of a
/// tenth of the full brightness, on a quarter of the middle of the picture; red ones too.)
/// Threads: one. Real-time: yes.
class LightShow {
 public:
    static constexpr float kDarkest = 0.35F;   ///< no factor is less
    static constexpr float kBrightest = 1.6F;  ///< nor more
    /// At least so many seconds are between the beginnings of two swells.
    static constexpr double kSwellSeconds = 0.5;

    /// Begins as a theme has it.
    explicit LightShow(Liveliness liveliness = Liveliness::usual) noexcept
        : liveliness_(liveliness) {}

    /// From the next hop on.
    void set_liveliness(Liveliness liveliness) noexcept { liveliness_ = liveliness; }

    /// The levels at the next hop. A state that does not follow the last one begins anew.
    const LightLevels& advance(const MusicState& music) noexcept;

 private:
    // A swell rises toward what it was given and fades.
    struct Swell {
        float given = 0.0F;
        float now = 0.0F;
        void advance() noexcept;
    };

    void take_part(const MusicState& music) noexcept;
    void take_accents(const MusicState& music) noexcept;
    void open(const MusicState& music) noexcept;
    [[nodiscard]] LightLevels aim(const MusicState& music) const noexcept;

    Liveliness liveliness_;
    std::optional<HopIndex> last_hop_;
    double since_swell_ = kSwellSeconds;
    double since_build_up_ = 0.0;
    MusicPart part_ = MusicPart::stopped;  // that counts
    double since_part_ = 0.0;
    double since_drop_ = 0.0;
    float opened_ = 0.0F;  // by a drop; what is shown of it follows
    LightLevels mood_;     // without swells
    Swell low_;
    Swell middle_;
    Swell high_;
    LightLevels shown_;
};

}  // namespace raks::render
