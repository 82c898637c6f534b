// What the dancer decides at each hop: to begin, to dance on, to stand still, to change, to settle.
#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "motion/dance/dynamics/waiting.hpp"
#include "motion/dancer_state.hpp"

namespace raks::motion {
namespace {

// Confidence of the beat grid below which the dance may end; lower than that from which it
// begins, so that a dip does not end it.
constexpr float kStopConfidence = 0.10F;
constexpr int kHopsToStart = 35;        // of sure music before the first step
constexpr double kLeastDance = 2.0;     // bars that a known song must still have for a start
constexpr int kHopsToStop = 150;        // of unsure music before settling (1.5 s)
constexpr double kLineWindow = 0.5;     // beats: how late after a bar line one may still start
constexpr double kLongestStop = 2.6;    // seconds of stillness after which the dancer relaxes
constexpr double kLongestEnding = 1.8;  // seconds for which the last posture is held
constexpr double kPaceShare = 0.01;     // a hop; smooths the pace over about a second
constexpr double kLeadShare = 0.01;     // a hop; another figure's lead takes about a second
constexpr float kFeltShare = 0.02F;     // a hop; a beat is felt within about half a second
constexpr Nanos kBowAfter = std::chrono::milliseconds(600);  // after the last posture
constexpr int kMostBarsUnwanted = 2;  // that a dance is danced on to turn to the front
constexpr double kTurnsOver = 1.75;   // radians: more is not turned within a step

// Beats from the moment shown in which the posture for a stop is looked for. The clock comes to
// rest after twice the way there.
constexpr double kNearestKey = 0.12;
constexpr double kFarthestKey = 0.42;
constexpr double kBeforeKnownStop = 0.6;  // beats before a stop that is known
// A pause at the end of a phrase: beats in which its posture is reached at full speed, seconds at
// rest, and beats before the count 1 by which the dance goes on, so that the step into it is
// danced.
constexpr double kPauseKey = 0.15;
constexpr double kShortestPause = 0.30;
constexpr double kLongestPause = 1.0;
constexpr double kStepIn = 0.5;
constexpr HopIndex kHopsBetweenLooks = 8;  // a look ahead costs up to twenty poses
constexpr double kNearPhraseEnd = 0.3;     // bars
constexpr double kRiseInPhrase = 0.3;      // of the energy, from its middle to its end
constexpr double kLivelyEnough = 0.2;      // energy from which phrases end in pauses
constexpr double kHandsToPose = 0.45;      // seconds
constexpr double kHandsToRest = 0.75;      // seconds
constexpr double kHandsBack = 0.60;        // seconds

// Streams of random numbers.
constexpr std::uint64_t kPauseStream = 3;
constexpr std::uint64_t kRestStream = 4;
constexpr std::uint64_t kPoseStream = 5;

/// Whether it is worth while to begin: a known song must have begun, and must have some bars left.
bool may_begin(const MusicState& music) noexcept {
    constexpr Nanos kRounding = std::chrono::milliseconds(20);
    const double least =
        kLeastDance * music.grid.beats_per_bar * music.grid.tempo.seconds_per_beat();
    return !music.ahead.is_known || (music.time >= music.ahead.begins - kRounding &&
                                     to_seconds(music.ahead.ends - music.time) >= least);
}

/// Whether the beat goes on though it is hardly heard: while its band leaves for a while, and in a
/// song that is known. The grid is danced on then.
bool goes_on_unsurely(const MusicState& music) noexcept {
    return music.ahead.is_known || music.part == MusicPart::breakdown ||
           music.part == MusicPart::build_up;
}

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

/// The dance for music of genre `heard`; a selected dance comes first. None: stand.
DanceId Dancer::State::wanted(DanceId recognized) const noexcept {
    for (const DanceId one : {selected, recognized}) {
        if (one != DanceId::none && repertoire->of(one) != nullptr) {
            return one;
        }
    }
    switch (repertoire->otherwise()) {
        case Repertoire::Fallback::first:
            return repertoire->first();
        case Repertoire::Fallback::keep:
            return genre;
        case Repertoire::Fallback::stand:
            break;
    }
    return DanceId::none;
}

/// The state machine of one hop.
void Dancer::State::decide(const MusicState& music) noexcept {
    const bool is_sure = !music.is_silent && music.grid.confidence >= BeatGrid::kDanceable;
    const bool is_unsure =
        music.is_silent || (music.grid.confidence < kStopConfidence && !goes_on_unsurely(music));
    hops_sure = is_sure ? hops_sure + 1 : 0;
    hops_unsure = is_unsure ? hops_unsure + 1 : 0;
    const bool is_after = music.grid.bar_position(music.grid.beats_at(music.time)) < kLineWindow;
    is_at_line = is_after && !is_after_line;
    is_after_line = is_after;
    phrases.advance(music);
    grid = music.grid;
    felt += kFeltShare * ((is_unsure ? 0.0F : 1.0F) - felt);
    if (!still.is_on()) {
        manner.advance(music);
        if (is_dancing && has_dynamics()) {
            hits.advance(music, manner.manner().body);
        }
    }
    bow(music.time);
    if (is_dancing) {
        go_on(music);
        // What is known needs no second look.
    } else if (is_held || hops_sure < (music.ahead.is_known ? 1 : kHopsToStart) ||
               !standing.is_settled(music.time) || !may_begin(music)) {
        is_after_line = false;
    } else {
        start_at_line(music);
    }
}

// One hop of dancing. The order matters: the phase first, then what follows from it. The dance goes
// on while it is not seen.
void Dancer::State::go_on(const MusicState& music) noexcept {
    const double own_rate = content().metre.learnt_tempo.beats_per_second();
    // Smoothed, since the phase's rate also holds its corrections.
    pace += kPaceShare * (phase.rate() / own_rate - pace);
    const bool has_reanchored = phase.advance(music.grid, metre, sequence.end(), music.time);
    if (has_reanchored) {
        sequence.jump(phase.phase());
    }
    sequence.set_tempo(Bpm(pace * 60.0 * own_rate));
    sequence.advance(phase.phase(), energy_of_next(music), wish);
    delay += nanos_from_seconds(kLeadShare * to_seconds(sequence.figure().landing_delay - delay));
    if (still.is_on()) {
        stay_still(music);
    } else {
        dance_on(music, has_reanchored);
    }
}

/// How lively the next figure shall be: as the music, and livelier towards the end of a phrase. A
/// phrase does not begin with the figure that the last one ended with.
double Dancer::State::energy_of_next(const MusicState& music) noexcept {
    const double heard = music.ahead.is_known ? static_cast<double>(music.ahead.energy)
                                              : static_cast<double>(music.energy.lately);
    if (!has_dynamics()) {
        return heard;
    }
    // After a drop more than is heard.
    const double energy = std::clamp(static_cast<double>(manner.energy()), heard, 1.0);
    const double bars =
        (sequence.end() - phase.phase()).count() / (phase.octave() * music.grid.beats_per_bar);
    const double begins = phrases.bar() + bars;  // bars into this phrase
    if (begins > Phrases::kBars - kNearPhraseEnd) {
        wish.is_another = true;
        return energy;
    }
    const double rise = kRiseInPhrase * std::max(0.0, 2.0 * begins / Phrases::kBars - 1.0);
    return std::min(1.0, energy + rise);
}

void Dancer::State::dance_on(const MusicState& music, bool has_reanchored) noexcept {
    const bool is_unwanted = wanted(music.genre) != genre;
    if (is_held || (hops_unsure > kHopsToStop && !music.is_silent)) {
        settle(music.time);
    } else if (has_dynamics() && stop_with(music)) {
        return;
    } else if (hops_unsure > kHopsToStop ||
               (music.ahead.is_known && music.time >= music.ahead.ends)) {
        settle(music.time);
    } else if (is_unwanted && is_at_line) {
        leave(music);
    } else if (has_dynamics() && pause_at_phrase_end(music)) {
        return;
    } else if (has_reanchored) {
        ++reanchors;
        change(music.time);
    } else if (has_dynamics()) {
        rest_hands(music);
    }
    if (!is_unwanted) {
        bars_unwanted = 0;
    }
}

// What ends a stillness depends on what began it.
void Dancer::State::stay_still(const MusicState& music) noexcept {
    if (still.is_at_rest(music.time) && !still.posture()) {
        still.keep(sequence.at(still.phase(music.time), manner.manner()));
    }
    const double rested = still.seconds_at_rest(music.time);
    const bool sounds = music.part != MusicPart::stopped && !music.is_silent;
    if (is_held || rested > (cause == Cause::ending ? kLongestEnding : kLongestStop)) {
        const bool bows = cause == Cause::ending && !is_held;
        settle(music.time);
        if (bows) {
            bows_at = music.time + kBowAfter;
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

/// Begins at the bar line that was just passed: from standing, or in the place of another dance.
void Dancer::State::begin(const MusicState& music, bool is_turned) noexcept {
    const Beats now = music.grid.beats_at(music.time);
    const bool was_dancing = is_dancing;
    is_dancing = true;
    bars_unwanted = 0;
    figure_rested = ~0ULL;
    // Count 1 lies on the downbeat itself, which may be a few hops ago.
    phase.start(music.grid, now - Beats(music.grid.bar_position(now)), metre, music.time);
    pace = phase.rate() / content().metre.learnt_tempo.beats_per_second();
    sequence.set_tempo(Bpm(60.0 * phase.rate()));
    sequence.start(content(), stage, part, is_turned);
    delay = sequence.figure().landing_delay;
    if (!was_dancing) {
        phrases.begin(music.grid, music.time);
    }
    change(music.time);
}

// Late members of a canon let bars_to_wait bar lines pass.
void Dancer::State::start_at_line(const MusicState& music) noexcept {
    const DanceId next = wanted(music.genre);
    if (!is_at_line) {
        return;
    }
    if (bars_to_wait > 0) {
        --bars_to_wait;
    } else if (next != DanceId::none) {
        if (next != genre) {
            take_up(next);
        }
        begin(music, stands_turned);
    }
}

/// Goes over to the dance that is wanted, at a bar line: the feet go on with its steps. A dancer
/// who is turned away dances on for a while, to turn to the front by a figure, then settles there.
void Dancer::State::leave(const MusicState& music) noexcept {
    const DanceId next = wanted(music.genre);
    if (next == DanceId::none) {
        settle(music.time);
        return;
    }
    const bool is_turned = sequence.is_turned();
    const DanceLibrary* const other = repertoire->of(next);
    FigureSequence begun;
    begun.start(other->content(), stage, part, part.is_in_couple && is_turned);
    const double turn = std::remainder(
        floor_frame(begun.at(Beats(0.0))).heading - floor_frame(shown).heading, 2.0 * M_PI);
    if (std::abs(turn) > kTurnsOver || is_free()) {
        if (++bars_unwanted > kMostBarsUnwanted) {
            settle(music.time);
        }
        return;
    }
    take_up(next);
    begin(music, part.is_in_couple && is_turned);
}

void Dancer::State::settle(StreamTime now) noexcept {
    is_dancing = false;
    is_after_line = false;
    bars_to_wait = part.bars_late;
    bars_unwanted = 0;
    bows_at.reset();
    still.reset();
    for (const Side side : kSides) {
        hands.let_go(side, now, kHandsBack);
    }
    // A soloist settles facing the audience; one of a couple stays where the dance has led.
    stands_turned = part.is_in_couple && sequence.is_turned();
    standing.settle(skeleton, shown, shown_before, floor_frame(shown), place(), now);
    change(now);
}

/// Thanks the audience, with a hand before the belly.
void Dancer::State::bow(StreamTime now) noexcept {
    if (!bows_at || now < *bows_at) {
        return;
    }
    if (now < *bows_at + nanos_from_seconds(kBowSeconds)) {
        hands.go_to(Side::right, HandPlace::belly, now, kHandsToRest);
    } else {
        hands.let_go(Side::right, now, kHandsBack);
        bows_at.reset();
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
        const bool ends = comes(music.ahead.ends) || (next.kind == Kind::end && comes(next.time));
        if (ends || (next.kind == Kind::stop && comes(next.time))) {
            stand_still(music, ends ? Cause::ending : Cause::stop, kNearestKey, kFarthestKey);
            return true;
        }
    }
    if (music.event.kind == Kind::stop || music.event.kind == Kind::end) {
        stand_still(music, Cause::stop, kNearestKey, kFarthestKey);
        return true;
    }
    return false;
}

/// Pauses at the end of a phrase, if the draw for this phrase says so and a figure ends with it:
/// where the figure leaves both feet standing for long enough; at the last moment anywhere, and
/// steps are left out.
bool Dancer::State::pause_at_phrase_end(const MusicState& music) noexcept {
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

/// Begins to stand still in the calmest posture between two phases, in beats from the one shown.
void Dancer::State::stand_still(const MusicState& music,
                                Cause why,
                                double earliest,
                                double latest) noexcept {
    const Beats from = shown_phase(music.time, Nanos(0));
    // Both of a couple stop at the same moment of their figure.
    const Beats key = part.is_in_couple
                          ? from + Beats(0.5 * (earliest + latest))
                          : key_moment(sequence, from + Beats(earliest), from + Beats(latest));
    cause = why;
    still.begin(music.time, from, phase.rate(), key);
    show_pose(music.time);
}

/// Leads the arms to a posture that looks meant. One of a couple keeps the other's hands.
void Dancer::State::show_pose(StreamTime now) noexcept {
    if (part.is_in_couple) {
        return;
    }
    const CounterRandom random(part.seed, kPoseStream);
    const std::uint64_t draw = random.below(sequence.number(), kArmPostures.size());
    const ArmPosture& posture = kArmPostures[static_cast<std::size_t>(draw)];
    const std::array<std::optional<HandPlace>, 2> places = {posture.left, posture.right};
    for (const Side side : kSides) {
        if (const auto& place = places[static_cast<std::size_t>(side)]) {
            hands.go_to(side, *place, now, kHandsToPose);
        }
    }
}

/// Dances on where the dance has come to unseen.
void Dancer::State::resume(const MusicState& music) noexcept {
    still.end();
    figure_rested = ~0ULL;
    for (const Side side : kSides) {
        hands.let_go(side, music.time, kHandsBack);
    }
    change(music.time);
}

/// Lets a hand rest for a figure, more often in calm music.
void Dancer::State::rest_hands(const MusicState& music) noexcept {
    if (figure_rested == sequence.number() || part.is_in_couple) {
        return;
    }
    figure_rested = sequence.number();
    const DanceHabits& habits = content().chooser.habits();
    const CounterRandom random(part.ways, kRestStream);
    const double calm = 1.5 - static_cast<double>(manner.energy());
    for (const Side side : kSides) {
        const std::uint64_t draw = 4 * figure_rested + 2 * static_cast<std::uint64_t>(side);
        if (random.uniform(draw) < habits.rests * calm) {
            const std::uint64_t place = random.below(draw + 1, habits.rest_at.size());
            hands.go_to(
                side, habits.rest_at[static_cast<std::size_t>(place)], music.time, kHandsToRest);
        } else {
            hands.let_go(side, music.time, kHandsToRest);
        }
    }
}

}  // namespace raks::motion
