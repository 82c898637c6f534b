// Models out: binary glTF.
#pragma once

#include <string>

#include "base/expected.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// A model as binary glTF 2.0: nodes, meshes with skins and morph targets, materials, images as
/// they are packed, clips. Of the figure in it (Model::character) and of MToon it tells nothing:
/// see vrm_bytes. What glTF says by leaving it out is left out. The same model gives the same
/// bytes. Errors: more than 4 GiB. Threads: any. Real-time: no.
[[nodiscard]] Expected<std::string> glb_bytes(const Model& model);

}  // namespace raks::render
