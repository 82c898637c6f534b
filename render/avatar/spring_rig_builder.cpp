// Builds SpringRig: which joints swing, in which order, and what hangs from each.
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "render/avatar/spring_rig.hpp"

namespace raks::render {

class SpringRigBuilder {
 public:
    SpringRigBuilder(const JointTree& tree,
                     const Character& character,
                     const JointState& rest,
                     std::vector<std::string>& warnings)
        : tree_(tree),
          character_(character),
          rest_(rest),
          warnings_(warnings),
          swing_of_(tree.joints.size(), -1) {}

    SpringRig build() {
        add_colliders();
        for (std::size_t chain = 0; chain < character_.springs.size(); ++chain) {
            add_chain(chain);
        }
        SpringRig rig;
        rig.colliders_ = colliders_;
        rig.colliders_of_ = colliders_of_;
        is_placed_.assign(found_.size(), false);
        is_path_placed_.assign(tree_.joints.size(), false);
        for (std::size_t i = 0; i < found_.size(); ++i) {
            place(i, rig);
        }
        add_behind(rig);
        return rig;
    }

 private:
    using SwingJoint = SpringRig::SwingJoint;

    void add_colliders() {
        std::size_t left_out = 0;
        for (const SpringCollider& collider : character_.colliders) {
            const int joint = tree_.joint_of(collider.node);
            collider_index_.push_back(joint < 0 ? -1 : static_cast<int>(colliders_.size()));
            if (joint < 0) {
                ++left_out;
                continue;
            }
            const auto j = static_cast<std::size_t>(joint);
            colliders_.push_back({.joint = j,
                                  .shape = collider.shape,
                                  .offset = collider.offset,
                                  .tail = collider.tail,
                                  .normal = collider.normal,
                                  .radius = collider.radius * scale_of(rest_.world[j])});
        }
        if (left_out > 0) {
            warnings_.push_back(
                fmt::format("colliders left out, whose nodes are not in the scene: {}", left_out));
        }
    }

    void leave_out(const SpringChain& chain, const SpringJoint& joint, const char* why) {
        warnings_.push_back(fmt::format(
            "node {} of the spring \"{}\" does not swing: {}", joint.node, chain.name, why));
    }

    void add_chain(std::size_t index) {
        const SpringChain& chain = character_.springs[index];
        const std::size_t first = colliders_of_.size();
        for (const int collider : chain.colliders) {
            const int kept = collider_index_[static_cast<std::size_t>(collider)];
            if (kept >= 0) {
                colliders_of_.push_back(static_cast<std::size_t>(kept));
            }
        }
        const std::size_t last = colliders_of_.size();
        const std::size_t count = chain.joints.size();
        const std::size_t swinging = chain.has_virtual_tail || count == 0 ? count : count - 1;
        for (std::size_t i = 0; i < swinging; ++i) {
            const int joint = tree_.joint_of(chain.joints[i].node);
            if (joint < 0) {
                leave_out(chain, chain.joints[i], "it is not in the scene");
                continue;
            }
            if (swing_of_[static_cast<std::size_t>(joint)] >= 0) {
                leave_out(chain, chain.joints[i], "it swings in another spring");
                continue;
            }
            const int next = i + 1 < count ? tree_.joint_of(chain.joints[i + 1].node) : -1;
            SwingJoint swing = swing_from(chain.joints[i], static_cast<std::size_t>(joint));
            swing.chain = index;
            swing.center = tree_.joint_of(chain.center);
            swing.first_collider = first;
            swing.last_collider = last;
            swing.tail = i + 1 < count ? tail_at(swing.joint, next) : virtual_tail(swing.joint);
            add(chain, chain.joints[i], swing);
        }
    }

    [[nodiscard]] SwingJoint swing_from(const SpringJoint& joint, std::size_t index) const {
        // The maker's figures are for the size of the file.
        const float step = kSpringStep * tree_.scale;
        SwingJoint swing;
        swing.joint = index;
        swing.rest = rest_.rotations[index];
        swing.pull = joint.stiffness * step;
        swing.gravity = joint.gravity_direction * joint.gravity_power * step;
        swing.kept = 1.0F - joint.drag;
        swing.hit_radius = joint.hit_radius * scale_of(rest_.world[index]);
        return swing;
    }

    // Place of a later joint in the space of `joint`, at rest.
    [[nodiscard]] glm::vec3 tail_at(std::size_t joint, int next) const {
        if (next < 0) {
            return glm::vec3(0.0F);
        }
        const auto n = static_cast<std::size_t>(next);
        if (tree_.joints[n].parent == static_cast<int>(joint)) {
            return rest_.translations[n];
        }
        return glm::vec3(glm::inverse(rest_.world[joint]) * rest_.world[n][3]);
    }

    // VRM 0.x gives the last joint a tail 7 cm further on in the direction that it came from.
    [[nodiscard]] glm::vec3 virtual_tail(std::size_t joint) const {
        constexpr float kVirtualTail = 0.07F;
        const glm::vec3& from = tree_.joints[joint].translation;
        const float length = glm::length(from);
        return length > 0.0F ? from * (kVirtualTail / length) : glm::vec3(0.0F);
    }

    void add(const SpringChain& chain, const SpringJoint& joint, SwingJoint swing) {
        const float length = glm::length(swing.tail);
        const glm::mat4& world = rest_.world[swing.joint];
        swing.length = glm::length(glm::vec3(world * glm::vec4(swing.tail, 0.0F)));
        if (!(length > 0.0F) || !(swing.length > 0.0F)) {
            leave_out(chain, joint, "it has no length");
            return;
        }
        swing.axis = swing.tail / length;
        swing_of_[swing.joint] = static_cast<int>(found_.size());
        found_.push_back(swing);
    }

    // Puts a swing behind all that it depends on: swings above it, above its center and above its
    // colliders. Where these wait for each other the order of the file is kept.
    void place(std::size_t i, SpringRig& rig) {
        if (is_placed_[i]) {
            return;
        }
        is_placed_[i] = true;
        const SwingJoint& swing = found_[i];
        place_path(tree_.joints[swing.joint].parent, rig);
        // Files that mean harm could wait too deep for the stack.
        constexpr int kDeepest = 500;
        if (++depth_ < kDeepest) {
            place_path(swing.center, rig);
            for (std::size_t c = swing.first_collider; c < swing.last_collider; ++c) {
                place_path(static_cast<int>(colliders_[colliders_of_[c]].joint), rig);
            }
        }
        --depth_;
        rig.swings_.push_back(swing);
    }

    // Places all swings from the root to a joint, those nearer to the root first.
    void place_path(int joint, SpringRig& rig) {
        std::vector<std::size_t> path;
        for (int above = joint; above >= 0 && !is_path_placed_[static_cast<std::size_t>(above)];
             above = tree_.joints[static_cast<std::size_t>(above)].parent) {
            path.push_back(static_cast<std::size_t>(above));
        }
        for (auto j = path.rbegin(); j != path.rend(); ++j) {
            is_path_placed_[*j] = true;
            if (swing_of_[*j] >= 0) {
                place(static_cast<std::size_t>(swing_of_[*j]), rig);
            }
        }
    }

    // Joints between a swing and the next ones, which move with it.
    void add_behind(SpringRig& rig) {
        std::vector<int> swing_above(tree_.joints.size(), -1);  // the joint of the nearest swing
        std::vector<std::vector<std::size_t>> behind(tree_.joints.size());
        for (std::size_t j = 0; j < tree_.joints.size(); ++j) {
            const int parent = tree_.joints[j].parent;
            if (swing_of_[j] >= 0) {
                swing_above[j] = static_cast<int>(j);
            } else if (parent >= 0 && swing_above[static_cast<std::size_t>(parent)] >= 0) {
                swing_above[j] = swing_above[static_cast<std::size_t>(parent)];
                behind[static_cast<std::size_t>(swing_above[j])].push_back(j);
            }
        }
        for (SwingJoint& swing : rig.swings_) {
            const std::vector<std::size_t>& joints = behind[swing.joint];
            swing.first_behind = rig.behind_.size();
            rig.behind_.insert(rig.behind_.end(), joints.begin(), joints.end());
            swing.last_behind = rig.behind_.size();
        }
    }

    const JointTree& tree_;
    const Character& character_;
    const JointState& rest_;
    std::vector<std::string>& warnings_;
    std::vector<int> swing_of_;         // in found_, by joint; -1: none
    std::vector<SwingJoint> found_;     // in the order of the file
    std::vector<bool> is_placed_;       // by found_
    std::vector<bool> is_path_placed_;  // by joint: all swings from the root to it
    int depth_ = 0;
    std::vector<int> collider_index_;  // in colliders_, by collider of the file
    std::vector<JointCollider> colliders_;
    std::vector<std::size_t> colliders_of_;
};

SpringRig SpringRig::build(const JointTree& tree,
                           const Character& character,
                           const JointState& rest,
                           std::vector<std::string>& warnings) {
    return SpringRigBuilder(tree, character, rest, warnings).build();
}

}  // namespace raks::render
