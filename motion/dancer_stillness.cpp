// How the dancer stands still and comes out of it, and what its hands do meanwhile.
#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "motion/dance/key_moment.hpp"
#include "motion/dancer_state.hpp"

namespace raks::motion {
namespace {

constexpr double kLongestStop = 1.9;    // seconds of stillness after which the dancer relaxes
constexpr double kSoonGoesOn = 0.8;     // seconds to an entry that is known, for which one stays
constexpr double kLongestEnding = 1.8;  // seconds for which the last posture is held
constexpr Nanos kThanksAfter = std::chrono::milliseconds(600);  // after the last posture

// Beats from the moment shown in which the posture for a stop is looked for. The clock comes to
// rest after twice the way there.
constexpr double kNearestKey = 0.12;
constexpr double kFarthestKey = 0.42;
constexpr double kFarthestKeySeconds = 0.18;  // and never farther: slow music stops as fast
// Of the last posture: beats of the dance before the last beat from which it is led to, and its
// key, as a share of what would be danced until then.
constexpr double kBeforeEnd = 1.2;
constexpr double kNearestEnd = 0.40;
constexpr double kFarthestEnd = 0.80;
constexpr double kBeforeKnownStop = 0.6;  // beats before a stop that is known
// A pause at the end of a phrase: beats in which its posture is reached at full speed, seconds at
// rest, and beats before the count 1 by which the dance goes on, so that the step into it is
// danced.
constexpr double kPauseKey = 0.15;
constexpr double kShortestPause = 0.30;
constexpr double kLongestPause = 1.0;
constexpr double kStepIn = 0.5;
// Of a rest in a dance of cells, in beats: how near its moment it may still be begun, and how long
// after that moment the dance begins to move again, so that it is in time on the second beat.
constexpr double kNearestRest = 0.02;
constexpr double kRestLasts = 1.5;
constexpr HopIndex kHopsBetweenLooks = 8;  // a look ahead costs up to twenty poses
constexpr double kLivelyEnough = 0.2;      // energy from which phrases end in pauses
constexpr double kHandsToPose = 0.50;      // seconds

// Streams of random numbers.
constexpr std::uint64_t kPauseStream = 3;
constexpr std::uint64_t kPoseStream = 5;
constexpr std::uint64_t kEndingStream = 8;

/// Where both hands are while the dancer stands still; none: where the dance left it.
struct ArmPosture {
    std::optional<HandPlace> left;
    std::optional<HandPlace> right;
};
constexpr std::array<ArmPosture, 7> kArmPostures = {{
    {HandPlace::high, HandPlace::hip},
    {HandPlace::hip, HandPlace::wide},
    {HandPlace::low, HandPlace::low},
    {HandPlace::wide, std::nullopt},
    {std::nullopt, HandPlace::high},
    {HandPlace::hip, HandPlace::hip},
    {std::nullopt, std::nullopt},
}};

}  // namespace

// What ends a stillness depends on what began it.
void Dancer::State::stay_still(const MusicState& music) noexcept {
    if (still.is_at_rest(music.time) && !still.posture()) {
        still.keep(danced_at(still.phase(music.time)));
    }
    const double rested = still.seconds_at_rest(music.time);
    const bool sounds = music.part != MusicPart::stopped && !music.is_silent;
    using Kind = MusicEvent::Kind;
    const bool stops =
        music.is_silent || music.event.kind == Kind::stop || music.event.kind == Kind::end;
    if (cause == Cause::phrase && stops) {  // the music has stopped in a pause
        const bool is_over = music.ahead.is_known && music.time >= music.ahead.ends;
        cause = is_over ? Cause::ending : Cause::stop;
    }
    const MusicEvent& next = music.ahead.events.front();
    const bool goes_on_soon = cause != Cause::ending && music.ahead.is_known &&
                              next.kind == Kind::entry &&
                              to_seconds(next.time - music.time) < kSoonGoesOn;
    if (is_held ||
        (rested > (cause == Cause::ending ? kLongestEnding : kLongestStop) && !goes_on_soon)) {
        const bool is_over = cause == Cause::ending && !is_held;
        settle(music.time);
        if (is_over) {
            end_song(music.time + kThanksAfter);
        }
        return;
    }
    switch (cause) {
        case Cause::phrase:
            if (phase.phase() >= resumes) {
                resume(music);
            }
            break;
        case Cause::stop:
            if (sounds && rested > 0.0 &&
                (music.ahead.is_known || music.grid.confidence >= kStopConfidence)) {
                resume(music);
            }
            break;
        case Cause::ending:
            break;
    }
}

/// Thanks the audience, each time in another way of the dance's.
void Dancer::State::end_song(StreamTime at) noexcept {
    const std::vector<Ending>& endings = content().chooser.habits().endings;
    if (!endings.empty()) {
        const std::uint64_t first =
            CounterRandom(part.seed, kEndingStream).below(0, endings.size());
        idle.end_song(endings[static_cast<std::size_t>((first + songs_ended++) % endings.size())],
                      at);
    }
}

/// Stops with the music: as soon as it is heard, or so as to stand when it does where that is
/// known.
bool Dancer::State::stop_with(const MusicState& music) noexcept {
    using Kind = MusicEvent::Kind;
    const double near = kBeforeKnownStop * music.grid.tempo.seconds_per_beat();
    const auto comes = [&](StreamTime time) {
        const double left = to_seconds(time - music.time);
        return left > 0.0 && left <= near;
    };
    if (music.ahead.is_known) {
        const MusicEvent& next = music.ahead.events.front();
        const bool ends_with_event = next.kind == Kind::end && next.time > music.time;
        if (end_on(music,
                   ends_with_event ? std::min(next.time, music.ahead.ends) : music.ahead.ends)) {
            return true;
        }
        if (next.kind == Kind::stop && comes(next.time)) {
            stand_still(music, Cause::stop, kNearestKey, kFarthestKey);
            return true;
        }
    }
    if (music.event.kind == Kind::stop || music.event.kind == Kind::end) {
        stand_still(music, Cause::stop, kNearestKey, kFarthestKey);
        return true;
    }
    return false;
}

/// Comes to stand in the last posture on the last beat itself: the music may stop there.
bool Dancer::State::end_on(const MusicState& music, StreamTime last) noexcept {
    const double left = to_seconds(last - music.time);
    const double beats = left * phase.rate();
    if (left <= 0.0 || beats > kBeforeEnd) {
        return false;
    }
    const Beats from = shown_phase(music.time, Nanos(0));
    const Beats earliest = from + Beats(kNearestEnd * beats);
    const Beats latest = from + Beats(kFarthestEnd * beats);
    // Both of a couple stop at the same moment of their figure.
    const Beats key = part.is_in_couple ? earliest + 0.5 * (latest - earliest)
                                        : key_moment(sequence, earliest, latest);
    cause = Cause::ending;
    still.begin(music.time, from, phase.rate(), key, last);
    show_pose(music.time, left);
    return true;
}

/// Waits at the end of a figure for the downbeat, where count 1 has lain on another beat: the last
/// posture is held for as many beats as are missing.
bool Dancer::State::wait_for_bar(const MusicState& music) noexcept {
    const double left = (sequence.end() - phase.phase()).count();
    if (phase.beats_off_bar() == 0 || left > 2.0 * kPauseKey + kStepIn) {
        return false;
    }
    stand_still(music, Cause::phrase, kPauseKey, kPauseKey);
    // What is danced unseen goes back, so that the figure ends on the downbeat.
    phase.take_bar();
    ++reanchors;
    resumes = sequence.end() - Beats(kStepIn);
    return true;
}

/// Pauses at the end of a phrase, if the draw for this phrase says so and a figure ends with it:
/// where the figure leaves both feet standing for long enough; at the last moment anywhere, and
/// steps are left out.
bool Dancer::State::pause_at_phrase_end(const MusicState& music) noexcept {
    if (sequence.is_of_cells()) {
        return pause_at_rest(music);
    }
    const double left = (sequence.end() - phase.phase()).count();
    const double slowing = 2.0 * kPauseKey + kStepIn;
    const double least = slowing + kShortestPause * phase.rate();
    if (left > slowing + kLongestPause * phase.rate() || left < least ||
        music.hop % kHopsBetweenLooks != 0) {
        return false;
    }
    const double bars = left / (phase.octave() * music.grid.beats_per_bar);
    const CounterRandom random(part.seed, kPauseStream);
    if (std::abs(phrases.bar() + bars - Phrases::kBars) > kNearPhraseEnd ||
        random.uniform(phrases.number()) >= content().chooser.habits().pauses ||
        static_cast<double>(manner.energy()) < kLivelyEnough) {
        return false;
    }
    const Beats key = shown_phase(music.time, Nanos(0)) + Beats(kPauseKey);
    const Beats last = sequence.end() - Beats(kStepIn);
    const Beats stood = stands_until(sequence, key, last);
    const bool stands = (stood - key).count() >= kPauseKey + kShortestPause * phase.rate();
    const double to_next_look = phase.rate() * kHopsBetweenLooks * to_seconds(kHop);
    if (!stands && left - to_next_look >= least) {
        return false;
    }
    resumes = stands ? stood : last;
    stand_still(music, Cause::phrase, kPauseKey, kPauseKey);
    return true;
}

/// Stays for two beats where a cell ends at rest that was asked for. The pose in which it ends is
/// reached at half speed, so that the clock begins to slow down before.
bool Dancer::State::pause_at_rest(const MusicState& music) noexcept {
    const Beats from = shown_phase(music.time, Nanos(0));
    if (!asked.rests_at) {
        return false;
    }
    const Beats key(*asked.rests_at);
    const double left = (key - from).count();
    if (left > kPauseKey || left < kNearestRest || !sequence.rests_at(key)) {
        return false;
    }
    cause = Cause::phrase;
    resumes = key + Beats(kRestLasts);
    still.begin(music.time, from, phase.rate(), key);
    return true;
}

/// Begins to stand still in the calmest posture between two phases, in beats from the one shown.
void Dancer::State::stand_still(const MusicState& music,
                                Cause why,
                                double earliest,
                                double latest) noexcept {
    const Beats from = shown_phase(music.time, Nanos(0));
    latest = std::max(earliest, std::min(latest, kFarthestKeySeconds * phase.rate()));
    // Both of a couple stop at the same moment of their figure.
    const Beats key = part.is_in_couple
                          ? from + Beats(0.5 * (earliest + latest))
                          : key_moment(sequence, from + Beats(earliest), from + Beats(latest));
    cause = why;
    still.begin(music.time, from, phase.rate(), key);
    // A pause is over before arms had come anywhere.
    if (why != Cause::phrase) {
        show_pose(music.time, kHandsToPose);
    }
}

/// Leads the arms to a posture that looks meant, within so many seconds.
void Dancer::State::show_pose(StreamTime now, double seconds) noexcept {
    // One of a couple keeps the other's hands; people's cells have arms of their own, but none that
    // end a song.
    if (part.is_in_couple || (sequence.is_of_cells() && cause != Cause::ending)) {
        return;
    }
    const CounterRandom random(part.seed, kPoseStream);
    const std::uint64_t draw = random.below(sequence.number(), kArmPostures.size());
    const ArmPosture& posture = kArmPostures[static_cast<std::size_t>(draw)];
    const std::array<std::optional<HandPlace>, 2> places = {posture.left, posture.right};
    for (const Side side : kSides) {
        if (const auto& place = places[static_cast<std::size_t>(side)]) {
            hands.go_to(side, *place, now, hands_beat(now, Nanos(0)), seconds);
        }
    }
}

/// Dances on where the dance has come to unseen.
void Dancer::State::resume(const MusicState& music) noexcept {
    const Beats key = still.phase(music.time);
    still.end();
    sequence.go_on_from(key, shown_phase(music.time, Nanos(0)));
    figure_rested = ~0ULL;
    release_hands(music.time, kHandsBack);
    change(music.time);
}

}  // namespace raks::motion
