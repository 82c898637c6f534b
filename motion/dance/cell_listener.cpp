#include "motion/dance/cell_listener.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "base/time.hpp"

namespace raks::motion {
namespace {

constexpr double kFeltSeconds = 0.8;      // time constant of the energy that is felt
constexpr double kLiftShare = 0.9;        // of what is left to the greatest cells, after a drop
constexpr double kLiftLasts = 2.0;        // so many times a lift counts, up to 1
constexpr double kBreakdownShare = 0.1;   // of the cells: those that suit a breakdown at most
constexpr double kEventsAhead = 12.0;     // beats in which events are looked for
constexpr double kRestBeats = 2.0;        // of a rest at the end of a phrase
constexpr double kRestShare = 0.7;        // of the phrases that end in a rest
constexpr double kHalfRestShare = 0.4;    // of those that have one in their middle
constexpr double kLivelyRest = 0.2;       // energy from which phrases end in rests
constexpr double kNearLine = 0.2;         // beats about a bar line in which bars may be told apart
constexpr double kRoundedUp = 0.25;       // beats before a beat that are on it
constexpr double kStillDue = 0.1;         // beats
constexpr std::uint64_t kRestDraws = 41;  // stream of random numbers

/// The phase of the dance at a time.
double phase_at(const MusicState& music, const DancePhase& phase, StreamTime time) noexcept {
    const Beats beats = music.grid.beats_at(time) - music.grid.beats_at(music.time);
    return phase.phase().count() + phase.octave() * beats.count();
}

}  // namespace

void CellListener::hear(const MusicState& music) noexcept RAKS_NONBLOCKING {
    const double share = 1.0 - std::exp(-to_seconds(kHop) / kFeltSeconds);
    felt_ += share * (static_cast<double>(music.energy.now) - felt_);
    using Kind = MusicEvent::Kind;
    has_come_in_ =
        has_come_in_ || music.event.kind == Kind::drop || music.event.kind == Kind::entry;
    if (music.event.kind == Kind::drop) {
        dropped_ = music.event.time;
    }
    if (!music.is_silent && music.part != MusicPart::stopped) {
        range_.hear(music.energy.now);
    }
}

CellMusic CellListener::asked(const MusicState& music,
                              const CellMoment& moment) noexcept RAKS_NONBLOCKING {
    CellMusic asked;
    asked.energy = energy_of(music, moment);
    if (moment.has_dynamics) {
        look_at_drop(music, moment, asked);
        look_at_phrase(music, moment, asked);
    }
    look_at_song(music, moment, asked);
    return asked;
}

// What is decided now is danced in one to three beats. A song that is known tells the energy about
// then; else it is held to go on as it is.
double CellListener::energy_of(const MusicState& music, const CellMoment& moment) const noexcept {
    double felt = felt_;
    if (music.ahead.is_known) {
        felt = 0.5 * (felt + static_cast<double>(music.energy.lately));
    }
    if (!moment.has_dynamics) {
        return range_.share_below(felt);
    }
    double share = range_.share_below(felt);
    const double lift = std::min(1.0, kLiftLasts * static_cast<double>(moment.manner.lift()));
    share += kLiftShare * lift * (1.0 - share);
    return music.part == MusicPart::breakdown ? std::min(share, kBreakdownShare) : share;
}

void CellListener::look_at_drop(const MusicState& music,
                                const CellMoment& moment,
                                CellMusic& asked) noexcept {
    using Kind = MusicEvent::Kind;
    const double now = moment.phase.phase().count();
    asked.has_come_in = has_come_in_ && !music.ahead.is_known;
    has_come_in_ = false;
    if (dropped_) {
        const double at = std::round(phase_at(music, moment.phase, *dropped_));
        asked.drop_at = now - at < kEventsAhead ? std::optional(at) : std::nullopt;
    }
    if (!music.ahead.is_known) {
        return;
    }
    for (const MusicEvent& event : music.ahead.events) {
        const double at = std::round(phase_at(music, moment.phase, event.time));
        if (event.kind == Kind::drop && at - now < kEventsAhead) {
            asked.drop_at = at;
        } else if ((event.kind == Kind::stop || event.kind == Kind::end) &&
                   at - now < kEventsAhead) {
            asked.rests_at = std::floor(phase_at(music, moment.phase, event.time) + kRoundedUp);
        }
        if (event.kind != Kind::none) {
            break;
        }
    }
}

// A phrase begins with another piece; the end of some, and the middle of some, is a rest.
void CellListener::look_at_phrase(const MusicState& music,
                                  const CellMoment& moment,
                                  CellMusic& asked) const noexcept {
    const double now = moment.phase.phase().count();
    const double bar = moment.phase.octave() * music.grid.beats_per_bar;
    const double begins = std::round(now + (Phrases::kBars - moment.phrases.bar()) * bar);
    asked.anew_at = begins;
    if (asked.rests_at || static_cast<double>(moment.manner.energy()) < kLivelyRest ||
        music.part == MusicPart::stopped) {
        return;
    }
    const CounterRandom random(moment.seed, kRestDraws);
    const double middle = begins - 0.5 * Phrases::kBars * bar - kRestBeats;
    const double end = begins - kRestBeats;
    const std::uint64_t draw = 2 * moment.phrases.number();
    if (middle > now - kStillDue && random.uniform(draw) < kHalfRestShare) {
        asked.rests_at = middle;
    } else if (end > now - kStillDue && random.uniform(draw + 1) < kRestShare) {
        asked.rests_at = end;
    }
}

// The bar that sounds is told anew at each hop; just about a bar line its number and its place may
// not agree, so that what was told before goes on.
void CellListener::look_at_song(const MusicState& music,
                                const CellMoment& moment,
                                CellMusic& asked) noexcept {
    if (!music.ahead.is_known || music.ahead.bar < 0) {
        song_.reset();
        return;
    }
    const double position = music.grid.bar_position(music.grid.beats_at(music.time));
    if (position > kNearLine && position < music.grid.beats_per_bar - kNearLine) {
        SongBars song;
        song.bar = music.ahead.bar;
        song.beats =
            static_cast<int>(std::lround(moment.phase.octave() * music.grid.beats_per_bar));
        song.begins = std::round(moment.phase.phase().count() - moment.phase.octave() * position);
        song.repeats = music.ahead.repeats;
        song_ = song;
    }
    asked.song = song_;
}

}  // namespace raks::motion
