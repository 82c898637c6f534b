// Feeling: what a dancer's face is to show.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace raks::motion {

/// The emotions of a face (those of VRM 1.0).
enum class Emotion : std::uint8_t { happy, angry, sad, relaxed, surprised };
/// Number of emotions.
inline constexpr std::size_t kEmotionCount = 5;
/// Names in files, in the order of Emotion.
inline constexpr std::array<std::string_view, kEmotionCount> kEmotionNames = {
    "happy", "angry", "sad", "relaxed", "surprised"};

/// What a face is to show at one moment. All zero: nothing.
struct Feeling {
    std::array<float, kEmotionCount> emotions{};  ///< by Emotion; [0, 1], together at most 1
    float teeth = 0.0F;                           ///< [0, 1]: how far lips part to show them
    float brows = 0.0F;  ///< [-1, 1]: the left brow is raised more than the other; below 0: right
    float audience = 0.0F;  ///< [0, 1]: how surely the eyes go to who watches

    /// How much of an emotion there is.
    [[nodiscard]] float& of(Emotion emotion) noexcept {
        return emotions[static_cast<std::size_t>(emotion)];
    }
    /// How much of an emotion there is.
    [[nodiscard]] float of(Emotion emotion) const noexcept {
        return emotions[static_cast<std::size_t>(emotion)];
    }
    friend bool operator==(const Feeling&, const Feeling&) = default;
};
static_assert(std::is_trivially_copyable_v<Feeling>);

/// The feeling at share `t` of the way from one to the other. Threads: any. Real-time: yes.
[[nodiscard]] constexpr Feeling interpolate(const Feeling& from,
                                            const Feeling& to,
                                            float t) noexcept {
    const auto between = [t](float a, float b) { return a + t * (b - a); };
    Feeling feeling;
    for (std::size_t i = 0; i < kEmotionCount; ++i) {
        feeling.emotions[i] = between(from.emotions[i], to.emotions[i]);
    }
    feeling.teeth = between(from.teeth, to.teeth);
    feeling.brows = between(from.brows, to.brows);
    feeling.audience = between(from.audience, to.audience);
    return feeling;
}

}  // namespace raks::motion
