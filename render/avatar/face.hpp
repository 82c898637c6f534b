// What a dancer's face does: a plain value, made by who knows the music.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "render/model/expression_names.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

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
