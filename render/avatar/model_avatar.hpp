// From a model to an avatar: what is drawn, what moves it, and the body that dances are made for.
#pragma once

#include <memory>
#include <vector>

#include "render/avatar/avatar.hpp"
#include "render/avatar/avatar_rig.hpp"
#include "render/avatar/surface_images.hpp"
#include "render/model/image.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Builds the avatar of a model. `images`: those of the model, unpacked, in its order; an image of
/// 0 x 0 is drawn white. Normals, tangents and a default material are made where the file has none.
/// Threads: any. Real-time: no.
[[nodiscard]] Avatar build_avatar(const Model& model,
                                  std::vector<Image> images,
                                  const RigOptions& options = {});
/// The same with images, not null, that other avatars may have, too.
[[nodiscard]] Avatar build_avatar_with(std::shared_ptr<SurfaceImages> images,
                                       const Model& model,
                                       const RigOptions& options);

}  // namespace raks::render
