// Planted feet: feet stay where they stand while what moves them changes.
#pragma once

#include <array>
#include <cstdint>

#include "base/realtime.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec2.hpp>

namespace raks::motion {

/// Joins motions whose feet stand apart without a sliding foot. A foot that stands as the motion
/// changes keeps its place, however far from where the new motion wants it. What it lags is made up
/// while that motion swings the foot; where it leaves the foot standing, the foot takes a step of
/// its own, unless the dancer holds still. The hips stay between the feet.
///
/// It keeps the lag of one hop; call apply() once for each hop, in order. To look ahead, go on with
/// a copy. Threads: one. Real-time: yes.
class PlantedFeet {
 public:
    /// Forgets all lags.
    void reset() noexcept { *this = PlantedFeet(); }

    /// Another motion begins: the feet stay where `shown` has them. `next`: the new motion at the
    /// same hop; the other two are of the hop before.
    void carry_over(const Skeleton& skeleton,
                    const Pose& shown,
                    const Pose& shown_before,
                    const Pose& next,
                    const Pose& next_before) noexcept RAKS_NONBLOCKING;

    /// Whether a foot that stands may begin a step of its own.
    enum class OwnSteps : std::uint8_t { may_begin, wait };

    /// One hop on: the pose wanted, with its feet where they are by now.
    [[nodiscard]] Pose apply(const Skeleton& skeleton,
                             const Pose& wanted,
                             OwnSteps steps = OwnSteps::may_begin) noexcept RAKS_NONBLOCKING;

    /// The pose wanted with the feet as far from their places as at the last hop. Nothing changes.
    [[nodiscard]] Pose with_lag(const Skeleton& skeleton,
                                const Pose& wanted) const noexcept RAKS_NONBLOCKING;

 private:
    /// One foot: where it is, less where the motion wants it.
    struct Foot {
        glm::vec2 away{};   // of the point about which it turns, over the floor; metres
        glm::vec2 drift{};  // speed that is left of the motion before; metres a second
        float yaw = 0.0F;   // radians
        float height = 0.0F;
        glm::vec3 tilt{};       // what else it is turned by; a rotation vector
        glm::vec2 place{};      // wanted at the last hop
        bool is_known = false;  // `place` is
        int stood = 0;          // hops that the motion has left it standing
        int stepped = 0;        // hops of its own step; 0: it takes none
        glm::vec2 from{};       // `away` as that step began
        float from_yaw = 0.0F;
    };
    [[nodiscard]] bool has_lag() const noexcept;
    void advance(Foot& foot,
                 const Foot& other,
                 const glm::vec2& place,
                 bool stands,
                 OwnSteps steps) const noexcept;

    std::array<Foot, 2> feet_{};
};

}  // namespace raks::motion
