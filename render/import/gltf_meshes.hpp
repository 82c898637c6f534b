#pragma once

#include <vector>

#include "render/import/gltf_accessors.hpp"
#include "render/import/json_field.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// The largest joint that a mesh's vertices name, -1: none.
struct MeshJoints {
    int used = -1;    ///< with a weight above 0
    int unused = -1;  ///< with weight 0: harmless
};

/// Reads all meshes into `model`: triangles alone (points and lines are left out with a warning,
/// strips and fans are taken apart), of up to eight joints a vertex the four that weigh most,
/// weights divided by their sum. Returns what each mesh asks of a skin. Faults: accessors of the
/// wrong kind or length, indices beyond the vertices, joints without weights; more than 2,000,000
/// vertices in all.
std::vector<MeshJoints> read_meshes(const JsonField& root,
                                    GltfAccessors& accessors,
                                    ImportBudget& budget,
                                    Model& model);

}  // namespace raks::render
