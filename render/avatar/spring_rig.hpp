// What swings on a figure: hair, skirts, ears (VRMC_springBone 1.0, VRM 0.x secondaryAnimation).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/avatar/joint_tree.hpp"
#include "render/avatar/spring_collider.hpp"
#include "render/model/character.hpp"

namespace raks::render {

/// Seconds of a step. The algorithm's inertia knows no time, so other steps would swing otherwise.
inline constexpr float kSpringStep = 1.0F / 60.0F;

/// Where the tails are: all that swinging remembers. Arrays by swinging joint.
struct SpringTails {
    std::vector<glm::vec3> previous;  ///< one step ago; in the space of the chain's center
    std::vector<glm::vec3> current;
};

/// The swinging joints of a model, those nearer to the root first. Immutable once built.
///
/// A joint's tail keeps its distance from it; each step moves it by inertia less drag, by a pull to
/// the rest direction and by gravity, then out of the colliders; the joint turns to where its tail
/// is ("SpringBone Algorithm" of the specification). Gravity is the world's, after a model that
/// faced -z was turned.
class SpringRig {
 public:
    SpringRig() = default;

    /// `rest`: the joints at rest. Left out, each with a line in `warnings`: joints that are not
    /// shown, that swing in another chain already, that have no length; colliders that are not
    /// shown.
    [[nodiscard]] static SpringRig build(const JointTree& tree,
                                         const Character& character,
                                         const JointState& rest,
                                         std::vector<std::string>& warnings);

    [[nodiscard]] std::size_t size() const noexcept { return swings_.size(); }

    /// Tails for this rig; `rest` must be called before the first step.
    [[nodiscard]] SpringTails make_tails() const;

    /// Puts all tails to where they rest on the posed joints, without motion. `world` must be up to
    /// date; afterwards it is as the joints rest. Threads: any. Real-time: yes.
    void rest(std::span<const Joint> joints, JointState& state, SpringTails& tails) const noexcept;

    /// One step of 1/60 s. In: joints as posed, `world` up to date. Out: rotations of the swinging
    /// joints, and `world` of them and all behind them. Threads: any. Real-time: yes.
    void step(std::span<const Joint> joints, JointState& state, SpringTails& tails) const noexcept;

    /// Joint of the tree that swing `i` turns.
    [[nodiscard]] std::size_t joint(std::size_t i) const noexcept { return swings_[i].joint; }
    /// Local rotation of that joint at rest.
    [[nodiscard]] const glm::quat& rest_rotation(std::size_t i) const noexcept {
        return swings_[i].rest;
    }
    /// Place of the tail of swing `i`, by `world` of its joint.
    [[nodiscard]] glm::vec3 tail_place(std::size_t i, const JointState& state) const noexcept;
    /// By how much the tail of swing `i` is inside its colliders, by `world`; metres, 0: outside.
    [[nodiscard]] float depth(std::size_t i, const JointState& state) const noexcept;
    /// Length of swing `i`; metres of the world.
    [[nodiscard]] float length(std::size_t i) const noexcept { return swings_[i].length; }

 private:
    friend class SpringRigBuilder;

    struct SwingJoint {
        std::size_t joint = 0;
        glm::quat rest{1.0F, 0.0F, 0.0F, 0.0F};  // local
        glm::vec3 tail{0.0F};                    // in the joint's space
        glm::vec3 axis{0.0F, 1.0F, 0.0F};        // its direction
        float length = 0.0F;
        float pull = 0.0F;        // metres a step
        glm::vec3 gravity{0.0F};  // metres a step
        float kept = 0.5F;        // part of the motion that drag leaves
        float hit_radius = 0.0F;
        int center = -1;  // joint
        std::size_t chain = 0;
        // Ranges of colliders_of_ and behind_.
        std::size_t first_collider = 0;
        std::size_t last_collider = 0;
        std::size_t first_behind = 0;
        std::size_t last_behind = 0;
    };
    // Where a swing hangs in this step.
    struct Hold {
        glm::vec3 origin{0.0F};
        glm::quat rest{1.0F, 0.0F, 0.0F, 0.0F};  // world rotation of the joint at rest
    };

    static Hold hold_of(const SwingJoint& swing,
                        std::span<const Joint> joints,
                        const JointState& state) noexcept;
    [[nodiscard]] glm::vec3 swung(const SwingJoint& swing,
                                  const Hold& hold,
                                  const glm::vec3& previous,
                                  const glm::vec3& current,
                                  const JointState& state) const noexcept;
    void turn(const SwingJoint& swing,
              const glm::quat& rotation,
              std::span<const Joint> joints,
              JointState& state) const noexcept;

    std::vector<SwingJoint> swings_;
    std::vector<JointCollider> colliders_;
    std::vector<std::size_t> colliders_of_;  // indices of colliders_, by swing
    std::vector<std::size_t> behind_;        // joints that hang from a swing and no nearer one
};

}  // namespace raks::render
