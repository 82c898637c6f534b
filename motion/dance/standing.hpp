// Standing: standing still, and settling from a dance.
#pragma once

#include <array>
#include <cstddef>

#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/dance/body/floor_move.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

// Idle: standing while there is no music.

/// Standing while there is nothing to dance to: relaxed arms, slow shifts of the weight, breathing;
/// both feet planted. A function of time alone, never quite the same and never frozen.
/// Threads: any. Real-time: yes.
[[nodiscard]] Pose idle_pose(const Skeleton& skeleton, StreamTime time) noexcept RAKS_NONBLOCKING;

/// Standing while there is nothing to dance to, and how a dancer comes to stand: the body moves and
/// turns from where the dance ended to where it shall stand, while the feet step there one after
/// the other; none slides. Threads: one. Real-time: yes.
class Standing {
 public:
    /// Stands settled at a place of the floor.
    void stand(const FloorMove& place) noexcept RAKS_NONBLOCKING;

    /// Starts to settle from the pose shown now (and the one a hop before) at floor place `from` to
    /// `to`.
    void settle(const Skeleton& skeleton,
                const Pose& shown,
                const Pose& shown_before,
                const FloorMove& from,
                const FloorMove& to,
                StreamTime now) noexcept RAKS_NONBLOCKING;

    /// How long it takes to settle from one place to another.
    [[nodiscard]] static Nanos duration(const FloorMove& from,
                                        const FloorMove& to) noexcept RAKS_NONBLOCKING;
    /// Whether all steps of settling are over.
    [[nodiscard]] bool is_settled(StreamTime time) const noexcept RAKS_NONBLOCKING;

    /// The pose at `time`, its feet as if it stood there already.
    [[nodiscard]] Pose at(const Skeleton& skeleton,
                          StreamTime time) const noexcept RAKS_NONBLOCKING;
    /// Solves both legs of a pose so that its feet are where their steps have brought them.
    void plant(const Skeleton& skeleton,
               StreamTime time,
               Pose& pose) const noexcept RAKS_NONBLOCKING;

 private:
    struct Step {
        Side side = Side::left;
        FootTarget to;
    };
    struct Foot {
        FootTarget from;
        glm::vec3 speed{};  // metres a second
    };
    [[nodiscard]] FloorMove place(double share) const noexcept;
    [[nodiscard]] FootTarget foot(Side side, double elapsed, bool& stands) const noexcept;

    FloorMove from_;
    FloorMove to_;
    StreamTime since_{};
    double seconds_ = 0.0;  // that settling takes; 0: stands
    std::array<Foot, 2> feet_{};
    std::array<Step, 4> steps_{};
    std::size_t step_count_ = 0;
};

}  // namespace raks::motion
