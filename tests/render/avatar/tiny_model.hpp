#pragma once

#include <string>

#include "motion/skeleton/skeleton.hpp"
#include "render/avatar/joint_tree.hpp"
#include "render/model/model.hpp"

namespace raks::render::test {

/// Adds a node and says its index; without parent it is a root of the scene.
int add_node(Model& model,
             const std::string& name,
             int parent,
             const glm::vec3& translation,
             const glm::quat& rotation = motion::kNoRotation);

/// A turn by an angle in radians.
glm::quat turn_about_x(float angle);
glm::quat turn_about_y(float angle);
glm::quat turn_about_z(float angle);

/// The bones of the built-in skeleton as a model: node i is bone i, rest rotations are 1.
Model humanoid_model();

/// The same body, whose every joint is turned at rest by some rotation of its own.
Model crooked_humanoid_model();

/// A chain of joints hanging from a root: "root" at `start`, then `count` more joints, each
/// `offset` further. All but the last swing.
Model hanging_chain(const glm::vec3& start, const glm::vec3& offset, int count);

/// Whether two rotations are the same up to `radians`.
bool is_same_rotation(const glm::quat& a, const glm::quat& b, float radians = 1e-4F);

}  // namespace raks::render::test
