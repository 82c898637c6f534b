#include "render/avatar/spring_rig.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/model/finite.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::render {
namespace {

// Faster than any tail of a dancer (hair half a metre long, three turns a second): what is faster
// comes from a leap of the pose, and would throw hair through the body.
constexpr float kMostMotion = 10.0F * kSpringStep;  // metres a step

glm::vec3 moved_by(const glm::mat4& matrix, const glm::vec3& point) noexcept {
    return glm::vec3(matrix * glm::vec4(point, 1.0F));
}

// To the swing's length from the origin; `otherwise` where there is no direction.
glm::vec3 at_length(const glm::vec3& origin,
                    const glm::vec3& place,
                    float length,
                    const glm::vec3& otherwise) noexcept {
    const glm::vec3 from = place - origin;
    const float distance = glm::length(from);
    return distance > 0.0F ? origin + from * (length / distance) : otherwise;
}

glm::vec3 limited(const glm::vec3& motion) noexcept {
    const float distance = glm::length(motion);
    return distance > kMostMotion ? motion * (kMostMotion / distance) : motion;
}

}  // namespace

SpringTails SpringRig::make_tails() const {
    return {.previous = std::vector<glm::vec3>(swings_.size()),
            .current = std::vector<glm::vec3>(swings_.size())};
}

SpringRig::Hold SpringRig::hold_of(const SwingJoint& swing,
                                   std::span<const Joint> joints,
                                   const JointState& state) noexcept {
    const int parent = joints[swing.joint].parent;
    const glm::vec3& translation = state.translations[swing.joint];
    if (parent < 0) {
        return {.origin = translation, .rest = swing.rest};
    }
    const glm::mat4& above = state.world[static_cast<std::size_t>(parent)];
    return {.origin = moved_by(above, translation), .rest = rotation_of(above) * swing.rest};
}

void SpringRig::turn(const SwingJoint& swing,
                     const glm::quat& rotation,
                     std::span<const Joint> joints,
                     JointState& state) const noexcept {
    state.rotations[swing.joint] = rotation;
    update_world_of(joints, state, swing.joint);
    for (std::size_t i = swing.first_behind; i < swing.last_behind; ++i) {
        update_world_of(joints, state, behind_[i]);
    }
}

void SpringRig::rest(std::span<const Joint> joints,
                     JointState& state,
                     SpringTails& tails) const noexcept {
    for (std::size_t i = 0; i < swings_.size(); ++i) {
        const SwingJoint& swing = swings_[i];
        turn(swing, swing.rest, joints, state);
        glm::vec3 tail = moved_by(state.world[swing.joint], swing.tail);
        if (swing.center >= 0) {
            tail =
                moved_by(glm::inverse(state.world[static_cast<std::size_t>(swing.center)]), tail);
        }
        tails.previous[i] = tail;
        tails.current[i] = tail;
    }
}

glm::vec3 SpringRig::swung(const SwingJoint& swing,
                           const Hold& hold,
                           const glm::vec3& previous,
                           const glm::vec3& current,
                           const JointState& state) const noexcept {
    const glm::vec3 rest_direction = hold.rest * swing.axis;
    const glm::vec3 rest_place = hold.origin + rest_direction * swing.length;
    glm::vec3 next = current + limited((current - previous) * swing.kept) +
                     rest_direction * swing.pull + swing.gravity;
    next = at_length(hold.origin, next, swing.length, rest_place);
    for (std::size_t i = swing.first_collider; i < swing.last_collider; ++i) {
        const JointCollider& collider = colliders_[colliders_of_[i]];
        const Push push = push_of(collider, state.world[collider.joint], next, swing.hit_radius);
        if (push.distance < 0.0F) {
            next -= push.direction * push.distance;
            next = at_length(hold.origin, next, swing.length, rest_place);
        }
    }
    return next;
}

void SpringRig::step(std::span<const Joint> joints,
                     JointState& state,
                     SpringTails& tails) const noexcept {
    std::size_t broken_chain = std::numeric_limits<std::size_t>::max();
    for (std::size_t i = 0; i < swings_.size(); ++i) {
        const SwingJoint& swing = swings_[i];
        const Hold hold = hold_of(swing, joints, state);
        glm::mat4 world_from_center(1.0F);
        glm::vec3 current = tails.current[i];
        glm::vec3 previous = tails.previous[i];
        if (swing.center >= 0) {
            world_from_center = state.world[static_cast<std::size_t>(swing.center)];
            current = moved_by(world_from_center, current);
            previous = moved_by(world_from_center, previous);
        }
        glm::vec3 next = swung(swing, hold, previous, current, state);
        if (!is_finite(next) || swing.chain == broken_chain) {
            broken_chain = swing.chain;
            next = hold.origin + hold.rest * swing.axis * swing.length;
            current = next;
        }
        const glm::vec3 towards = glm::normalize(glm::inverse(hold.rest) * (next - hold.origin));
        turn(swing, glm::normalize(swing.rest * shortest_turn(swing.axis, towards)), joints, state);
        if (swing.center >= 0) {
            const glm::mat4 center_from_world = glm::inverse(world_from_center);
            current = moved_by(center_from_world, current);
            next = moved_by(center_from_world, next);
        }
        tails.previous[i] = current;
        tails.current[i] = next;
    }
}

glm::vec3 SpringRig::tail_place(std::size_t i, const JointState& state) const noexcept {
    return moved_by(state.world[swings_[i].joint], swings_[i].tail);
}

float SpringRig::depth(std::size_t i, const JointState& state) const noexcept {
    const SwingJoint& swing = swings_[i];
    float deepest = 0.0F;
    for (std::size_t c = swing.first_collider; c < swing.last_collider; ++c) {
        const JointCollider& collider = colliders_[colliders_of_[c]];
        const Push push =
            push_of(collider, state.world[collider.joint], tail_place(i, state), swing.hit_radius);
        deepest = std::max(deepest, -push.distance);
    }
    return deepest;
}

}  // namespace raks::render
