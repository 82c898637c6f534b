// Bones by the names of nodes.
#pragma once

#include "render/import/joint_shape.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// The bones that names give away, by motion::bones_by_name. Nodes that move nothing of the skin
/// are taken only for want of others. `flesh`: of all nodes; empty: it is not known.
[[nodiscard]] HumanoidMap map_by_names(const Model& model, const NodeFlesh& flesh = {});

}  // namespace raks::render
