// Parts of a figure as extensions of VRM 1.0. For render/export alone.
#pragma once

#include "render/export/glb_parts.hpp"

namespace raks::render {

/// VRMC_springBone; nothing where nothing swings.
void add_springs(const Character& character, GlbDocument& glb);
/// VRMC_node_constraint of the nodes, which are there already.
void add_constraints(const Character& character, GlbDocument& glb);
/// VRMC_materials_mtoon of the materials, which are there already.
void add_mtoon(const Model& model, GlbDocument& glb);
/// The member "expressions" of VRMC_vrm.
[[nodiscard]] Json expressions_of(const Model& model);

}  // namespace raks::render
