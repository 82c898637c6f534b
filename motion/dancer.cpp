#include "motion/dancer.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "motion/dancer_state.hpp"

namespace raks::motion {

/// A user's request, at its time.
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
        case DancerCommand::Kind::forbid_dance:
        case DancerCommand::Kind::allow_dance:
            allow(command.value, command.kind == DancerCommand::Kind::allow_dance);
            break;
        case DancerCommand::Kind::hold:
            is_held = true;
            break;
        case DancerCommand::Kind::release:
            is_held = false;
            break;
    }
}

void Dancer::State::allow(double number, bool is_allowed) noexcept {
    if (number >= 0.0 && number < static_cast<double>(kMostDances)) {
        forbidden.set(static_cast<std::size_t>(number), !is_allowed);
    }
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
                               std::uint64_t seed,
                               Dynamics dynamics) {
    if (!library) {
        return fail("the dancer has no dance: a library is missing");
    }
    DancerPart part;
    part.seed = part.ways = seed;
    part.dynamics = dynamics;
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
    state.is_first_hop = state.last_hop < 0;
    state.last_hop = music.hop;
    state.commands.run_due(music.time, [&](const DancerCommand& command) { state.apply(command); });
    state.decide(music);
    state.look_on(music.time);
    state.feel(music);
    const Pose pose = state.smoothed(
        music.time, Nanos(0), state.next(music.time, Nanos(0), state.feet, state.looks));
    state.shown_before = state.shown;
    state.shown = pose;
    state.note_swings();
    track.append_final(music.hop, pose, state.feelings.now());
    PlantedFeet feet = state.feet;
    Looks looks = state.looks;
    for (int i = 1; i <= PoseTrack::kPredictedPoses; ++i) {
        const Nanos ahead = i * kHop;
        looks.go_on();
        const Pose predicted = state.next(music.time, ahead, feet, looks);
        track.set_predicted(i, state.smoothed(music.time, ahead, predicted));
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
    status.is_mirrored = state.sequence.is_mirrored();
    status.octave = state.phase.octave() / state.sequence.stretch();
    status.rate = state.phase.rate() / state.sequence.stretch();
    status.reanchors = state.reanchors;
    return status;
}

}  // namespace raks::motion
