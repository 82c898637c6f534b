#pragma once

#include "render/model/model.hpp"

namespace raks::engine {

/// Makes one of vertices that are alike in all that they have; corners and morph targets follow.
/// Vertices keep the order in which each is met first. Readers of formats that keep places, normals
/// and texture coordinates apart give every corner of every face a vertex of its own.
/// Threads: any. Real-time: no.
void weld(render::ModelPrimitive& primitive);

}  // namespace raks::engine
