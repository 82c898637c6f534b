// Eyes, lids, brows and mouth: sheets that lie on the skin of the face.
#pragma once

#include <cstdint>
#include <vector>

#include "render/mannequin/body_field.hpp"
#include "render/mannequin/mannequin.hpp"
#include "render/mannequin/painted_mesh.hpp"

namespace raks::render {

/// Adds the face; returns its morph targets, one for each FaceExpression in its order. All points
/// move with `head`, a joint of the skin. Mirror-symmetric but for the lights in the eyes.
[[nodiscard]] std::vector<MorphTarget> add_face(const BodyField& field,
                                                MannequinBuild build,
                                                std::uint16_t head,
                                                PaintedMesh& mesh);

/// Where the gaze begins: between the eyes, in the world of the T-pose.
[[nodiscard]] glm::vec3 face_eyes() noexcept;

}  // namespace raks::render
