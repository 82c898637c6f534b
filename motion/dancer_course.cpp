// What the dancer decides at each hop: to begin, to dance on, to stand still, to change, to settle.
#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "motion/dancer_state.hpp"

namespace raks::motion {
namespace {

constexpr int kHopsToStart = 35;      // of sure music before the first step
constexpr double kLeastDance = 2.0;   // bars that a known song must still have for a start
constexpr int kHopsToStop = 150;      // of unsure music before settling (1.5 s)
constexpr double kLineWindow = 0.5;   // beats: how late after a bar line one may still start
constexpr double kPaceShare = 0.01;   // a hop; smooths the pace over about a second
constexpr double kLeadShare = 0.01;   // a hop; another figure's lead takes about a second
constexpr float kFeltShare = 0.02F;   // a hop; a beat is felt within about half a second
constexpr int kMostBarsUnwanted = 1;  // that a dance is danced on to turn to the front
constexpr double kLastBeat = 1.0;     // of a figure: no step lands in it
constexpr double kTurnsOver = 1.75;   // radians: more is not turned within a step

constexpr double kRiseInPhrase = 0.3;  // of the energy, from its middle to its end

// Of a dance that is come into in its midst: bars that are danced unseen before, more by one where
// count 1 of a figure of two bars lies a bar earlier; and beats from one look at what comes next to
// another.
constexpr int kBarsUnseen = 2;
constexpr double kUnseenStep = 0.125;

/// Whether it is worth while to begin: a known song must have begun, and must have some bars left.
bool may_begin(const MusicState& music) noexcept {
    constexpr Nanos kRounding = std::chrono::milliseconds(20);
    const double least =
        kLeastDance * music.grid.beats_per_bar * music.grid.tempo.seconds_per_beat();
    return !music.ahead.is_known || (music.time >= music.ahead.begins - kRounding &&
                                     to_seconds(music.ahead.ends - music.time) >= least);
}

/// Whether a known song is in its midst: where the dance would have begun already, or in its first
/// bar, of which the beginning is cut off.
bool is_in_midst(const MusicState& music) noexcept {
    const double bar = music.grid.beats_per_bar * music.grid.tempo.seconds_per_beat();
    const double left = to_seconds(music.ahead.ends - music.time);
    return music.ahead.is_known && music.part != MusicPart::stopped && left >= kLeastDance * bar &&
           to_seconds(music.ahead.begins - music.time) < bar;
}

/// Whether a known song ends so soon that a pause would be its end.
bool ends_soon(const MusicState& music) noexcept {
    constexpr double kSoon = 5.0;  // beats
    return music.ahead.is_known &&
           to_seconds(music.ahead.ends - music.time) < kSoon * music.grid.tempo.seconds_per_beat();
}

/// Whether the beat goes on though it is hardly heard: while its band leaves for a while, and in a
/// song that is known. The grid is danced on then.
bool goes_on_unsurely(const MusicState& music) noexcept {
    return music.ahead.is_known || music.part == MusicPart::breakdown ||
           music.part == MusicPart::build_up;
}

}  // namespace

/// The dance for music of genre `heard`, unless it is forbidden; a selected dance comes first.
/// None: stand.
DanceId Dancer::State::wanted(DanceId recognized) const noexcept {
    const auto is_known = [&](DanceId one) {
        return one != DanceId::none && repertoire->of(one) != nullptr;
    };
    const auto is_allowed = [&](DanceId one) { return is_known(one) && !forbidden[index_of(one)]; };
    if (is_known(selected)) {
        return selected;
    }
    if (is_allowed(recognized)) {
        return recognized;
    }
    const DanceId nearest = repertoire->nearest(
        grid.tempo, grid.beats_per_bar, is_dancing ? genre : DanceId::none, forbidden);
    switch (repertoire->otherwise()) {
        case Repertoire::Fallback::first:
            return nearest;
        case Repertoire::Fallback::keep:
            return genre == DanceId::none || is_allowed(genre) ? genre : nearest;
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
    manner.hear(music.event);
    listener.hear(music);
    if (!still.is_on()) {
        manner.advance(music);
        if (is_dancing && has_dynamics()) {
            hits.advance(music, manner.manner().body);
        }
    }
    if (!is_dancing && has_dynamics()) {
        idle.lead_hands(music.time, hands);
    }
    if (is_dancing) {
        go_on(music);
        // What is known needs no second look.
    } else if (is_first_hop && !is_held && is_in_midst(music)) {
        come_in(music);
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
    bool has_reanchored = phase.advance(music.grid, metre, sequence.end(), music.time);
    // With dynamics the dancer waits for the bar (dancer_stillness.cpp).
    if (phase.beats_off_bar() != 0 && !has_dynamics() &&
        (sequence.end() - phase.phase()).count() <= kLastBeat) {
        phase.take_bar();
        has_reanchored = true;
    }
    sequence.set_tempo(Bpm(pace * 60.0 * own_rate));
    advance_sequence(music, has_reanchored);
    delay += nanos_from_seconds(kLeadShare * to_seconds(sequence.figure().landing_delay - delay));
    if (still.is_on()) {
        stay_still(music);
    } else {
        dance_on(music, has_reanchored);
    }
    if (is_dancing && has_dynamics()) {
        shape_hands(music);
    }
}

// Figures go on unseen while the dancer stands still; cells go on from there.
void Dancer::State::advance_sequence(const MusicState& music, bool has_reanchored) noexcept {
    if (sequence.is_of_cells() && still.is_on()) {
        return;
    }
    if (has_reanchored) {
        sequence.jump(phase.phase());
    }
    if (sequence.is_of_cells()) {
        asked = listener.asked(music, {phase, manner, phrases, part.seed, has_dynamics()});
        sequence.advance(phase.phase(), asked, wish);
    } else {
        sequence.advance(phase.phase(), energy_of_next(music), wish);
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
    const bool is_lost = hops_unsure > kHopsToStop;
    const bool is_halted = is_held || (is_lost && !music.is_silent);
    if (!is_halted && has_dynamics() && stop_with(music)) {
        return;
    }
    if (is_halted || is_lost || (music.ahead.is_known && music.time >= music.ahead.ends)) {
        settle(music.time);
    } else if (is_unwanted && is_at_line) {
        leave(music);
    } else if (has_dynamics() && (wait_for_bar(music) || (!is_unwanted && !ends_soon(music) &&
                                                          pause_at_phrase_end(music)))) {
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

/// Begins at the bar line that was just passed: from standing, or in the place of another dance.
void Dancer::State::begin(const MusicState& music, bool is_turned) noexcept {
    begin_bars_ago(music, is_turned, 0);
    change(music.time);
}

/// The same as if it had begun some bars before. Nothing leads over from what was shown.
void Dancer::State::begin_bars_ago(const MusicState& music, bool is_turned, int bars) noexcept {
    const Beats now = music.grid.beats_at(music.time);
    const double into = music.grid.bar_position(now) + bars * music.grid.beats_per_bar;
    const bool was_dancing = is_dancing;
    is_dancing = true;
    bars_unwanted = 0;
    figure_rested = ~0ULL;
    // Count 1 lies on the downbeat itself, which may be a few hops ago.
    phase.start(music.grid, now - Beats(into), metre, music.time);
    pace = phase.rate() / content().metre.learnt_tempo.beats_per_second();
    sequence.set_tempo(Bpm(60.0 * phase.rate()));
    sequence.start(content(), stage, part, is_turned);
    listener.begin();
    delay = sequence.figure().landing_delay;
    if (!was_dancing) {
        release_hands(music.time, kHandsBack);
        phrases.begin(music.grid, music.time);
    }
}

/// Comes into a song that is in its midst: the first pose is danced already, as if the dance had
/// begun with the song.
void Dancer::State::come_in(const MusicState& music) noexcept {
    const DanceId next = wanted(music.genre);
    const int bars = std::max(0, music.ahead.bar) - bars_to_wait;
    if (next == DanceId::none || bars < 0) {
        bars_to_wait = -bars;
        return;
    }
    bars_to_wait = 0;
    if (next != genre) {
        take_up(next);
    }
    const int unseen = std::min(bars, kBarsUnseen + bars % 2);
    begin_bars_ago(music, stands_turned, unseen);
    const Beats line = music.grid.beats_at(music.time) -
                       Beats(music.grid.bar_position(music.grid.beats_at(music.time)));
    phrases.begin(
        music.grid,
        music.grid.time_of(line - Beats((bars % Phrases::kBars) * music.grid.beats_per_bar)));
    const double energy = static_cast<double>(music.ahead.energy);
    CellMusic plain;
    plain.energy = energy;
    FigureWish nothing;
    const double there = phase.phase().count();
    for (double unseen_phase = 0.0; unseen_phase < there; unseen_phase += kUnseenStep) {
        if (sequence.is_of_cells()) {
            sequence.advance(Beats(unseen_phase), plain, nothing);
        } else {
            sequence.advance(Beats(unseen_phase), energy, nothing);
        }
    }
    shown_before = target(music.time, -2 * kHop);
    shown = target(music.time, -kHop);
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
    DanceSequence begun;
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
    still.reset();
    release_hands(now, kHandsBack);
    for (const Side side : kSides) {
        fingers.take(side, HandShape::danced, now, shown);
    }
    idle.begin(now, content().chooser.habits(), part.ways + ++settled);
    // A soloist settles facing the audience; one of a couple stays where the dance has led.
    stands_turned = part.is_in_couple && sequence.is_turned();
    standing.settle(skeleton, shown, shown_before, floor_frame(shown), place(), now);
    change(now);
}

}  // namespace raks::motion
