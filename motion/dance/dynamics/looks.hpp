// Looks: where a dancer's head turns to.
#pragma once

#include <array>
#include <cstdint>

#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

/// What a dancer is about, for where it looks.
enum class LookFor : std::uint8_t {
    dance,  ///< often as the figures have the head, else at the audience, a hand, or the way
    pose,   ///< stands still for the audience
    wait,   ///< looks around
};

/// Turns neck and head towards what the dancer looks at: the audience (+z), the hand that works
/// (raised, and quicker than the other), where it travels, a side, or nothing in particular; what
/// is behind the shoulders is not looked at. What it looks at changes every few seconds, by the
/// seed; the head follows through a low-pass filter of the second order (0.13 s). A head that
/// hangs for longer than a third of a second is lifted, so that nobody looks at the feet.
///
/// Call advance() once for each hop, in order; to look ahead, go on with a copy. Threads: one.
/// Real-time: yes.
class Looks {
 public:
    /// One hop on. `shown`: the pose of the hop before, in which hands and ways are seen.
    void advance(const Skeleton& skeleton,
                 StreamTime time,
                 std::uint64_t seed,
                 LookFor what,
                 const Pose& shown) noexcept RAKS_NONBLOCKING;
    /// One hop on without anything new to be seen.
    void go_on() noexcept RAKS_NONBLOCKING;
    /// Turns neck and head of a pose, and lifts the head.
    void apply(const Skeleton& skeleton, Pose& pose) const noexcept RAKS_NONBLOCKING;
    /// Lifts the head alone: of one who looks at a partner.
    void lift_head(const Skeleton& skeleton, Pose& pose) const noexcept RAKS_NONBLOCKING;

 private:
    /// What the head is drawn to, and how far it goes there.
    struct Aim {
        glm::vec3 towards{0.0F, 0.0F, 1.0F};  ///< in the world
        float turn = 0.0F;                    ///< share of the way about the upright axis
        float tilt = 0.0F;                    ///< share of the way up or down
    };
    /// What is seen of the dancer's own movement.
    struct Sights {
        glm::vec3 hips{};                  ///< place at the last hop; metres
        glm::vec3 travel{};                ///< speed over the floor, of late; m/s
        std::array<glm::vec3, 2> hands{};  ///< by Side: seen from the head; metres
        std::array<float, 2> quickness{};  ///< by Side: of the hand, of late; m/s
        std::array<float, 2> raised{};     ///< by Side: over the shoulders, of late; metres
        bool is_known = false;             ///< hips and hands are
    };
    void see(const Skeleton& skeleton, const Pose& shown) noexcept;
    [[nodiscard]] Aim aim_at(std::uint64_t cell, std::uint64_t seed, LookFor what) const noexcept;

    void see_feet(const WorldPose& world) noexcept;

    Sights sights_;
    Aim target_;
    std::array<Aim, 2> stages_{};   // of the filter
    float seconds_down_ = 0.0F;     // for which the head has hung, without what lifts it
    float wanted_lift_ = 0.0F;      // radians
    std::array<float, 2> lifts_{};  // stages of the filter
};

}  // namespace raks::motion
