// The drawable surface of a model.
#pragma once

#include <memory>

#include "render/avatar/avatar_rig.hpp"
#include "render/avatar/surface.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// All meshes of the nodes that are shown. Parts lie in drawing order: opaque, cut out, then
/// blended ones by their queue. A mesh without a skin is moved by its node. `images`: null where
/// there are none.
[[nodiscard]] Surface build_surface(const Model& model,
                                    const AvatarRig& rig,
                                    std::shared_ptr<SurfaceImages> images);

}  // namespace raks::render
