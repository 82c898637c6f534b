// Dance mood: how the faces of a dance's dancers look.
#pragma once

#include <array>

#include "motion/skeleton/feeling.hpp"

namespace raks::motion {

/// How the faces of a dance's dancers look; what the music does comes on top.
struct DanceMood {
    Emotion base = Emotion::relaxed;  ///< what a face comes back to
    float strength = 0.38F;           ///< how much of it there is; [0, 1]
    /// How often each emotion passes over the face, against the others; by Emotion, at least 0.
    /// That of `base` means nothing.
    std::array<float, kEmotionCount> passing{3.0F, 0.7F, 0.5F, 1.5F, 1.0F};
    float teeth = 0.15F;  ///< share of the strong accents at which they show; [0, 1]
    float brows = 0.40F;  ///< share of the passing emotions that raise one brow; [0, 1]
    float away = 0.30F;   ///< share of the looks that go past who watches; [0, 1]

    friend bool operator==(const DanceMood&, const DanceMood&) = default;
};

}  // namespace raks::motion
