#pragma once

#include <span>

#include "motion/skeleton/skeleton.hpp"
#include "render/scene/follow_spring.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// A box along the axes of the world; metres.
struct StageBox {
    glm::vec3 low{};   ///< its corner of the smallest coordinates
    glm::vec3 high{};  ///< and of the largest
};

/// The room that the dancers take, all together; a camera that shows it shows them.
struct DancersRoom {
    StageBox body;      ///< from the floor to the heads and raised hands, with the arms spread
    StageBox feet;      ///< on the floor, where they step; its height means nothing
    float hips = 0.0F;  ///< height of the lowest hips, metres
    float head = 0.0F;  ///< height of the top of the highest head, metres
};

/// Finds that room from the poses of each hop. It grows as soon as a dancer leaves it, a little
/// ahead of who travels, and shrinks within seconds: who dances on the spot leaves a camera still,
/// who travels takes it along. The ways of its edges have no kinks.
/// Threads: one. Real-time: yes.
class DancersRoomKeeper {
 public:
    /// The room at the next hop. `dancers`: in world space, at least one; of a body that stands as
    /// high as the mannequin.
    const DancersRoom& advance(std::span<const motion::WorldPose> dancers) noexcept;
    /// The room at the last hop.
    [[nodiscard]] const DancersRoom& room() const noexcept { return room_; }
    /// The next hop is the first: the room is what its poses take.
    void reset() noexcept { has_begun_ = false; }

 private:
    // One edge: the farthest place of the last seconds, and a spring that follows it.
    struct Edge {
        float held = 0.0F;
        FollowSpring spring;
        void begin(float at) noexcept;
        void grow(float to, float outward) noexcept;
    };

    DancersRoom room_;
    glm::vec3 middle_{};  // of the hips, at the last hop
    glm::vec3 speed_{};   // of that middle, smoothed
    Edge body_low_[3];
    Edge body_high_[3];
    Edge feet_low_[2];  // x and z
    Edge feet_high_[2];
    Edge hips_;
    Edge head_;
    bool has_begun_ = false;
};

}  // namespace raks::render
