#pragma once

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

    friend bool operator==(const LightLevels&, const LightLevels&) = default;
};

/// Between two levels: `share` 0 gives the first, 1 the second.
[[nodiscard]] LightLevels between(const LightLevels& from,
                                  const LightLevels& to,
                                  float share) noexcept;

/// Light that moves with the music: with its energy and parts within a second or so, and with
/// strong onsets in short swells: low ones on floor and backdrop, middle ones on the edges, high
/// ones on the dancers.
///
/// Nobody is hurt by it: at most two swells a second, none steeper than a tenth of a second, and
/// all factors within [kDarkest, kBrightest]. (WCAG 2.2, 2.3.1, allows three flashes a second of a
/// tenth of the full brightness, on a quarter of the middle of the picture; red ones too.)
/// Threads: one. Real-time: yes.
class LightShow {
 public:
    static constexpr float kDarkest = 0.5F;    ///< no factor is less
    static constexpr float kBrightest = 1.5F;  ///< nor more
    /// At least so many seconds are between the beginnings of two swells.
    static constexpr double kSwellSeconds = 0.5;

    /// Begins as a theme has it.
    explicit LightShow(Liveliness liveliness = Liveliness::usual) noexcept
        : liveliness_(liveliness) {}

    /// The levels at the next hop. A state that does not follow the last one begins anew.
    const LightLevels& advance(const MusicState& music) noexcept;

 private:
    // A swell rises toward what it was given and fades.
    struct Swell {
        float given = 0.0F;
        float now = 0.0F;
        void advance() noexcept;
    };

    void take_accents(const MusicState& music) noexcept;
    [[nodiscard]] LightLevels aim(const MusicState& music) const noexcept;

    Liveliness liveliness_;
    std::optional<HopIndex> last_hop_;
    double since_swell_ = kSwellSeconds;
    double since_build_up_ = 0.0;
    LightLevels mood_;  // without swells
    Swell low_;
    Swell middle_;
    Swell high_;
    LightLevels shown_;
};

}  // namespace raks::render
