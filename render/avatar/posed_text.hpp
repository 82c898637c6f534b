// A posed model as text, for scripts and other programs.
#pragma once

#include <cstddef>
#include <string>

#include "render/avatar/avatar_rig.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// The model as it is posed now, as Wavefront OBJ: metres of the file, facing +z; an object for
/// each primitive of each node, "node3.mesh0.primitive1"; vertices in the file's order, with
/// normals where the model has them. `title`: for people, in the first line. Threads: any.
/// Real-time: no.
[[nodiscard]] std::string obj_text(const Model& model,
                                   const AvatarRig& rig,
                                   const RigState& state,
                                   const std::string& title);

/// The first line of a table of joints: "frame node name x y z", with tabs between.
[[nodiscard]] std::string joint_heads();

/// Lines of that table: all joints as they are posed now; metres, facing +z.
/// Threads: any. Real-time: no.
[[nodiscard]] std::string joint_lines(const AvatarRig& rig,
                                      const RigState& state,
                                      std::size_t frame);

}  // namespace raks::render
