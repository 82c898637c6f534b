#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/dance/dancer_part.hpp"
#include "motion/skeleton/pose_track.hpp"
#include "motion/skeleton/skeleton.hpp"

/// The one door of motion: music states in, poses out.
namespace raks::motion {

class DanceLibrary;  // motion/dance_library.hpp
class Repertoire;    // motion/repertoire.hpp

/// A user's request to the dancer. It takes effect at the first hop at or after `time`.
struct DancerCommand {
    /// What is asked.
    enum class Kind : std::uint8_t {
        next_figure,    ///< go on to another figure at the end of this one
        select_figure,  ///< figure number `value` at the end of this one
        lock_figure,    ///< `value` 1: this figure again and again; 0: as the grammar says
        select_dance,   ///< number `value` of the list; DanceId::none: as the music is
        forbid_dance,   ///< number `value` is danced only where no other is known
        allow_dance,    ///< number `value` may be danced again
        hold,           ///< settle and stand, whatever the music does
        release,        ///< dance again from the next downbeat
    };
    Kind kind = Kind::next_figure;  ///< what is asked
    StreamTime time{};              ///< when it shall take effect at the earliest
    double value = 0.0;             ///< its meaning depends on `kind`
};
static_assert(std::is_trivially_copyable_v<DancerCommand>);

/// What the dancer is doing, for the overlay.
struct DancerStatus {
    std::array<char, 32> figure{};  ///< name, zero-terminated; empty while standing
    bool is_dancing = false;        ///< false while standing
    DanceId dance = DanceId::none;  ///< the dance being danced; none while standing
    std::uint32_t number = 0;       ///< figures begun since reset()
    int count = 0;                  ///< 1..counts of the figure; 0 while standing
    int counts = 8;                 ///< its length in beats
    double phase = 0.0;             ///< beats of the figure danced, [0, length)
    double octave = 1.0;            ///< dance beats per music beat: 0.25, 0.5, 1 or 2
    double rate = 0.0;              ///< dance beats per second now
    bool is_mirrored = false;       ///< the figure is danced left for right
    std::uint32_t reanchors = 0;    ///< how often the phase was re-anchored since reset()
};
static_assert(std::is_trivially_copyable_v<DancerStatus>);

/// Dances to music states: one pose a hop.
///
///     Dancer dancer;
///     dancer.prepare(library, mannequin_skeleton(), seed);   // once, checks
///     dancer.advance(state, track);                          // every hop, in order
///
/// The poses depend on repertoire, skeleton, part, states and commands alone, bit for bit. Threads:
/// one owner; prepare elsewhere before. A moved-from dancer must be prepared again.
class Dancer {
 public:
    /// Not prepared: advance() does nothing.
    Dancer();
    /// Out of line, where State is complete.
    ~Dancer();
    /// Moves the whole dancer; cheap.
    Dancer(Dancer&&) noexcept;
    /// Moves the whole dancer; cheap.
    Dancer& operator=(Dancer&&) noexcept;

    /// Makes the dancer stand ready at its place on the stage. It dances what fits the music's
    /// genre and changes dances at a bar line, from a settled pose. Errors: no repertoire.
    /// Real-time: no (allocates).
    [[nodiscard]] Expected<void> prepare(std::shared_ptr<const Repertoire> repertoire,
                                         const Skeleton& skeleton,
                                         const DancerPart& part);
    /// One dancer alone with one dance for any music (under the first dance's number); figures and
    /// their ways from one seed. Errors: no library. Real-time: no (allocates).
    [[nodiscard]] Expected<void> prepare(std::shared_ptr<const DanceLibrary> library,
                                         const Skeleton& skeleton,
                                         std::uint64_t seed,
                                         Dynamics dynamics = Dynamics::on);

    /// One hop: appends the final pose of `state.hop` to `track` and renews all predicted ones.
    /// After a gap in the hop numbers the track starts anew. Before prepare() it does nothing.
    /// Threads: one caller. Real-time: yes (no allocation; bounded by the predicted poses).
    void advance(const MusicState& state, PoseTrack& track) noexcept RAKS_NONBLOCKING;

    /// Queues a command (at most 16 wait; more are dropped). Due ones are applied in the order in
    /// which they were given. Threads: the owner. Real-time: yes.
    void command(const DancerCommand& command) noexcept RAKS_NONBLOCKING;

    /// Goes on where `before` is, without a leap: the same figure, beat and place, and what it was
    /// asked for. For a dancer of the same part with the same dances, solved for another body that
    /// stands as high. Where it does not know the dance (yet), it stands there. Threads: the owner
    /// of both. Real-time: yes.
    void go_on_from(const Dancer& before) noexcept RAKS_NONBLOCKING;

    /// Returns to the state after prepare(). Threads: the owner. Real-time: yes.
    void reset() noexcept RAKS_NONBLOCKING;

    /// The pose of the last hop; before the first one how the dancer stands ready. A T-pose before
    /// prepare(). Threads: the owner. Real-time: yes.
    [[nodiscard]] const Pose& shown() const noexcept;

    /// What the dancer is doing at the last hop. Threads: the owner. Real-time: yes.
    [[nodiscard]] DancerStatus status() const noexcept RAKS_NONBLOCKING;

 private:
    struct Course;
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace raks::motion
