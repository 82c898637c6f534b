// The expressions that figures share, by name.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace raks::render {

/// The expressions that every figure may have (presets of VRM 1.0).
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
};
inline constexpr std::size_t kFaceExpressionCount = 18;

/// VRM 1.0 names.
inline constexpr std::array<std::string_view, kFaceExpressionCount> kFaceExpressionNames = {
    "happy",
    "angry",
    "sad",
    "relaxed",
    "surprised",
    "neutral",
    "aa",
    "ih",
    "ou",
    "ee",
    "oh",
    "blink",
    "blinkLeft",
    "blinkRight",
    "lookUp",
    "lookDown",
    "lookLeft",
    "lookRight",
};

}  // namespace raks::render
