// Parts of assimp's scene as parts of a model. Third-party types: for engine/import alone.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "engine/import/side_source.hpp"
#include "render/model/model.hpp"

#include <assimp/scene.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace raks::engine {

/// A scene that becomes a model, part after part.
struct SceneImport {
    const aiScene& scene;
    const ImportWays& ways;
    /// Whether colours are linear, as FBX has them; else they are as screens show them (sRGB).
    bool has_linear_colours = false;
    render::Model model{};
    /// Nodes of the model by the name that the scene gives them, which several may share.
    std::multimap<std::string, int, std::less<>> nodes{};
    /// For each node of the model the scene's; null: it was added.
    std::vector<const aiNode*> sources{};
    /// For each node of the model what its own scale is multiplied with: other than 1 where an FBX
    /// says that it does not take its parent's, which all nodes of a model do.
    std::vector<glm::vec3> scale_factors{};
    /// What turns and scales the scene to metres and y up. Nodes carry the turn at the root alone,
    /// and lengths are scaled, so that bones have no scale of their own.
    glm::quat turn{1.0F, 0.0F, 0.0F, 0.0F};
    float scale = 1.0F;
    /// Where the nodes are as they are stored, in metres.
    std::vector<glm::mat4> world{};
};

[[nodiscard]] glm::mat4 matrix_of(const aiMatrix4x4& matrix);

/// Nodes, turned and scaled as the scene's metadata and its root say.
/// Errors: too many, a place that is not finite.
[[nodiscard]] Expected<void> import_nodes(SceneImport& import);
/// Materials, and their pictures.
void import_materials(SceneImport& import);
/// Meshes with their skins and morph targets. Errors: corners or joints that are not there, numbers
/// that are not finite.
[[nodiscard]] Expected<void> import_meshes(SceneImport& import);
/// Clips.
void import_clips(SceneImport& import);

}  // namespace raks::engine
