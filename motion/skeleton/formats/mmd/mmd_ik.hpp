// MMD IK: the inverse kinematics of MikuMikuDance, step by step as it does it.
#pragma once

#include <optional>
#include <span>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {

/// A joint that the solver turns, in our axes.
struct MmdIkLink {
    glm::dquat keyed{1.0, 0.0, 0.0, 0.0};  ///< its turn before the solver, in its parent's frame
    glm::dvec3 to_next{};                  ///< to the next joint, in its own frame
    bool is_knee = false;  ///< it bends backward about its x alone: 0.5 to 180 degrees
    /// Result, a turn in the parent's frame that follows the keyed one: `solved * keyed`.
    glm::dquat solved{1.0, 0.0, 0.0, 0.0};

    /// The turn with the solver's.
    [[nodiscard]] glm::dquat turn() const { return solved * keyed; }
};

/// What the solver shall reach, and how.
struct MmdIkGoal {
    glm::dvec3 place{};         ///< of the end, in the world, metres
    int rounds = 40;            ///< over all links
    double largest_step = 2.0;  ///< radians of the link next to the end; twice that of the second
};

/// Turns `links`, from the body outwards, until the end behind the last lies at the goal: cyclic
/// coordinate descent from the link next to the end inwards. In the first half of the rounds a knee
/// turns about x alone, and an angle beyond its limit is mirrored there; later it stops at the
/// limit. Keyed turns that reach the goal already stay as they are, knees beyond their limit, too.
/// `parent`: turn of the joint that carries the first link; `start`: place of the first link.
/// This is what the public readers of the format agree on (saba's and babylon-mmd's solvers): two
/// bones alone would put the same ankle on another knee. Threads: any. Real-time: no.
void solve_mmd_ik(const glm::dquat& parent,
                  const glm::dvec3& start,
                  const MmdIkGoal& goal,
                  std::span<MmdIkLink> links);

}  // namespace raks::motion
