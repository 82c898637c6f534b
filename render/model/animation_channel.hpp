// Animation channel: the value of what a clip of a model moves, at any time.
#pragma once

#include "render/model/model.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace raks::render {

/// Value of a channel at a time: 3 numbers (translation, scale), 4 (rotation, x y z w, unit), the
/// first 4 of weights. Threads: any. Real-time: yes.
[[nodiscard]] glm::vec4 sample_channel(const AnimationChannel& channel, float seconds) noexcept;

/// Where a node is against its parent.
struct NodePlace {
    glm::vec3 translation{};
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec3 scale{1.0F};
};

/// The channels of a clip that move one node; null: as stored. The clip must outlive it.
struct NodeChannels {
    const AnimationChannel* translation = nullptr;
    const AnimationChannel* rotation = nullptr;
    const AnimationChannel* scale = nullptr;

    /// Takes a channel of this node in; one of weights moves no node.
    void take(const AnimationChannel& channel) noexcept;
    /// Whether anything moves the node.
    [[nodiscard]] bool is_moved() const noexcept {
        return translation != nullptr || rotation != nullptr || scale != nullptr;
    }
    /// Where `node`, whose channels these are, is at a time. Threads: any. Real-time: yes.
    [[nodiscard]] NodePlace at(const ModelNode& node, float seconds) const noexcept;
};

}  // namespace raks::render
