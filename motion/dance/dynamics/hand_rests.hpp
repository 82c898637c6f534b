// Hand rests: hands leave the dance, to rest or to show something, and come back.
#pragma once

#include <array>
#include <cstddef>

#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/figures/dance_habits.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Leads hands to a place beside the body, where they stay still while the trunk dances under them,
/// and back into the dance. Threads: one. Real-time: yes.
class HandRests {
 public:
    /// This hand goes to a place, within so many seconds. One that rests elsewhere goes there
    /// straight.
    void go_to(Side side,
               HandPlace place,
               StreamTime now,
               double seconds) noexcept RAKS_NONBLOCKING;
    /// This hand goes back into the dance.
    void let_go(Side side, StreamTime now, double seconds) noexcept RAKS_NONBLOCKING;
    /// All hands dance, at once.
    void reset() noexcept { *this = HandRests(); }
    /// Whether this hand is at a place, or on its way to one.
    [[nodiscard]] bool rests(Side side) const noexcept {
        return hands_[static_cast<std::size_t>(side)].to > 0.0F;
    }

    /// The pose with its hands where they are at that moment.
    void apply(const Skeleton& skeleton,
               StreamTime time,
               Pose& pose) const noexcept RAKS_NONBLOCKING;

 private:
    /// A place of the left hand: from the shoulder's joint, in lengths of the arm, in the frame of
    /// the facing (outward, up, ahead); and the direction in which the elbow points.
    struct Rest {
        glm::vec3 wrist{};
        glm::vec3 elbow{};
    };
    struct Way {
        StreamTime since{};
        float seconds = 0.5F;
        [[nodiscard]] float share(StreamTime time) const noexcept;
    };
    struct Hand {
        HandPlace place = HandPlace::thigh;
        Rest before;        // where it rested as it was sent to `place`
        Way change;         // from there
        Way way;            // into the rest, or out of it
        float from = 0.0F;  // share of the rest as that way began
        float to = 0.0F;    // and as it ends: 0 or 1
        [[nodiscard]] float weight(StreamTime time) const noexcept;
        [[nodiscard]] Rest rest(StreamTime time) const noexcept;
    };
    struct Arm;  // in the source
    static const std::array<Rest, kHandPlaceNames.size()> kRests;

    std::array<Hand, 2> hands_{};
};

}  // namespace raks::motion
