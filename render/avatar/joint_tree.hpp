// The joints of an avatar as a tree, and where they are in one picture.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "render/model/animation_channel.hpp"
#include "render/model/model.hpp"

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

/// The nodes of a model as joints: parents first, each joint followed by all that hang from it.
struct JointTree {
    std::vector<Joint> joints;
    std::vector<int> nodes;          ///< node of each joint
    std::vector<int> joint_of_node;  ///< -1: the node is not shown
    float scale = 1.0F;              ///< against the file

    /// The joint of a node; -1 for -1 and for nodes that are not shown.
    [[nodiscard]] int joint_of(int node) const noexcept {
        return node < 0 ? -1 : joint_of_node[static_cast<std::size_t>(node)];
    }
};

/// Joints of the nodes of the scene that is shown, and of those that a skin needs besides. What
/// has no parent is turned about y by half a turn where the model faces -z, so that all avatars
/// face +z, and made `scale` times as large.
[[nodiscard]] JointTree build_joint_tree(const Model& model, float scale = 1.0F);

/// Where the joints are: what drivers (bones, constraints, springs) write and drawing reads. All
/// arrays are as long as the tree.
struct JointState {
    std::vector<glm::vec3> translations;  ///< against the parent
    std::vector<glm::quat> rotations;     ///< against the parent
    std::vector<glm::vec3> scales;        ///< against the parent
    std::vector<glm::mat4> world;         ///< avatar's space from the joint's
};

/// The state at rest.
[[nodiscard]] JointState rest_state(std::span<const Joint> joints);

/// Puts translations, rotations and scales back to where they rest; `world` is not computed.
/// Threads: any. Real-time: yes.
void go_to_rest(std::span<const Joint> joints, JointState& state) noexcept;

/// The state in a model's T-pose. `t_pose`: local rotations by node; empty: it is the rest pose, as
/// in all VRM.
[[nodiscard]] JointState t_pose_state(const Model& model,
                                      const JointTree& tree,
                                      std::span<const glm::quat> t_pose);

/// Computes `world` of joint `first` and all behind it from translations, rotations and scales.
/// Threads: any. Real-time: yes.
void update_world(std::span<const Joint> joints, JointState& state, std::size_t first = 0) noexcept;

/// `world` of one joint, from what is written now in it and in all above it: for drivers that need
/// a place before `update_world`. Threads: any. Real-time: yes (O(depth)).
[[nodiscard]] glm::mat4 compute_world(std::span<const Joint> joints,
                                      const JointState& state,
                                      std::size_t joint) noexcept;

/// Computes `world` of one joint; that of its parent must be up to date.
/// Threads: any. Real-time: yes.
void update_world_of(std::span<const Joint> joints, JointState& state, std::size_t joint) noexcept;

/// The rotation in a matrix of rotation and scale above 0; the identity where a scale is 0.
/// Threads: any. Real-time: yes.
[[nodiscard]] glm::quat rotation_of(const glm::mat4& matrix) noexcept;

/// What a matrix of place, rotation and scale is made of; one that mirrors has its mirror in the
/// scale of x. Threads: any. Real-time: yes.
[[nodiscard]] NodePlace place_of(const glm::mat4& matrix) noexcept;

/// The largest of a matrix's three scales. Threads: any. Real-time: yes.
[[nodiscard]] float scale_of(const glm::mat4& matrix) noexcept;

/// The shortest turn that takes the direction `from` to `to`; both unit. Threads: any. Real-time:
/// yes.
[[nodiscard]] glm::quat shortest_turn(const glm::vec3& from, const glm::vec3& to) noexcept;

}  // namespace raks::render
