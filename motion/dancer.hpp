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

class DanceLibrary;
class Repertoire;

/// What a user asks of the dancer. Takes effect at the first hop at or after `time`.
struct DancerCommand {
    enum class Kind : std::uint8_t {
        next_figure,    ///< go on to another figure at the end of this one
        select_figure,  ///< figure number `value` at the end of this one
        lock_figure,    ///< `value` 1: this figure again and again; 0: as the grammar says
        select_dance,   ///< number `value` of the list; DanceId::none: as the music is
        hold,           ///< settle and stand, whatever the music does
        release,        ///< dance again from the next count 1
    };
    Kind kind = Kind::next_figure;
    StreamTime time{};
    double value = 0.0;
};
static_assert(std::is_trivially_copyable_v<DancerCommand>);

/// What the dancer is doing, for the overlay.
struct DancerStatus {
    std::array<char, 32> figure{};  ///< name, zero-terminated; empty while standing
    bool is_dancing = false;
    DanceId dance = DanceId::none;  ///< that is danced; none while standing
    std::uint32_t number = 0;       ///< of the figures begun since reset()
    int count = 0;                  ///< 1..counts of the figure; 0 while standing
    int counts = 8;                 ///< its length in beats
    double phase = 0.0;             ///< beats of the figure danced, [0, length)
    double octave = 1.0;            ///< dance beats per music beat: 0.5, 1 or 2
    double rate = 0.0;              ///< dance beats per second now
    std::uint32_t reanchors = 0;    ///< how often the phase was set anew since reset()
};
static_assert(std::is_trivially_copyable_v<DancerStatus>);

/// Dances to music states: one pose a hop.
///
///     Dancer dancer;
///     dancer.prepare(library, mannequin_skeleton(), seed);   // once, checks
///     dancer.advance(state, track);                          // every hop, in order
///
/// What it appends depends on repertoire, skeleton, seed, states and commands alone, bit for bit.
/// Threads: one owner; prepare elsewhere before. A moved-from dancer must be prepared again.
class Dancer {
 public:
    Dancer();
    ~Dancer();
    Dancer(Dancer&&) noexcept;
    Dancer& operator=(Dancer&&) noexcept;

    /// Stands ready at the stage's centre. Dances what the music is: goes over at a bar line, from
    /// a settled pose. Errors: no repertoire. Real-time: no (allocates).
    [[nodiscard]] Expected<void> prepare(std::shared_ptr<const Repertoire> repertoire,
                                         const Skeleton& skeleton,
                                         const DancerPart& part);
    /// Alone, one dance (salsa, by name) to any music; figures and ways from one seed.
    /// Errors: no library.
    [[nodiscard]] Expected<void> prepare(std::shared_ptr<const DanceLibrary> library,
                                         const Skeleton& skeleton,
                                         std::uint64_t seed);

    /// One hop: appends the final pose of `state.hop` to `track` and renews all predicted ones.
    /// After a gap in the hop numbers the track starts anew. Without prepare() it does nothing.
    /// Real-time: yes (no allocation; bounded by the predicted poses).
    void advance(const MusicState& state, PoseTrack& track) noexcept RAKS_NONBLOCKING;

    /// Queues a command (16 wait at most, the oldest are applied first; more are dropped).
    /// Real-time: yes.
    void command(const DancerCommand& command) noexcept RAKS_NONBLOCKING;

    /// Back to just-prepared. Real-time: yes.
    void reset() noexcept RAKS_NONBLOCKING;

    [[nodiscard]] DancerStatus status() const noexcept;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace raks::motion
