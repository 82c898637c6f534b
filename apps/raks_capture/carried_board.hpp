// Carried board: the way on which a board is shown to the cameras of the test studio.
#pragma once

#include <cstdint>
#include <vector>

#include "motion/capture/calibration/board.hpp"
#include "motion/capture/calibration/board_pose.hpp"
#include "motion/capture/camera/rig.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::apps {

/// A board as somebody carries it about who does what the dancers' manual says: near each camera,
/// tilted to all sides; then to each two neighbours of the ring at once, in many places of the
/// space where the dance will be; held still for 0.8 s, carried on within 0.2 s. In the end it lies
/// on the floor for four seconds, printed side up: its middle is the world's origin, its rows run
/// along x. Pure; the same input gives the same way. Threads: any.
class CarriedBoard {
 public:
    /// `rig`: two cameras or more around the place of the dance; `board` passed check_board.
    CarriedBoard(const capture::Rig& rig, const capture::Board& board, std::uint64_t seed);

    /// How long it takes, from capture time 0 on; seconds.
    [[nodiscard]] double seconds() const noexcept;
    /// The middle of the time for which it lies on the floor; capture time, seconds.
    [[nodiscard]] double floor_time() const noexcept;
    /// World from board at a capture time; held before the first moment and behind the last.
    [[nodiscard]] capture::RigidMotion place_at(double time) const;

 private:
    struct Hold {
        glm::dquat rotation;  // world from board
        glm::dvec3 middle;    // of the board; metres
    };

    glm::dvec2 half_;  // of the board's size; metres
    std::vector<Hold> holds_;
};

}  // namespace raks::apps
