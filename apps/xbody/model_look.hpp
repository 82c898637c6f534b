// Model look: a model in other colours, and without some of its nodes.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "render/model/model.hpp"

namespace raks::apps {

/// What the colours of a model tell.
enum class ModelPaint : std::uint8_t {
    own,      ///< its materials
    normals,  ///< where its surface faces at rest: x red, y green, z blue; 0.5 is 0
    weights,  ///< how much the chosen joint moves each vertex: blue 0, green a half, red all
    dark,     ///< all the same, so that edges show before a bright floor
};

/// How a model is drawn.
struct ModelLook {
    ModelPaint paint = ModelPaint::own;
    int joint = -1;               ///< node of the weights; -1: none is chosen, all are 0
    std::vector<bool> is_hidden;  ///< by node: its mesh is left out; empty: none is
    friend bool operator==(const ModelLook&, const ModelLook&) = default;
};

/// Linear colour of a weight, [0, 1].
[[nodiscard]] glm::vec3 colour_of_weight(float weight) noexcept;

/// The model so that it is drawn in that way; its images are not in it. Paints other than its own
/// are without light. A mesh without a skin has weight 1 for its own node, else 0. Threads: any.
/// Real-time: no.
[[nodiscard]] render::Model looked(const render::Model& model, const ModelLook& look);

}  // namespace raks::apps
