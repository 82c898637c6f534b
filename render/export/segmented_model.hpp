// A model cut into rigid parts, for formats that have no skins.
#pragma once

#include "render/model/model.hpp"

namespace raks::render {

/// The model with a rigid mesh for each bone instead of skins: each triangle goes to the bone that
/// weighs most at its corners, as it is at rest. Where the bones of a body are known, what hangs
/// below one of them (helpers, hair) goes to it, and of the other nodes those alone are kept on
/// which a bone or a mesh hangs. Kept: materials, pictures, first texture coordinates, the bones
/// and the licence; left out: clips, morph targets, constraints, springs, expressions. Threads:
/// any. Real-time: no.
[[nodiscard]] Model segmented_model(const Model& model);

}  // namespace raks::render
