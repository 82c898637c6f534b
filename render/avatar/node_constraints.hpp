// Joints that take a part of another joint's rotation (VRMC_node_constraint 1.0).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "render/avatar/joint_tree.hpp"
#include "render/model/character.hpp"

namespace raks::render {

/// All constraints of a model, in an order in which each finds its source done. Immutable once
/// built.
class NodeConstraints {
 public:
    NodeConstraints() = default;

    /// `rest`: the joints at rest. Constraints that wait for each other in a circle, whose node or
    /// source is not shown, and a second one of a node are left out; each is a line in `warnings`.
    [[nodiscard]] static NodeConstraints build(const JointTree& tree,
                                               const std::vector<NodeConstraint>& constraints,
                                               const JointState& rest,
                                               std::vector<std::string>& warnings);

    /// Writes the rotations of all constrained joints; `world` is neither read nor computed.
    /// Threads: any. Real-time: yes.
    void apply(const std::vector<Joint>& joints, JointState& state) const noexcept;

    [[nodiscard]] std::size_t size() const noexcept { return constraints_.size(); }

 private:
    struct Constraint {
        ConstraintKind kind = ConstraintKind::rotation;
        std::size_t joint = 0;
        std::size_t source = 0;
        glm::vec3 axis{1.0F, 0.0F, 0.0F};
        float weight = 1.0F;
        glm::quat rest{1.0F, 0.0F, 0.0F, 0.0F};
        glm::quat source_rest{1.0F, 0.0F, 0.0F, 0.0F};
    };

    static glm::quat target(const Constraint& constraint,
                            const std::vector<Joint>& joints,
                            const JointState& state) noexcept;
    static glm::quat roll_target(const Constraint& constraint, const glm::quat& source) noexcept;
    static glm::quat aim_target(const Constraint& constraint,
                                const std::vector<Joint>& joints,
                                const JointState& state) noexcept;

    std::vector<Constraint> constraints_;
};

}  // namespace raks::render
