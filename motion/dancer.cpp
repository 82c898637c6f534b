#include "motion/dancer.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "motion/dance/beat_phase.hpp"
#include "motion/dance/figure_cycle.hpp"
#include "motion/dance/idle.hpp"
#include "motion/dance/inertialization.hpp"
#include "motion/dance/leg_ik.hpp"
#include "motion/figures/figure_model.hpp"

namespace raks::motion {
namespace {

constexpr float kStartConfidence = 0.35F;
constexpr float kStopConfidence = 0.10F;
constexpr int kHopsToStart = 60;         // of sure music before the first step
constexpr int kHopsToStop = 150;         // of no music before settling
constexpr double kDownbeatWindow = 0.5;  // beats: how late after a downbeat one may still start
constexpr std::size_t kQueuedCommands = 16;

}  // namespace

struct DanceLibrary::Content {
    std::vector<FigureCycle> figures;
    Skeleton skeleton;
};

DanceLibrary::DanceLibrary(std::unique_ptr<const Content> content) : content_(std::move(content)) {}
DanceLibrary::~DanceLibrary() = default;

Expected<std::shared_ptr<const DanceLibrary>> DanceLibrary::build(
    std::span<const FigureModel> figures, const Skeleton& skeleton) {
    if (figures.empty()) {
        return fail("a dance needs at least one figure");
    }
    auto content = std::make_unique<Content>();
    content->skeleton = skeleton;
    for (const FigureModel& figure : figures) {
        if (auto valid = validate(figure); !valid) {
            return fail(figure.name + ": " + valid.error().message);
        }
        content->figures.emplace_back(figure, skeleton);
    }
    return std::shared_ptr<const DanceLibrary>(new DanceLibrary(std::move(content)));
}

struct Dancer::State {
    std::shared_ptr<const DanceLibrary> library;
    Skeleton skeleton;
    std::size_t figure = 0;
    std::size_t next_figure = 0;  // taken up when this one ends

    bool is_dancing = false;
    bool is_held = false;
    int hops_sure = 0;
    int hops_unsure = 0;
    DancePhase phase;
    std::uint32_t reanchors = 0;

    Inertialization smoothing;
    StreamTime changed_at{};
    Pose shown;         // the last final pose
    Pose shown_before;  // the one before it
    HopIndex last_hop = -1;

    std::array<DancerCommand, kQueuedCommands> commands{};
    std::size_t command_count = 0;

    [[nodiscard]] const FigureCycle& cycle() const noexcept {
        return library->content().figures[figure];
    }
    void reset() noexcept;
    void run_commands(StreamTime now) noexcept;
    void decide(const MusicState& music) noexcept;
    void change(StreamTime now) noexcept;
    [[nodiscard]] Pose target(StreamTime time, Nanos ahead) const noexcept;
    [[nodiscard]] Pose smoothed(StreamTime now, Nanos ahead) const noexcept;
};

void Dancer::State::reset() noexcept {
    figure = next_figure = 0;
    is_dancing = is_held = false;
    hops_sure = hops_unsure = 0;
    phase = DancePhase();
    reanchors = 0;
    smoothing.clear();
    shown = shown_before = idle_pose(skeleton, StreamTime{});
    last_hop = -1;
    command_count = 0;
}

void Dancer::State::run_commands(StreamTime now) noexcept {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < command_count; ++i) {
        const DancerCommand& command = commands[i];
        if (command.time > now) {
            commands[kept++] = command;
            continue;
        }
        const std::size_t count = library->content().figures.size();
        switch (command.kind) {
            case DancerCommand::Kind::next_figure:
                next_figure = (next_figure + 1) % count;
                break;
            case DancerCommand::Kind::select_figure:
                if (command.value >= 0.0 && command.value < static_cast<double>(count)) {
                    next_figure = static_cast<std::size_t>(command.value);
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
    command_count = kept;
}

/// The pose without smoothing, `ahead` of the hop at `time`.
Pose Dancer::State::target(StreamTime time, Nanos ahead) const noexcept {
    return is_dancing ? cycle().at(phase.phase_after(ahead)) : idle_pose(skeleton, time + ahead);
}

Pose Dancer::State::smoothed(StreamTime now, Nanos ahead) const noexcept {
    Pose pose = smoothing.apply(target(now, ahead), now + ahead - changed_at);
    if (smoothing.is_active(now + ahead - changed_at)) {
        lift_feet(skeleton, pose);  // hips and legs blend apart from one another
    }
    return pose;
}

/// What is danced changes at this hop: the difference to what was shown decays from here on.
void Dancer::State::change(StreamTime now) noexcept {
    changed_at = now - kHop;
    smoothing.start(shown, shown_before, target(now, -kHop), target(now, -2 * kHop));
}

/// Starts on a count 1, goes on, or settles.
void Dancer::State::decide(const MusicState& music) noexcept {
    const bool is_sure = !music.is_silent && music.grid.confidence >= kStartConfidence;
    const bool is_unsure = music.is_silent || music.grid.confidence < kStopConfidence;
    hops_sure = is_sure ? hops_sure + 1 : 0;
    hops_unsure = is_unsure ? hops_unsure + 1 : 0;
    if (is_dancing) {
        const double figures_before = std::floor(phase.phase().count() / cycle().beats());
        const bool has_reanchored = phase.advance(music.grid, cycle().learnt_tempo(), music.time);
        const bool is_figure_over =
            std::floor(phase.phase().count() / cycle().beats()) != figures_before;
        if (is_held || hops_unsure > kHopsToStop) {
            is_dancing = false;
            change(music.time);
        } else if (has_reanchored) {
            ++reanchors;
            change(music.time);
        } else if (is_figure_over && figure != next_figure) {
            figure = next_figure;
            change(music.time);
        }
        return;
    }
    if (is_held || hops_sure < kHopsToStart) {
        return;
    }
    const Beats now = music.grid.beats_at(music.time);
    const double since_downbeat = music.grid.bar_position(now);
    if (since_downbeat < kDownbeatWindow) {
        is_dancing = true;
        figure = next_figure;
        phase.start(music.grid, now - Beats(since_downbeat), cycle().learnt_tempo(), music.time);
        change(music.time);
    }
}

Dancer::Dancer() : state_(std::make_unique<State>()) {}
Dancer::~Dancer() = default;
Dancer::Dancer(Dancer&&) noexcept = default;
Dancer& Dancer::operator=(Dancer&&) noexcept = default;

Expected<void> Dancer::prepare(std::shared_ptr<const DanceLibrary> library,
                               const Skeleton& skeleton,
                               std::uint64_t /*seed*/) {
    if (!library) {
        return fail("the dancer has no dance: a library is missing");
    }
    state_ = std::make_unique<State>();
    state_->library = std::move(library);
    state_->skeleton = skeleton;
    state_->reset();
    return {};
}

void Dancer::advance(const MusicState& music, PoseTrack& track) noexcept RAKS_NONBLOCKING {
    const FlushToZeroScope flush_to_zero;
    State& state = *state_;
    if (!state.library) {
        return;
    }
    if (state.last_hop >= 0 && music.hop != state.last_hop + 1) {
        track.clear();
    }
    state.last_hop = music.hop;
    state.run_commands(music.time);
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
    if (state_->command_count < kQueuedCommands) {
        state_->commands[state_->command_count++] = command;
    }
}

void Dancer::reset() noexcept RAKS_NONBLOCKING {
    if (state_->library) {
        state_->reset();
    }
}

DancerStatus Dancer::status() const noexcept {
    DancerStatus status;
    const State& state = *state_;
    if (!state.library || !state.is_dancing) {
        status.reanchors = state.reanchors;
        return status;
    }
    const FigureCycle& cycle = state.cycle();
    const std::size_t length = std::min(cycle.name().size(), status.figure.size() - 1);
    std::memcpy(status.figure.data(), cycle.name().data(), length);
    const double beats = state.phase.phase().count();
    status.is_dancing = true;
    status.phase = beats - cycle.beats() * std::floor(beats / cycle.beats());
    status.count = static_cast<int>(status.phase) + 1;
    status.octave = state.phase.octave();
    status.rate = state.phase.rate();
    status.reanchors = state.reanchors;
    return status;
}

}  // namespace raks::motion
