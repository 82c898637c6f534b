#include "engine/live/live_graph.hpp"

#include <algorithm>
#include <ctime>
#include <utility>
#include <vector>

#include "base/realtime.hpp"

namespace raks::engine {
namespace {

// About 5 ms at 48 kHz: as fine as a device's own blocks.
constexpr std::int64_t kBlockFrames = 256;
// After a longer stall (a suspended machine) the clock goes on from now instead of racing after.
constexpr Nanos kMaxBehind = std::chrono::milliseconds(500);

// An absolute time: errors of single sleeps do not add up.
void sleep_until(HostTime time) noexcept {
    const std::int64_t ns = time.time_since_epoch().count();
    timespec until{};
    until.tv_sec = ns / 1'000'000'000;
    until.tv_nsec = ns % 1'000'000'000;
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

}  // namespace

PacedClock::PacedClock(Direction direction,
                       SampleRate rate,
                       int channels,
                       audio::StreamCallback& callback)
    : callback_(callback), thread_([=, this] { run(direction, rate, channels); }) {}

PacedClock::~PacedClock() {
    is_stopping_.store(true, std::memory_order_relaxed);  // relaxed: join() orders the rest
    thread_.join();
}

void PacedClock::run(Direction direction, SampleRate rate, int channels) noexcept {
    const FlushToZeroScope flush_to_zero;
    std::vector<float> block(static_cast<std::size_t>(kBlockFrames * channels));
    // Each block is due at the start plus its own frame number: the rate is exact in the long run.
    HostTime start = HostClock::now();
    std::int64_t frame = 0;
    while (!is_stopping_.load(std::memory_order_relaxed)) {  // relaxed: see the destructor
        const HostTime due = start + rate.time_of(frame).time_since_epoch();
        sleep_until(due);
        const HostTime now = HostClock::now();
        // Moves the start, so that the blocks of the stall are not called one after the other.
        if (now - due > kMaxBehind) {
            start += now - due;
        }
        // Silence for an input; a zeroed block for an output, as the callback expects.
        std::fill(block.begin(), block.end(), 0.0F);
        const audio::BlockTime time{frame, now, false};
        if (direction == Direction::input) {
            callback_.on_input(block, channels, time);
        } else {
            callback_.on_output(block, channels, time);
        }
        frame += kBlockFrames;
    }
}

namespace {

// What stands in for a device that is missing or has died: nothing is audible, so any usual rate
// does.
constexpr SampleRate kOwnClockRate(48'000);
constexpr int kOwnClockChannels = 2;

}  // namespace

Expected<std::unique_ptr<LiveGraph>> LiveGraph::play(
    std::unique_ptr<audio::FilePlayer> player,
    const std::optional<audio::AudioDevice>& output,
    const LiveGraphConfig& config) {
    std::unique_ptr<LiveGraph> graph(new LiveGraph);
    auto playback = Playback::create(std::move(player), config.models);
    if (!playback) {
        return fail(playback.error());
    }
    // The callback's target is built before the stream that will call it.
    graph->playback_ = std::move(*playback);
    graph->analysis_ = &graph->playback_->analysis();
    if (config.is_held_back) {
        graph->playback_->hold_back();
    }
    if (config.plan) {
        graph->analysis_->planned().set_plan(config.plan, PlannedStates::Beginning::now);
    }
    if (output) {
        auto stream = audio::DeviceStream::open_output(*output, {});
        if (!stream) {
            return fail(stream.error());
        }
        graph->stream_ = std::move(*stream);
        graph->device_name_ = output->name;
        // Pictures wait for what the device buffers. Without a device nothing is delayed, and no
        // offset applies.
        graph->reported_latency_ = graph->stream_->reported_latency();
        graph->latency_offset_ = config.latency_offset;
    }
    // The resampler needs the device's real rate, which is known once the stream is open.
    const SampleRate rate = output ? graph->stream_->rate() : kOwnClockRate;
    if (auto prepared = graph->playback_->prepare(rate); !prepared) {
        return fail(prepared.error());
    }
    // The motion thread runs before the first callback: no state waits for it in the queue.
    if (auto started = graph->start_motion(config); !started) {
        return fail(started.error());
    }
    if (output) {
        graph->stream_->connect(*graph->playback_);
    } else {
        graph->paced_clock_ = std::make_unique<PacedClock>(
            PacedClock::Direction::output, rate, kOwnClockChannels, *graph->playback_);
    }
    return graph;
}

// With an input nothing is delayed on the way out: latencies stay 0.
Expected<std::unique_ptr<LiveGraph>> LiveGraph::listen(const audio::AudioDevice& input,
                                                       const LiveGraphConfig& config) {
    std::unique_ptr<LiveGraph> graph(new LiveGraph);
    auto stream = audio::DeviceStream::open_input(input, {});
    if (!stream) {
        return fail(stream.error());
    }
    graph->stream_ = std::move(*stream);
    graph->device_name_ = input.name;
    auto live_input = LiveInput::create(graph->stream_->rate(), config.models);
    if (!live_input) {
        return fail(input.name + ": " + live_input.error().message);
    }
    graph->live_input_ = std::move(*live_input);
    graph->analysis_ = &graph->live_input_->analysis();
    if (auto started = graph->start_motion(config); !started) {
        return fail(started.error());
    }
    graph->stream_->connect(*graph->live_input_);
    return graph;
}

// Prepares the dancers (checks, allocations) on this thread and starts the one that dances them.
Expected<void> LiveGraph::start_motion(const LiveGraphConfig& config) {
    pose_lead_ = config.pose_lead;
    motion::Ensemble dancers;
    if (auto ok = dancers.prepare(config.cast.members, config.cast.skeleton); !ok) {
        return ok;
    }
    for_main_ = std::make_unique<StageChannel>();
    // The main thread is a reader of the stage like any other, over a channel of its own.
    MotionStage::Wiring wiring{analysis_->states(), config.readers, config.record};
    wiring.readers.push_back(for_main_.get());
    motion_ = std::make_unique<MotionThread>(std::move(dancers), std::move(wiring));
    return {};
}

audio::StreamCallback& LiveGraph::callback() noexcept {
    if (playback_) {
        return *playback_;
    }
    return *live_input_;
}

// A dead device leaves its stream hanging: it is noticed by callbacks that stay away.
std::optional<std::string> LiveGraph::watch(HostTime now) {
    if (!stream_ || has_lost_device_ || stream_->is_alive(now)) {
        return std::nullopt;
    }
    has_lost_device_ = true;
    // Nothing is audible any more, so that the pictures need not wait for a loudspeaker.
    reported_latency_ = {};
    latency_offset_ = {};
    go_on_without_device();
    return device_name_ + ": the device is gone; " +
           (playback_ ? "the dance goes on without sound"
                      : "the dancer settles (start again to listen to another)");
}

// Replaces the device by the paced clock, which calls the same callback: music and dance go on. An
// input goes on with silence, in which the dancer settles.
void LiveGraph::go_on_without_device() {
    // Closing a dead stream would hang: it is abandoned first.
    stream_->abandon();
    stream_.reset();
    if (playback_) {
        // Copying or resampling alike, the only failure is lack of memory: then nothing plays on.
        if (!playback_->prepare(kOwnClockRate)) {
            return;
        }
    }
    const SampleRate rate = playback_ ? kOwnClockRate : analysis_->rate();
    paced_clock_ = std::make_unique<PacedClock>(
        playback_ ? PacedClock::Direction::output : PacedClock::Direction::input,
        rate,
        kOwnClockChannels,
        callback());
}

StreamTime LiveGraph::moment_at(HostTime seen_at) noexcept {
    // Stream time that is handed over at seen_at, minus what the output still buffers, plus the
    // lead.
    return analysis_->clock().stream_at(seen_at) + pose_lead_ - output_latency();
}

LiveCounters LiveGraph::counters() const noexcept {
    LiveCounters counters;
    counters.dropped_states = analysis_->states().dropped();
    counters.xruns = stream_ ? stream_->xruns() : 0;
    counters.underruns = playback_ ? playback_->player().underruns() : 0;
    return counters;
}

bool LiveGraph::command(audio::AnalyzerCommand::Kind kind, double value) noexcept {
    // Dated by the picture that the person was looking at when the key was pressed.
    return analysis_->command({kind, moment_at(HostClock::now()), value});
}

bool LiveGraph::command(motion::DancerCommand::Kind kind, double value) noexcept {
    return motion_->command({kind, moment_at(HostClock::now()), value});
}

Expected<void> LiveGraph::replace_dancers(const Cast& cast) {
    // Prepared here, since the motion thread must neither allocate nor wait.
    motion::Ensemble dancers;
    if (auto ok = dancers.prepare(cast.members, cast.skeleton); !ok) {
        return ok;
    }
    if (!motion_->replace(std::move(dancers))) {
        return fail("too many commands at once: the dancers stay");
    }
    return {};
}

}  // namespace raks::engine
