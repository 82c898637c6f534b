// What the mannequin wears over its skin, as any avatar: joints, face, hair, skirt, springs.
#pragma once

#include "motion/skeleton/skeleton.hpp"
#include "render/mannequin/body_field.hpp"
#include "render/model/mannequin_style.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// A model in the T-pose: a node a bone (motion::Bone's order), then the swinging ones; expressions
/// of the standard names; a look-at by expressions; spring chains with their colliders. Materials
/// are painted: the dancer's dress colours them.
[[nodiscard]] Model worn_model(const motion::Skeleton& skeleton,
                               const BodyField& field,
                               MannequinStyle style);

}  // namespace raks::render
