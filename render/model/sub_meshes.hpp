// Sub-meshes: what each part of a model's meshes is made of, in numbers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/model/model.hpp"
#include "render/model/model_survey.hpp"

namespace raks::render {

/// The triangles of one material in the mesh of one node.
struct SubMesh {
    int node = -1;
    std::size_t primitive = 0;  ///< of the node's mesh
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    int material = -1;                          ///< in Model::materials; -1: glTF's default
    std::vector<std::pair<int, int>> textures;  ///< width, height in the file; each image once
    std::size_t joints = 0;                     ///< that weights above 0 name
    std::size_t uneven_weights = 0;             ///< vertices whose weights do not sum to 1 (0.001)
    std::size_t morphs = 0;                     ///< targets
    std::optional<ModelBox> box;                ///< at rest, in the file's metres
};

/// The textures that a material uses; of some the texture is -1: none.
[[nodiscard]] std::vector<TextureUse> textures_of(const ModelMaterial& material);
/// Of each image whether a material uses it.
[[nodiscard]] std::vector<bool> used_images(const Model& model);

/// Those of all nodes that are shown, in the order of the nodes. Threads: any. Real-time: no.
[[nodiscard]] std::vector<SubMesh> sub_meshes(const Model& model);

}  // namespace raks::render
