// The mannequin's face as numbers, and the shape of each expression.
#pragma once

#include <array>

#include "render/avatar/face.hpp"

namespace raks::render {

/// What can move in the face. All zero: the face at rest. Lengths in metres.
struct FaceShape {
    std::array<float, 2> lids{};  ///< left, right; 0: open, 1: the upper lid lies on the lower
    float lower_lids = 0.0F;      ///< rise of the lower lids, share of the opening
    float gaze_right = 0.0F;      ///< of the irises, towards +x (the figure's left)
    float gaze_up = 0.0F;
    float brow_inner = 0.0F;  ///< rise of the brows' inner ends
    float brow_outer = 0.0F;
    std::array<float, 2> brow_up{};  ///< left, right: rise of that brow alone
    float mouth_open = 0.0F;         ///< height of the opening
    float mouth_wider = 0.0F;        ///< of half its width
    float corners_up = 0.0F;         ///< of the mouth
};

/// The shape of an expression at weight 1. Pure.
[[nodiscard]] FaceShape face_shape(FaceExpression expression) noexcept;

}  // namespace raks::render
