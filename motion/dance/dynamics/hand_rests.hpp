// Hand rests: hands leave the dance, to rest or to show something, and come back.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/figures/dance_habits.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// One of these places but not the last one: a rest is never the same twice running. `at`: [0, 1),
/// drawn. None: there is no other. Threads: any. Real-time: yes.
[[nodiscard]] std::optional<HandPlace> another_place(std::span<const HandPlace> places,
                                                     std::optional<HandPlace> last,
                                                     double at) noexcept RAKS_NONBLOCKING;

/// Leads hands to a place beside the body, where they stay while the trunk dances under them, or
/// move by the beat as the place says, and back into the dance. Threads: one. Real-time: yes.
class HandRests {
 public:
    /// This hand goes to a place, within so many seconds. One that rests elsewhere goes there
    /// straight. `beat`: of the dance, now.
    void go_to(Side side, HandPlace place, StreamTime now, double beat, double seconds) noexcept
        RAKS_NONBLOCKING;
    /// This hand goes back into the dance.
    void let_go(Side side, StreamTime now, double seconds) noexcept RAKS_NONBLOCKING;
    /// All hands dance, at once.
    void reset() noexcept { *this = HandRests(); }
    /// Whether this hand is at a place, or on its way to one.
    [[nodiscard]] bool rests(Side side) const noexcept {
        return hands_[static_cast<std::size_t>(side)].to > 0.0F;
    }

    /// Where it rests or goes to; after it was let go, where it was.
    [[nodiscard]] HandPlace place(Side side) const noexcept {
        return hands_[static_cast<std::size_t>(side)].place;
    }

    /// The pose with its hands where they are at that moment. `beat`: of the dance, whose odd ones
    /// are the off-beats.
    void apply(const Skeleton& skeleton,
               StreamTime time,
               double beat,
               Pose& pose) const noexcept RAKS_NONBLOCKING;

 private:
    /// A place of the left hand: from the shoulder's joint, in lengths of the arm, in the frame of
    /// the facing (outward, up, ahead); the direction in which the elbow points; and how far the
    /// palm is turned up and the wrist bent to the palm, radians.
    struct Rest {
        glm::vec3 wrist{};
        glm::vec3 elbow{};
        float turn = 0.0F;
        float bend = 0.0F;
    };
    /// How a hand moves at its place: by so much, farthest half-way between two of its hits.
    struct Sway {
        glm::vec3 by{};
        double every = 2.0;       // beats
        double hit = 1.0;         // a beat at which it is where the place says
        float sharpness = 0.0F;   // 0: as a pendulum; 1: it strikes
        bool alternates = false;  // the right hand is half a period later
        [[nodiscard]] float at(double beat, Side side) const noexcept;
    };
    struct Way {
        StreamTime since{};
        float seconds = 0.5F;
        [[nodiscard]] float share(StreamTime time) const noexcept;
    };
    struct Hand {
        HandPlace place = HandPlace::thigh;
        /// Where it rested as it was sent to `place`
        std::optional<HandPlace> place_before{};
        Rest before;        // or, where that was on its way, how it was then
        Way change;         // from there
        Way way;            // into the rest, or out of it
        float from = 0.0F;  // share of the rest as that way began
        float to = 0.0F;    // and as it ends: 0 or 1
        [[nodiscard]] float weight(StreamTime time) const noexcept;
        [[nodiscard]] Rest rest(StreamTime time, double beat, Side side) const noexcept;
    };
    struct Arm;  // in the source
    [[nodiscard]] static Rest rest_at(HandPlace place, double beat, Side side) noexcept;
    static const std::array<Rest, kHandPlaceNames.size()> kRests;
    static const std::array<Sway, kHandPlaceNames.size()> kSways;

    std::array<Hand, 2> hands_{};
};

}  // namespace raks::motion
