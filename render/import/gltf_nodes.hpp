#pragma once

#include <vector>

#include "render/import/gltf_accessors.hpp"
#include "render/import/gltf_meshes.hpp"
#include "render/import/json_field.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Reads nodes and the scene that is shown into `model`, whose meshes are read already. Matrices
/// are taken apart; rotations become unit. Faults: a node that is its own ancestor or has two
/// parents, a scene of nodes that are no roots, more than 20,000 nodes or 1,000 below one another.
/// `skins`: how many the file has.
void read_nodes(const JsonField& root, std::size_t skins, Model& model);

/// Reads skins into `model`, whose nodes are read already. Faults: no joints, fewer inverse bind
/// matrices than joints, a mesh that names a joint beyond its skin. `joints`: what each mesh asks
/// for (read_meshes); of meshes whose weightless joints lie beyond, these become joint 0.
void read_skins(const JsonField& root,
                GltfAccessors& accessors,
                const std::vector<MeshJoints>& joints,
                Model& model);

}  // namespace raks::render
