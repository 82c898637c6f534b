// Waiting: what a dancer does who stands and does not dance.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/dance/dynamics/gesture.hpp"
#include "motion/dance/dynamics/hand_rests.hpp"
#include "motion/figures/dance_habits.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// How much of a beat is felt by one who waits.
struct FeltBeat {
    float felt = 0.0F;  ///< [0, 1]
    double beat = 0.0;  ///< beats of the music
};

/// Makes one who stands (Standing) alive: one small movement after the other (IdleMove), of which
/// none comes twice within a minute, each to this or the other side; nods and gives in the knees to
/// a beat that is felt; ends a song. The feet do not slide. Poses are functions of the time between
/// two calls of begin(). Threads: one. Real-time: yes.
class Waiting {
 public:
    /// Movements of a round: as many as the dance has of its own, and others up to this number.
    static constexpr std::size_t kLeastMoves = 16;
    /// Seconds of one movement; a round takes more than a minute.
    static constexpr double kMoveSeconds = 4.1;

    /// Stands and waits from `now` on. `seed`: of the order, and of the sides.
    void begin(StreamTime now,
               const DanceHabits& habits,
               std::uint64_t seed) noexcept RAKS_NONBLOCKING;
    /// Ends the song at this moment; other movements come after it. Call it after begin().
    void end_song(Ending ending, StreamTime at) noexcept RAKS_NONBLOCKING;
    /// Leads the hands as the movement at `now` has them. Call it once for each hop.
    void lead_hands(StreamTime now, HandRests& hands) const noexcept RAKS_NONBLOCKING;
    /// Gives its movement to the pose of one who stands; then the hands are to be put in place.
    void move(const Skeleton& skeleton,
              StreamTime time,
              const FeltBeat& beat,
              Pose& pose) const noexcept RAKS_NONBLOCKING;
    /// Shakes the hands, where they are in place.
    void shake(StreamTime time, Pose& pose) const noexcept RAKS_NONBLOCKING;

    /// What is done at a moment; none: an ending, or not yet anything.
    [[nodiscard]] std::optional<IdleMove> move_at(StreamTime time) const noexcept RAKS_NONBLOCKING;

 private:
    static constexpr std::size_t kMostMoves = kIdleMoveNames.size();
    /// A movement at a moment.
    struct Moment {
        const Gesture* gesture = nullptr;  // null: none
        double seconds = 0.0;              // since it began
        bool is_mirrored = false;
        BodyShape from;  // in which it began
    };
    [[nodiscard]] Moment moment_at(StreamTime time) const noexcept;
    [[nodiscard]] BodyShape shape_at_moment(const Moment& moment) const noexcept;
    [[nodiscard]] IdleMove nth(std::uint64_t number) const noexcept;
    [[nodiscard]] bool is_nth_mirrored(std::uint64_t number) const noexcept;

    std::array<IdleMove, kMostMoves> order_{};
    std::size_t count_ = 0;
    std::uint64_t seed_ = 1;
    StreamTime since_{};  // the first movement begins
    Ending ending_ = Ending::bow;
    std::optional<StreamTime> ends_at_{};
};

}  // namespace raks::motion
