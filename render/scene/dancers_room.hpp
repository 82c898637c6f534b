#pragma once

#include <array>
#include <span>
#include <tuple>

#include "motion/skeleton/skeleton.hpp"
#include "render/scene/follow_spring.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// A box along the axes of the world; metres.
struct StageBox {
    glm::vec3 low{};   ///< its corner of the smallest coordinates
    glm::vec3 high{};  ///< and of the largest
};

/// Corners of what surrounds the dancers closer than a box does, seen from above: (x, z), metres.
using StageOutline = std::array<glm::vec2, 16>;

/// The corners of a box's floor, so that those of two outlines at the same place belong together.
[[nodiscard]] StageOutline outline_of(const StageBox& box) noexcept;

/// The room that the dancers take, all together; a camera that shows it shows them.
struct DancersRoom {
    StageOutline outline{};  ///< of the bodies, with the arms
    StageBox body;           ///< from the floor to the heads and raised hands, with the arms spread
    StageBox feet;           ///< on the floor, where they step; its height means nothing
    float hips = 0.0F;       ///< height of the lowest hips, metres
    float head = 0.0F;       ///< height of the top of the highest head, metres
    float hand = 0.0F;       ///< height of the lowest fingertips, metres
    /// Head and neck of the first dancer, of the second (with one: the first), and of both.
    std::array<StageBox, 3> faces{};
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
        void grow(float to, float outward, float shrink_seconds) noexcept;
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
    Edge hand_;
    std::array<Edge, std::tuple_size_v<StageOutline>> girth_;
    Edge face_low_[3][3];  // by face and axis
    Edge face_high_[3][3];
    bool has_begun_ = false;
};

}  // namespace raks::render
