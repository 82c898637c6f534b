// Pose join: goes over from one piece of dance to another.
#pragma once

#include <array>
#include <optional>

#include "base/realtime.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// How far a foot has moved from one piece to the next, and how high it is lifted on the way.
struct FootShare {
    float share = 0.0F;
    float lift = 0.0F;  ///< metres
    /// Place to start from; none: the last piece's
    std::optional<FootPlace> held;
    bool is_planted = false;  ///< there as a whole; else only over the floor
};

/// Interpolates two poses, with the feet by their places in the world: rotations averaged down a
/// leg would move a foot that both pieces have planted. `feet`: by Side. Threads: any. Real-time:
/// yes.
[[nodiscard]] Pose joined_poses(const Skeleton& skeleton,
                                const Pose& from,
                                const Pose& to,
                                float share,
                                const std::array<FootShare, 2>& feet) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
