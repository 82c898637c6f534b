// Skins of an imported model. Third-party types: for engine/import alone.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/import/scene_parts.hpp"

namespace raks::engine {

/// A joint as a mesh binds it.
struct BoundJoint {
    int node = -1;
    glm::mat4 inverse_bind{1.0F};
};

/// Skins that grow: meshes that are bound the same way to some of the same joints share one.
class SkinPool {
 public:
    explicit SkinPool(render::Model& model) : model_(model) {}

    /// The skin that has all of these joints, each once; `places`: which joint of it each is.
    int skin_of(std::span<const BoundJoint> joints, std::vector<std::uint16_t>& places);

 private:
    [[nodiscard]] bool fits(const render::ModelSkin& skin,
                            std::span<const BoundJoint> joints) const;

    render::Model& model_;
};

}  // namespace raks::engine
