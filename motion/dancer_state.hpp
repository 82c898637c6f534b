// Dancer state: what is behind the dancer's door.
#pragma once

#include <memory>
#include <optional>

#include "base/timed_commands.hpp"
#include "motion/dance/beat_phase.hpp"
#include "motion/dance/cell_listener.hpp"
#include "motion/dance/dance_sequence.hpp"
#include "motion/dance/dynamics/breath.hpp"
#include "motion/dance/dynamics/feelings.hpp"
#include "motion/dance/dynamics/hand_rests.hpp"
#include "motion/dance/dynamics/hand_shapes.hpp"
#include "motion/dance/dynamics/hits.hpp"
#include "motion/dance/dynamics/looks.hpp"
#include "motion/dance/dynamics/manner.hpp"
#include "motion/dance/dynamics/phrases.hpp"
#include "motion/dance/dynamics/planted_feet.hpp"
#include "motion/dance/dynamics/stillness.hpp"
#include "motion/dance/dynamics/waiting.hpp"
#include "motion/dance/inertialization.hpp"
#include "motion/dance/standing.hpp"
#include "motion/dancer.hpp"
#include "motion/library_content.hpp"
#include "motion/repertoire.hpp"

namespace raks::motion {

/// Confidence of the beat grid below which the dance may end; lower than that from which it begins,
/// so that a dip does not end it.
inline constexpr float kStopConfidence = 0.10F;
/// Bars from the end of a phrase that a figure's end may be and still be the phrase's
inline constexpr double kNearPhraseEnd = 0.3;
/// Seconds in which hands come back into the dance
inline constexpr double kHandsBack = 0.70;
/// Seconds in which hands go to where they rest
inline constexpr double kHandsToRest = 0.75;

/// How far a dance has come: what another dancer can go on from.
struct Dancer::Course {
    /// Why the dance stands still.
    enum class Cause : std::uint8_t {
        phrase,  ///< a phrase ends and this dancer chose to pause, or the bar is waited for
        stop,    ///< the music stopped
        ending,  ///< the song is over
    };

    DanceId genre = DanceId::none;     // of what is danced, or was last
    DanceId selected = DanceId::none;  // by command
    DanceSet forbidden;                // by command; a selected one is danced even so
    int bars_to_wait = 0;              // downbeats that still pass before the start
    DanceSequence sequence;
    FigureWish wish;
    bool stands_turned = false;  // half a turn from where the first dance began: couples
    Standing standing;

    bool is_dancing = false;
    bool is_first_hop = true;    // nothing was shown before it
    bool is_held = false;        // by command, until release
    bool is_after_line = false;  // the last hop was just after a bar line
    bool is_at_line = false;     // this hop is the first after a bar line
    int bars_unwanted = 0;       // bar lines that passed in a dance that is no longer wanted
    int hops_sure = 0;           // consecutive hops above BeatGrid::kDanceable
    int hops_unsure = 0;         // consecutive hops of silence or below kStopConfidence
    DancePhase phase;
    double pace = 1.0;  // danced tempo / learnt tempo, smoothed over about a second
    Nanos delay{};      // landing delay of the figure, smoothed over about a second
    std::uint32_t reanchors = 0;

    MannerOfMusic manner;
    Phrases phrases;
    Stillness still;
    Cause cause = Cause::phrase;          // of `still`
    Beats resumes{};                      // phase at which a phrase's pause ends
    std::uint64_t figure_rested = ~0ULL;  // the last figure for which rests were drawn
    CellListener listener;
    CellMusic asked;  // of a dance of cells, at the last hop
    Hits hits;
    HandRests hands;
    std::optional<HandPlace> last_rest{};
    std::optional<StreamTime> rest_ends{};  // of a hand that lies still
    HandShapes fingers;
    BeatGrid grid;      // of the last hop
    float felt = 0.0F;  // [0, 1]: how much of the beat is felt, while waiting
    Waiting idle;
    std::uint64_t settled = 0;      // how often the dancer has settled
    std::uint64_t songs_ended = 0;  // which ending comes next
    PlantedFeet feet;
    Looks looks;
    Breath breath;
    Feelings feelings;

    Inertialization smoothing;  // decays the jump of the last change
    StreamTime changed_at{};    // hop before the change, at which its difference was measured
    Pose shown;                 // the last final pose
    Pose shown_before;          // the one before it
    HopIndex last_hop = -1;     // -1: none yet

    TimedCommands<DancerCommand, 16> commands;
};

struct Dancer::State : Dancer::Course {
    std::shared_ptr<const Repertoire> repertoire;
    Skeleton skeleton;
    DancerPart part;
    const DanceLibrary* dance = nullptr;  // being danced, or the last one
    FloorMove stage;                      // from a figure's start to the stage
    DanceMetre metre;                     // decides octave and pace

    [[nodiscard]] const DanceLibrary::Content& content() const noexcept { return dance->content(); }
    void reset() noexcept;
    void take_up(DanceId other) noexcept;
    void find(DanceId other) noexcept;
    void go_on_from(const State& before) noexcept;
    [[nodiscard]] FloorMove place() const noexcept;
    void apply(const DancerCommand& command) noexcept;
    void allow(double number, bool is_allowed) noexcept;

    // Decisions of one hop (dancer_course.cpp, dancer_hands.cpp, dancer_stillness.cpp).
    void decide(const MusicState& music) noexcept;
    void go_on(const MusicState& music) noexcept;
    void advance_sequence(const MusicState& music, bool has_reanchored) noexcept;
    [[nodiscard]] double energy_of_next(const MusicState& music) noexcept;
    void dance_on(const MusicState& music, bool has_reanchored) noexcept;
    void stay_still(const MusicState& music) noexcept;
    void begin(const MusicState& music, bool is_turned) noexcept;
    void begin_bars_ago(const MusicState& music, bool is_turned, int bars) noexcept;
    void come_in(const MusicState& music) noexcept;
    void start_at_line(const MusicState& music) noexcept;
    void leave(const MusicState& music) noexcept;
    void settle(StreamTime now) noexcept;
    void end_song(StreamTime at) noexcept;
    [[nodiscard]] bool wait_for_bar(const MusicState& music) noexcept;
    [[nodiscard]] bool pause_at_phrase_end(const MusicState& music) noexcept;
    [[nodiscard]] bool pause_at_rest(const MusicState& music) noexcept;
    [[nodiscard]] bool end_on(const MusicState& music, StreamTime last) noexcept;
    [[nodiscard]] bool stop_with(const MusicState& music) noexcept;
    void stand_still(const MusicState& music, Cause why, double earliest, double latest) noexcept;
    void resume(const MusicState& music) noexcept;
    void rest_hands(const MusicState& music) noexcept;
    void end_rest(StreamTime now) noexcept;
    void release_hands(StreamTime now, double seconds) noexcept;
    void shape_hands(const MusicState& music) noexcept;
    [[nodiscard]] double hands_beat(StreamTime now, Nanos ahead) const noexcept;
    void show_pose(StreamTime now, double seconds) noexcept;
    [[nodiscard]] DanceId wanted(DanceId recognized) const noexcept;

    // Poses (dancer_state.cpp).
    [[nodiscard]] bool is_free() const noexcept;
    [[nodiscard]] bool has_dynamics() const noexcept;
    [[nodiscard]] Beats shown_phase(StreamTime now, Nanos ahead) const noexcept;
    [[nodiscard]] Pose waiting(StreamTime now, Nanos ahead, const Looks& own) const noexcept;
    [[nodiscard]] Pose danced_at(Beats phase) const noexcept;
    [[nodiscard]] Pose danced(StreamTime now, Nanos ahead) const noexcept;
    [[nodiscard]] Pose layered(StreamTime now,
                               Nanos ahead,
                               const Looks& own,
                               Pose pose) const noexcept;
    [[nodiscard]] Pose target(StreamTime now, Nanos ahead) const noexcept;
    [[nodiscard]] Pose next(StreamTime now,
                            Nanos ahead,
                            PlantedFeet& own,
                            const Looks& looking) const noexcept;
    void look_on(StreamTime now) noexcept;
    void feel(const MusicState& music) noexcept;
    [[nodiscard]] Pose smoothed(StreamTime now, Nanos ahead, Pose pose) const noexcept;
    void change(StreamTime now) noexcept;
    void note_swings() noexcept;
};

}  // namespace raks::motion
