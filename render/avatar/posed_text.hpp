// A posed model as text, for scripts and other programs.
#pragma once

#include <cstddef>
#include <string>

#include "render/avatar/avatar_rig.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// The model as it is posed now, as Wavefront OBJ: metres of the file, facing +z; an object for
/// each primitive of each node, "node3.mesh0.primitive1"; vertices in the file's order, with
/// normals where the model has them. `title`: for people, in the first line. `materials`: the name
/// of the file with mtl_text; empty: no materials are named. Threads: any. Real-time: no.
[[nodiscard]] std::string obj_text(const Model& model,
                                   const AvatarRig& rig,
                                   const RigState& state,
                                   const std::string& title,
                                   const std::string& materials = {});

/// The materials of a model as Wavefront's MTL: their linear colours and what shines through,
/// without textures. Threads: any. Real-time: no.
[[nodiscard]] std::string mtl_text(const Model& model);

/// The first line of a table of joints: "frame node name x y z", with tabs between.
[[nodiscard]] std::string joint_heads();

/// Lines of that table: all joints as they are posed now; metres, facing +z.
/// Threads: any. Real-time: no.
[[nodiscard]] std::string joint_lines(const AvatarRig& rig,
                                      const RigState& state,
                                      std::size_t frame);

}  // namespace raks::render
