// The expressions that figures share, by name.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace raks::render {

/// The expressions that every figure may have: presets of VRM 1.0, then those of Raks.
enum class FaceExpression : std::uint8_t {
    happy,
    angry,
    sad,
    relaxed,
    surprised,
    neutral,
    aa,
    ih,
    ou,
    ee,
    oh,
    blink,
    blink_left,
    blink_right,
    look_up,
    look_down,
    look_left,
    look_right,
    brow_up_left,  ///< the left brow alone is raised
    brow_up_right,
};
inline constexpr std::size_t kFaceExpressionCount = 20;
/// How many of them, the first, are presets of VRM 1.0.
inline constexpr std::size_t kPresetExpressionCount = 18;

/// VRM 1.0 names, then those of Raks.
inline constexpr std::array<std::string_view, kFaceExpressionCount> kFaceExpressionNames = {
    "happy",  "angry",    "sad",      "relaxed",   "surprised",  "neutral",     "aa",
    "ih",     "ou",       "ee",       "oh",        "blink",      "blinkLeft",   "blinkRight",
    "lookUp", "lookDown", "lookLeft", "lookRight", "browUpLeft", "browUpRight",
};

/// Whether VRM 1.0 has an expression of this name.
[[nodiscard]] constexpr bool is_preset_expression(std::string_view name) noexcept {
    for (std::size_t i = 0; i < kPresetExpressionCount; ++i) {
        if (kFaceExpressionNames[i] == name) {
            return true;
        }
    }
    return false;
}

}  // namespace raks::render
