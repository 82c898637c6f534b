// Palm: where a hand touches.
#pragma once

#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Middle of the palm: between the wrist and the middle finger's first joint. Threads: any.
/// Real-time: yes.
[[nodiscard]] inline glm::vec3 palm_of(const WorldPose& world, Side side) noexcept {
    return 0.5F * (world.position(on_side(Bone::left_hand, side)) +
                   world.position(on_side(Bone::left_middle_proximal, side)));
}

}  // namespace raks::motion
