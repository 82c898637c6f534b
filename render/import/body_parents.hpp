// Body parents: what hangs on what in a model, as a body is built.
#pragma once

#include <string>
#include <vector>

#include "render/model/model.hpp"

namespace raks::render {

/// Parent of each node. The file's, but that a bone which hangs elsewhere (feet of a rig for
/// inverse kinematics) is moved below the bone of which it is a part, with all that carries it
/// alone; and that hips which hang under their trunk carry it. Acyclic. The model's humanoid is
/// mapped.
struct BodyParents {
    std::vector<int> parents;
    std::vector<std::string> notes;  ///< what was moved; one line each
};

/// Threads: any. Real-time: no.
[[nodiscard]] BodyParents body_parents(const Model& model);

/// All nodes, every parent before its children. `parents`: acyclic.
[[nodiscard]] std::vector<std::size_t> parents_first(const std::vector<int>& parents);

}  // namespace raks::render
