// What a dancer's face does: a plain value, made by who knows the music.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include <glm/vec3.hpp>

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

/// A face at one moment. All zero: the face at rest.
struct Face {
    std::array<float, kFaceExpressionCount> weights{};  ///< by FaceExpression; 0..1
    glm::vec3 gaze_target{0.0F};                        ///< where the eyes look; world, metres
    float gaze = 0.0F;  ///< 0: the eyes rest; 1: they look at the target

    [[nodiscard]] float& weight(FaceExpression expression) noexcept {
        return weights[static_cast<std::size_t>(expression)];
    }
    [[nodiscard]] float weight(FaceExpression expression) const noexcept {
        return weights[static_cast<std::size_t>(expression)];
    }
};
static_assert(std::is_trivially_copyable_v<Face>);

}  // namespace raks::render
