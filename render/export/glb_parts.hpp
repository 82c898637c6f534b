// Parts of a model as parts of a glTF document. For render/export alone.
#pragma once

#include "base/gltf/glb_document.hpp"
#include "render/model/model.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace raks::render {

using Json = GlbDocument::Json;

/// All of the model that glTF itself can say, in this order.
void add_model(const Model& model, GlbDocument& glb);

void add_nodes(const Model& model, GlbDocument& glb);
void add_meshes(const Model& model, GlbDocument& glb);
void add_skins(const Model& model, GlbDocument& glb);
void add_materials(const Model& model, GlbDocument& glb);
void add_animations(const Model& model, GlbDocument& glb);

/// Where a material uses a texture, as glTF's textureInfo; it has one. Names the extension that it
/// needs.
[[nodiscard]] Json texture_info(const TextureUse& use, GlbDocument& glb);

/// The same as a member of `json`; none: nothing.
void put_texture(const TextureUse& use, const char* name, GlbDocument& glb, Json& json);

/// The numbers of vectors, as the document takes them.
template <typename Vector>
[[nodiscard]] std::span<const float> floats_of(const std::vector<Vector>& values) {
    static_assert(sizeof(Vector) % sizeof(float) == 0 && std::is_trivially_copyable_v<Vector>);
    return {reinterpret_cast<const float*>(values.data()),
            values.size() * (sizeof(Vector) / sizeof(float))};
}

[[nodiscard]] inline Json numbers_of(const glm::vec2& v) { return {v.x, v.y}; }
[[nodiscard]] inline Json numbers_of(const glm::vec3& v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline Json numbers_of(const glm::vec4& v) { return {v.x, v.y, v.z, v.w}; }
/// x, y, z, w, as glTF has them.
[[nodiscard]] inline Json numbers_of(const glm::quat& q) { return {q.x, q.y, q.z, q.w}; }

}  // namespace raks::render
