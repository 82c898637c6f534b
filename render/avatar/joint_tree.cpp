#include "render/avatar/joint_tree.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>

namespace raks::render {

JointState rest_state(std::span<const Joint> joints) {
    JointState state;
    for (const Joint& joint : joints) {
        state.translations.push_back(joint.translation);
        state.rotations.push_back(joint.rotation);
    }
    state.world.resize(joints.size());
    update_world(joints, state);
    return state;
}

void update_world(std::span<const Joint> joints, JointState& state, std::size_t first) noexcept {
    for (std::size_t i = first; i < joints.size(); ++i) {
        glm::mat4 local = glm::mat4_cast(state.rotations[i]);
        for (int column = 0; column < 3; ++column) {
            local[column] *= joints[i].scale[column];
        }
        local[3] = glm::vec4(state.translations[i], 1.0F);
        const int parent = joints[i].parent;
        state.world[i] = parent < 0 ? local : state.world[static_cast<std::size_t>(parent)] * local;
    }
}

glm::quat rotation_of(const glm::mat4& matrix) noexcept {
    glm::mat3 axes(matrix);
    for (int column = 0; column < 3; ++column) {
        const float length = glm::length(axes[column]);
        if (!(length > 0.0F)) {
            return {1.0F, 0.0F, 0.0F, 0.0F};
        }
        axes[column] /= length;
    }
    return glm::normalize(glm::quat_cast(axes));
}

}  // namespace raks::render
