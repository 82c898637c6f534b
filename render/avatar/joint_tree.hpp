// The joints of an avatar as a tree, and where they are in one picture.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// One joint at rest, against its parent.
struct Joint {
    std::string name;
    int parent = -1;  ///< an earlier joint; -1: none
    glm::vec3 translation{0.0F};
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec3 scale{1.0F};
};

/// Where the joints are: what drivers (bones, constraints, springs) write and drawing reads. All
/// arrays are as long as the tree.
struct JointState {
    std::vector<glm::vec3> translations;  ///< against the parent
    std::vector<glm::quat> rotations;     ///< against the parent
    std::vector<glm::mat4> world;         ///< avatar's space from the joint's
};

/// The state at rest.
[[nodiscard]] JointState rest_state(std::span<const Joint> joints);

/// Computes `world` of joint `first` and all behind it from translations, rotations, and the
/// scales at rest. Threads: any. Real-time: yes.
void update_world(std::span<const Joint> joints, JointState& state, std::size_t first = 0) noexcept;

/// The rotation in a matrix of rotation and scale above 0; the identity where a scale is 0.
/// Threads: any. Real-time: yes.
[[nodiscard]] glm::quat rotation_of(const glm::mat4& matrix) noexcept;

}  // namespace raks::render
