#include "render/avatar/node_constraints.hpp"

#include <array>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace raks::render {
namespace {

glm::vec3 direction_of(NodeAxis axis) noexcept {
    static constexpr std::array<glm::vec3, 6> kDirections = {
        glm::vec3{1.0F, 0.0F, 0.0F},
        glm::vec3{0.0F, 1.0F, 0.0F},
        glm::vec3{0.0F, 0.0F, 1.0F},
        glm::vec3{-1.0F, 0.0F, 0.0F},
        glm::vec3{0.0F, -1.0F, 0.0F},
        glm::vec3{0.0F, 0.0F, -1.0F},
    };
    return kDirections[static_cast<std::size_t>(axis)];
}

// Finds an order by depth-first search.
class Ordering {
 public:
    Ordering(const JointTree& tree,
             const std::vector<NodeConstraint>& constraints,
             std::vector<std::string>& warnings)
        : tree_(tree),
          constraints_(constraints),
          warnings_(warnings),
          constraint_of_(tree.joints.size(), -1),
          marks_(constraints.size(), Mark::fresh) {}

    // Indices of the constraints that can be kept, in the order in which they are to be done.
    std::vector<std::size_t> find() {
        for (std::size_t i = 0; i < constraints_.size(); ++i) {
            register_constraint(i);
        }
        for (std::size_t i = 0; i < constraints_.size(); ++i) {
            static_cast<void>(visit(i));
        }
        return order_;
    }

 private:
    enum class Mark : std::uint8_t { fresh, open, done, left_out };

    void register_constraint(std::size_t i) {
        const int joint = tree_.joint_of(constraints_[i].node);
        if (joint < 0 || tree_.joint_of(constraints_[i].source) < 0) {
            leave_out(i, "its node or its source is not in the scene");
        } else if (constraint_of_[static_cast<std::size_t>(joint)] >= 0) {
            leave_out(i, "the node has another one");
        } else {
            constraint_of_[static_cast<std::size_t>(joint)] = static_cast<int>(i);
        }
    }

    void leave_out(std::size_t i, const char* why) {
        marks_[i] = Mark::left_out;
        warnings_.push_back(
            fmt::format("the constraint of node {} is left out: {}", constraints_[i].node, why));
    }

    // False where it lies on a circle that is still open.
    bool visit(std::size_t i) {
        if (marks_[i] != Mark::fresh) {
            return marks_[i] != Mark::open;
        }
        // Files that mean harm could wait too deep for the stack.
        constexpr int kDeepest = 500;
        if (depth_ >= kDeepest) {
            leave_out(i, "too many wait for each other");
            return true;
        }
        ++depth_;
        marks_[i] = Mark::open;
        const auto source = static_cast<std::size_t>(tree_.joint_of(constraints_[i].source));
        const auto own = static_cast<std::size_t>(tree_.joint_of(constraints_[i].node));
        bool is_free = false;
        if (constraints_[i].kind == ConstraintKind::aim) {
            // It sees places, which all joints above have a part in.
            is_free = visit_path(static_cast<int>(source)) && visit_path(tree_.joints[own].parent);
        } else {
            is_free = visit_joint(source);
        }
        --depth_;
        if (is_free) {
            marks_[i] = Mark::done;
            order_.push_back(i);
        } else {
            leave_out(i, "it waits for itself in a circle");
        }
        return true;
    }

    bool visit_joint(std::size_t joint) {
        return constraint_of_[joint] < 0 || visit(static_cast<std::size_t>(constraint_of_[joint]));
    }

    bool visit_path(int joint) {
        for (int above = joint; above >= 0;) {
            const auto i = static_cast<std::size_t>(above);
            if (!visit_joint(i)) {
                return false;
            }
            above = tree_.joints[i].parent;
        }
        return true;
    }

    const JointTree& tree_;
    const std::vector<NodeConstraint>& constraints_;
    std::vector<std::string>& warnings_;
    std::vector<int> constraint_of_;  // by joint; -1: none
    std::vector<Mark> marks_;
    std::vector<std::size_t> order_;
    int depth_ = 0;
};

}  // namespace

NodeConstraints NodeConstraints::build(const JointTree& tree,
                                       const std::vector<NodeConstraint>& constraints,
                                       const JointState& rest,
                                       std::vector<std::string>& warnings) {
    NodeConstraints built;
    for (const std::size_t i : Ordering(tree, constraints, warnings).find()) {
        const auto joint = static_cast<std::size_t>(tree.joint_of(constraints[i].node));
        const auto source = static_cast<std::size_t>(tree.joint_of(constraints[i].source));
        built.constraints_.push_back({.kind = constraints[i].kind,
                                      .joint = joint,
                                      .source = source,
                                      .axis = direction_of(constraints[i].axis),
                                      .weight = constraints[i].weight,
                                      .rest = rest.rotations[joint],
                                      .source_rest = rest.rotations[source]});
    }
    return built;
}

glm::quat NodeConstraints::roll_target(const Constraint& constraint,
                                       const glm::quat& source) noexcept {
    // What the source turned by, seen in the constrained joint's own axes at rest.
    const glm::quat turn = glm::inverse(constraint.rest) * source *
                           glm::inverse(constraint.source_rest) * constraint.rest;
    const glm::quat swing = shortest_turn(constraint.axis, glm::normalize(turn * constraint.axis));
    return constraint.rest * glm::inverse(swing) * turn;
}

glm::quat NodeConstraints::aim_target(const Constraint& constraint,
                                      const std::vector<Joint>& joints,
                                      const JointState& state) noexcept {
    const int parent = joints[constraint.joint].parent;
    glm::quat above{1.0F, 0.0F, 0.0F, 0.0F};
    if (parent >= 0) {
        above = rotation_of(compute_world(joints, state, static_cast<std::size_t>(parent)));
    }
    const glm::vec3 towards = glm::vec3(compute_world(joints, state, constraint.source)[3]) -
                              glm::vec3(compute_world(joints, state, constraint.joint)[3]);
    const float distance = glm::length(towards);
    if (!(distance > 0.0F)) {
        return constraint.rest;
    }
    const glm::vec3 from = above * (constraint.rest * constraint.axis);
    return glm::inverse(above) * shortest_turn(glm::normalize(from), towards / distance) * above *
           constraint.rest;
}

glm::quat NodeConstraints::target(const Constraint& constraint,
                                  const std::vector<Joint>& joints,
                                  const JointState& state) noexcept {
    const glm::quat& source = state.rotations[constraint.source];
    switch (constraint.kind) {
        case ConstraintKind::rotation:
            return constraint.rest * glm::inverse(constraint.source_rest) * source;
        case ConstraintKind::roll:
            return roll_target(constraint, source);
        case ConstraintKind::aim:
            break;
    }
    return aim_target(constraint, joints, state);
}

void NodeConstraints::apply(const std::vector<Joint>& joints, JointState& state) const noexcept {
    for (const Constraint& constraint : constraints_) {
        const glm::quat aim = target(constraint, joints, state);
        state.rotations[constraint.joint] =
            glm::normalize(glm::slerp(constraint.rest, aim, constraint.weight));
    }
}

}  // namespace raks::render
