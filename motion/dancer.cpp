#include "motion/dancer.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "base/timed_commands.hpp"
#include "motion/dance/beat_phase.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/dance/figure_sequence.hpp"
#include "motion/dance/inertialization.hpp"
#include "motion/dance/standing.hpp"
#include "motion/library_content.hpp"
#include "motion/repertoire.hpp"

namespace raks::motion {
namespace {

// Confidence of the beat grid below which the dance may end; lower than that from which it
// begins, so that a dip does not end it.
constexpr float kStopConfidence = 0.10F;
constexpr int kHopsToStart = 60;            // of sure music before the first step (0.6 s)
constexpr double kLeastDance = 2.0;         // bars that a known song must still have for a start
constexpr int kHopsToStop = 150;            // of unsure music or silence before settling (1.5 s)
constexpr double kDownbeatWindow = 0.5;     // beats: how late after a downbeat one may still start
constexpr double kEarliestToSettle = 0.15;  // seconds sooner than a change of dance needs
// Seconds, times 1 - 1 / pace: how much later the mean landing comes at another pace (`raks eval
// dance`, salsa, lead and follow, paces 0.70 to 1.41).
constexpr double kLandingLeadByPace = 0.06;
// Limit of the lead that a figure asks for
constexpr Nanos kMostLandingLead = std::chrono::milliseconds(60);
constexpr double kLeadShare = 0.01;  // a hop; another figure's lead is reached in about a second
constexpr double kPaceShare = 0.01;  // a hop; smooths the pace over about a second

/// How far ahead of the phase the pose is read, so that landings fall on the beat. `delay`: how
/// late the figure's steps come down at the learnt tempo. A landing is detected where a foot falls
/// under a fixed speed, whatever the tempo, so in a dance faster than learnt it is found later in
/// the last slowing of a step.
Nanos landing_lead(Nanos delay, double pace) noexcept {
    return std::clamp(delay, -kMostLandingLead, kMostLandingLead) +
           nanos_from_seconds(kLandingLeadByPace * (1.0 - 1.0 / std::clamp(pace, 0.6, 1.6)));
}

/// Move from a figure's start to where this dancer stands on the stage.
FloorMove stage_of(const DanceContent& content, const DancerPart& part) {
    FloorMove stage = part.is_in_couple ? content.couple : content.stage;
    stage.offset.x += part.aside;
    return stage;
}

/// Whether a song that is known has no more to dance to.
bool is_over(const MusicState& music) noexcept {
    return music.ahead.is_known && music.time >= music.ahead.ends;
}

/// Whether it is worth while to begin: a known song must have some bars left.
bool may_begin(const MusicState& music) noexcept {
    const double least =
        kLeastDance * music.grid.beats_per_bar * music.grid.tempo.seconds_per_beat();
    return !music.ahead.is_known || to_seconds(music.ahead.ends - music.time) >= least;
}

/// The metre of a dance; in a couple the mean period of both, so that both change octave at once.
DanceMetre metre_of(const DanceContent& content, const DanceLibrary* partner) {
    DanceMetre metre = content.metre;
    if (partner != nullptr) {
        const Bpm other = partner->content().metre.learnt_tempo;
        metre.learnt_tempo = Bpm::from_period(
            0.5 * (metre.learnt_tempo.seconds_per_beat() + other.seconds_per_beat()));
    }
    return metre;
}

}  // namespace

/// How far a dance has come: what another dancer can go on from.
struct Dancer::Course {
    DanceId genre = DanceId::none;     // of what is danced, or was last
    DanceId selected = DanceId::none;  // by command
    int bars_to_wait = 0;              // downbeats that still pass before the start
    FigureSequence sequence;
    FigureWish wish;
    MusicEnergy energy;
    bool stands_turned = false;  // half a turn from where the first dance began: couples
    Standing standing;

    bool is_dancing = false;
    bool is_held = false;       // by command, until release
    bool was_downbeat = false;  // at the last hop that might have begun
    int hops_sure = 0;          // consecutive hops above BeatGrid::kDanceable
    int hops_unsure = 0;        // consecutive hops of silence or below kStopConfidence
    DancePhase phase;
    double pace = 1.0;  // danced tempo / learnt tempo, smoothed over about a second
    Nanos delay{};      // landing delay of the figure, smoothed over about a second
    std::uint32_t reanchors = 0;

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
    void decide(const MusicState& music) noexcept;
    void go_on(const MusicState& music) noexcept;
    void start_on_downbeat(const MusicState& music) noexcept;
    [[nodiscard]] DanceId wanted(DanceId recognized) const noexcept;
    [[nodiscard]] bool leaves(const MusicState& music) const noexcept;
    void settle(StreamTime now) noexcept;
    void change(StreamTime now) noexcept;
    [[nodiscard]] Pose target(StreamTime time, Nanos ahead) const noexcept;
    [[nodiscard]] Pose smoothed(StreamTime now, Nanos ahead) const noexcept;
};

/// Changes to another dance, which is danced from the next start. Wishes name figures of the old
/// one by number, so they are dropped.
void Dancer::State::take_up(DanceId other) noexcept {
    find(other);
    wish = FigureWish();
}

void Dancer::State::find(DanceId other) noexcept {
    genre = other;
    dance = repertoire->of(other);
    stage = stage_of(content(), part);
    metre = metre_of(content(), part.partner ? part.partner->of(other) : nullptr);
}

/// The same figure at the same beat, as this repertoire has it. The difference between both bodies'
/// poses decays like that of any change.
void Dancer::State::go_on_from(const State& before) noexcept {
    static_cast<Course&>(*this) = before;
    if (repertoire->of(before.genre) == nullptr) {
        // A dance that is not solved yet: from standing, where the other one was.
        take_up(repertoire->first());
        is_dancing = false;
        standing.stand(place());
    } else {
        find(before.genre);
        sequence.go_on_in(content(), stage);
    }
    if (last_hop >= 0) {
        changed_at = time_of_hop(last_hop);
        smoothing.start(
            shown, shown_before, target(changed_at, Nanos(0)), target(changed_at, -kHop));
    }
}

/// Where the dancer stands while nothing is danced: a soloist always at the same place, facing the
/// audience; one of a couple where the dance has ended.
FloorMove Dancer::State::place() const noexcept {
    return floor_of(content(), stage, stands_turned) * inverse(content().stage);
}

void Dancer::State::reset() noexcept RAKS_NONBLOCKING {
    selected = DanceId::none;
    take_up(repertoire->first());
    sequence = FigureSequence();
    energy.reset();
    stands_turned = false;
    standing.stand(place());
    bars_to_wait = part.bars_late;
    is_dancing = is_held = false;
    hops_sure = hops_unsure = 0;
    phase = DancePhase();
    pace = 1.0;
    delay = Nanos(0);
    reanchors = 0;
    smoothing.clear();
    shown = shown_before = standing.at(skeleton, StreamTime{});
    last_hop = -1;
    commands.clear();
}

void Dancer::State::apply(const DancerCommand& command) noexcept {
    switch (command.kind) {
        case DancerCommand::Kind::next_figure:
            wish.is_another = true;
            break;
        case DancerCommand::Kind::select_figure:
            if (command.value >= 0.0 &&
                command.value < static_cast<double>(content().figures.size())) {
                wish.figure = static_cast<std::size_t>(command.value);
            }
            break;
        case DancerCommand::Kind::lock_figure:
            wish.is_locked = command.value != 0.0;
            break;
        case DancerCommand::Kind::select_dance:
            if (command.value >= 0.0 && command.value <= static_cast<double>(DanceId::none)) {
                selected = static_cast<DanceId>(command.value);
            }
            break;
        case DancerCommand::Kind::hold:
            is_held = true;
            break;
        case DancerCommand::Kind::release:
            is_held = false;
            break;
    }
}

/// The pose before inertialization, `ahead` of the hop at `time`.
Pose Dancer::State::target(StreamTime time, Nanos ahead) const noexcept {
    if (is_dancing) {
        return sequence.at(phase.phase_after(ahead + landing_lead(delay, pace)));
    }
    return standing.at(skeleton, time + ahead);
}

// The pose with what is left of the last change; feet are planted once more, since joint rotations
// and hips decay independently of one another.
Pose Dancer::State::smoothed(StreamTime now, Nanos ahead) const noexcept {
    Pose pose = smoothing.apply(target(now, ahead), now + ahead - changed_at);
    if (!smoothing.is_active(now + ahead - changed_at)) {
        return pose;
    }
    if (!is_dancing) {
        standing.plant(skeleton, now + ahead, pose);
    } else if (content().generator == Generator::trajectories) {
        // Hips and legs decay apart, which may push a sole below the floor
        lift_feet(skeleton, pose);
    }
    return pose;
}

/// The motion changes at this hop. The difference between what was shown and the new target is
/// measured one and two hops ago, where both are known, and decays from there.
void Dancer::State::change(StreamTime now) noexcept {
    changed_at = now - kHop;
    smoothing.start(shown, shown_before, target(now, -kHop), target(now, -2 * kHop));
}

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

/// Whether to leave this dance for another one now: so that the dancer stands settled on the next
/// bar line, at most kEarliestToSettle before it. A bar shorter than settling is left at once.
bool Dancer::State::leaves(const MusicState& music) const noexcept {
    if (wanted(music.genre) == genre) {
        return false;
    }
    const double beat = music.grid.tempo.seconds_per_beat();
    const double bar = music.grid.beats_per_bar * beat;
    const double left = bar - beat * music.grid.bar_position(music.grid.beats_at(music.time));
    const double needed = to_seconds(Standing::duration(floor_frame(shown), place()));
    return bar < needed + kEarliestToSettle ||
           (left >= needed && left <= needed + kEarliestToSettle);
}

void Dancer::State::settle(StreamTime now) noexcept {
    is_dancing = false;
    was_downbeat = false;
    bars_to_wait = part.bars_late;
    // A soloist settles facing the audience; one of a couple stays where the dance has led.
    stands_turned = part.is_in_couple && sequence.is_turned();
    standing.settle(skeleton, shown, shown_before, floor_frame(shown), place(), now);
    change(now);
}

/// The state machine of one hop: starts on a downbeat, dances on, or settles.
void Dancer::State::decide(const MusicState& music) noexcept {
    const bool is_sure = !music.is_silent && music.grid.confidence >= BeatGrid::kDanceable;
    const bool is_unsure = music.is_silent || music.grid.confidence < kStopConfidence;
    hops_sure = is_sure ? hops_sure + 1 : 0;
    hops_unsure = is_unsure ? hops_unsure + 1 : 0;
    energy.advance(music);
    if (is_dancing) {
        go_on(music);
        // What is known needs no second look.
    } else if (is_held || hops_sure < (music.ahead.is_known ? 1 : kHopsToStart) ||
               !standing.is_settled(music.time) || !may_begin(music)) {
        was_downbeat = false;
    } else {
        start_on_downbeat(music);
    }
}

// One hop of dancing. The order matters: the phase first, then what follows from it.
void Dancer::State::go_on(const MusicState& music) noexcept {
    const double own_rate = content().metre.learnt_tempo.beats_per_second();
    // Smoothed, since the phase's rate also holds its corrections.
    pace += kPaceShare * (phase.rate() / own_rate - pace);
    const bool has_reanchored = phase.advance(music.grid, metre, sequence.end(), music.time);
    if (has_reanchored) {
        sequence.jump(phase.phase());
    }
    sequence.set_tempo(Bpm(pace * 60.0 * own_rate));
    sequence.advance(phase.phase(), energy.value(), wish);
    delay += nanos_from_seconds(kLeadShare * to_seconds(sequence.figure().landing_delay - delay));
    if (is_held || hops_unsure > kHopsToStop || is_over(music) || leaves(music)) {
        settle(music.time);
    } else if (has_reanchored) {
        ++reanchors;
        change(music.time);
    }
}

// Starts within kDownbeatWindow after a downbeat. Late members of a canon let bars_to_wait
// downbeats pass.
void Dancer::State::start_on_downbeat(const MusicState& music) noexcept {
    const Beats now = music.grid.beats_at(music.time);
    const double since_downbeat = music.grid.bar_position(now);
    const bool is_downbeat = since_downbeat < kDownbeatWindow;
    const DanceId next = wanted(music.genre);
    if (is_downbeat && !was_downbeat && bars_to_wait > 0) {
        --bars_to_wait;
    } else if (is_downbeat && !was_downbeat && next != DanceId::none) {
        if (next != genre) {
            take_up(next);
        }
        is_dancing = true;
        // Count 1 lies on the downbeat itself, which may be a few hops ago.
        phase.start(music.grid, now - Beats(since_downbeat), metre, music.time);
        pace = phase.rate() / content().metre.learnt_tempo.beats_per_second();
        sequence.set_tempo(Bpm(60.0 * phase.rate()));
        sequence.start(content(), stage, part, stands_turned);
        delay = sequence.figure().landing_delay;
        change(music.time);
    }
    was_downbeat = is_downbeat;
}

Dancer::Dancer() : state_(std::make_unique<State>()) {}
Dancer::~Dancer() = default;
Dancer::Dancer(Dancer&&) noexcept = default;
Dancer& Dancer::operator=(Dancer&&) noexcept = default;

Expected<void> Dancer::prepare(std::shared_ptr<const Repertoire> repertoire,
                               const Skeleton& skeleton,
                               const DancerPart& part) {
    if (!repertoire) {
        return fail("the dancer has no dance: a repertoire is missing");
    }
    state_ = std::make_unique<State>();
    state_->repertoire = std::move(repertoire);
    state_->skeleton = skeleton;
    state_->part = part;
    state_->reset();
    return {};
}

Expected<void> Dancer::prepare(std::shared_ptr<const DanceLibrary> library,
                               const Skeleton& skeleton,
                               std::uint64_t seed) {
    if (!library) {
        return fail("the dancer has no dance: a library is missing");
    }
    DancerPart part;
    part.seed = part.ways = seed;
    return prepare(Repertoire::of_one(std::move(library)), skeleton, part);
}

void Dancer::advance(const MusicState& music, PoseTrack& track) noexcept RAKS_NONBLOCKING {
    const FlushToZeroScope flush_to_zero;
    State& state = *state_;
    if (state.dance == nullptr) {
        return;
    }
    if (state.last_hop >= 0 && music.hop != state.last_hop + 1) {
        track.clear();
    }
    state.last_hop = music.hop;
    state.commands.run_due(music.time, [&](const DancerCommand& command) { state.apply(command); });
    state.decide(music);
    const Pose pose = state.smoothed(music.time, Nanos(0));
    state.shown_before = state.shown;
    state.shown = pose;
    track.append_final(music.hop, pose);
    for (int ahead = 1; ahead <= PoseTrack::kPredictedPoses; ++ahead) {
        track.set_predicted(ahead, state.smoothed(music.time, ahead * kHop));
    }
}

void Dancer::command(const DancerCommand& command) noexcept RAKS_NONBLOCKING {
    state_->commands.push(command);
}

void Dancer::reset() noexcept RAKS_NONBLOCKING {
    if (state_->dance != nullptr) {
        state_->reset();
    }
}

void Dancer::go_on_from(const Dancer& before) noexcept RAKS_NONBLOCKING {
    if (state_->dance != nullptr && before.state_->dance != nullptr) {
        state_->go_on_from(*before.state_);
    }
}

const Pose& Dancer::shown() const noexcept { return state_->shown; }

DancerStatus Dancer::status() const noexcept RAKS_NONBLOCKING {
    DancerStatus status;
    const State& state = *state_;
    if (state.dance == nullptr || !state.is_dancing) {
        status.reanchors = state.reanchors;
        return status;
    }
    const LibraryFigure& figure = state.sequence.figure();
    const std::size_t length = std::min(figure.name.size(), status.figure.size() - 1);
    std::memcpy(status.figure.data(), figure.name.data(), length);
    status.is_dancing = true;
    status.dance = state.genre;
    status.number = static_cast<std::uint32_t>(state.sequence.number());
    status.phase = std::clamp(state.sequence.beat(state.phase.phase()), 0.0, figure.beats - 1e-9);
    status.count = static_cast<int>(status.phase) + 1;
    status.counts = figure.beats;
    status.octave = state.phase.octave();
    status.rate = state.phase.rate();
    status.reanchors = state.reanchors;
    return status;
}

}  // namespace raks::motion
