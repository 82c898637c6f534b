#include "engine/live/live_graph.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace raks::engine {
namespace {

using Direction = audio::DeviceStream::Direction;

// What stands in for a device that was not asked for: nothing is audible, so any usual rate does.
constexpr SampleRate kOwnClockRate(48'000);
constexpr int kOwnClockChannels = 2;
// `live` without sound for so long looks around for it, and then again.
constexpr Nanos kSilentFor = std::chrono::seconds(5);
constexpr float kSilentDbfs = -70.0F;
// Tracks keep 0.6 s of poses: a dance that is seen later than this waits.
constexpr Nanos kLongestAhead = std::chrono::milliseconds(300);

}  // namespace

// Opens the device and starts keeping it. Errors: it cannot be opened.
Expected<void> LiveGraph::open_stream(Direction direction,
                                      const audio::AudioDevice& device,
                                      const LiveGraphConfig& config) {
    audio::StreamConfig wishes;
    wishes.latency_seconds = config.buffer_seconds;
    wishes.may_grow = config.buffer_seconds == 0.0;
    if (direction == Direction::output && config.buffer_seconds == 0.0) {
        wishes.latency_seconds = kPlayBuffer;
    }
    wishes.stays = config.is_device_named;
    auto stream = audio::DeviceStream::open(direction, device, wishes);
    if (!stream) {
        return fail(stream.error());
    }
    auto keeper = std::make_unique<DeviceKeeper>(
        DeviceKeeper::Plan{direction, config.is_device_named, wishes}, device);
    use({device, std::move(*stream), std::move(keeper)}, config);
    return {};
}

void LiveGraph::use(OpenLoudspeaker opened, const LiveGraphConfig& config) {
    stream_ = std::move(opened.stream);
    keeper_ = std::move(opened.keeper);
    xruns_before_ = stream_->xruns();
    // Without a device nothing is delayed, and no offset applies.
    latency_offset_ = config.latency_offset;
    offsets_ = config.offsets;
    set_device(opened.device);
}

std::optional<OpenLoudspeaker> LiveGraph::leave_loudspeaker() {
    if (!playback_ || !stream_ || has_lost_device_) {
        return std::nullopt;
    }
    stream_->disconnect();
    return OpenLoudspeaker{device_, std::move(stream_), std::move(keeper_)};
}

Expected<std::unique_ptr<LiveGraph>> LiveGraph::play(
    std::unique_ptr<audio::FilePlayer> player,
    const std::optional<audio::AudioDevice>& output,
    const LiveGraphConfig& config,
    std::optional<OpenLoudspeaker> open) {
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
    if (open) {
        graph->use(std::move(*open), config);
    } else if (output) {
        if (auto opened = graph->open_stream(Direction::output, *output, config); !opened) {
            return fail(opened.error());
        }
    }
    // The resampler needs the device's real rate, which is known once the stream is open.
    const SampleRate rate = graph->stream_ ? graph->stream_->rate() : kOwnClockRate;
    if (auto prepared = graph->playback_->prepare(rate); !prepared) {
        return fail(prepared.error());
    }
    // The motion thread runs before the first callback: no state waits for it in the queue.
    if (auto started = graph->start_motion(config); !started) {
        return fail(started.error());
    }
    if (graph->stream_) {
        graph->stream_->connect(*graph->playback_);
    } else {
        graph->paced_clock_ = std::make_unique<PacedClock>(
            PacedClock::Direction::output, rate, kOwnClockChannels, *graph->playback_);
    }
    return graph;
}

Expected<std::unique_ptr<LiveGraph>> LiveGraph::listen(const audio::AudioDevice& input,
                                                       const LiveGraphConfig& config) {
    std::unique_ptr<LiveGraph> graph(new LiveGraph);
    if (auto opened = graph->open_stream(Direction::input, input, config); !opened) {
        return fail(opened.error());
    }
    auto live_input = LiveInput::create(graph->stream_->rate(), config.models);
    if (!live_input) {
        return fail(input.name + ": " + live_input.error().message);
    }
    graph->live_input_ = std::move(*live_input);
    graph->analysis_ = &graph->live_input_->analysis();
    graph->heard_last_ = HostClock::now();
    if (auto started = graph->start_motion(config); !started) {
        return fail(started.error());
    }
    graph->stream_->connect(*graph->live_input_);
    return graph;
}

// Prepares the dancers (checks, allocations) on this thread and starts the one that dances them.
Expected<void> LiveGraph::start_motion(const LiveGraphConfig& config) {
    pose_lead_ = config.pose_lead;
    if (live_input_ && config.cast.empty()) {
        analysis_->tell_feed();
        publish_delay();
        return {};
    }
    motion::Ensemble dancers;
    if (auto ok = dancers.prepare(config.cast); !ok) {
        return ok;
    }
    for_main_ = std::make_unique<StageChannel>();
    // The main thread is a reader of the stage like any other, over a channel of its own.
    MotionStage::Wiring wiring{
        analysis_->states(), config.readers, config.record, analysis_->feed().get()};
    wiring.readers.push_back(for_main_.get());
    motion_ = std::make_unique<MotionThread>(std::move(dancers), std::move(wiring));
    if (stream_) {
        motion_->stay_below(stream_->callback_priority());
    }
    publish_delay();
    return {};
}

audio::StreamCallback& LiveGraph::callback() noexcept {
    if (playback_) {
        return *playback_;
    }
    return *live_input_;
}

// "listening to 'Monitor of Speakers' (PulseAudio) again"
std::string LiveGraph::about(const audio::AudioDevice& device, const char* how) const {
    return fmt::format(
        "{} {} {}", playback_ ? "sound goes to" : "listening to", audio::described(device), how);
}

void LiveGraph::set_device(const audio::AudioDevice& device) {
    device_ = device;
    device_offset_ = offsets_.of(device.name, device.monitor_of).value_or(Nanos(0));
}

std::vector<std::string> LiveGraph::watch(HostTime now) {
    std::vector<std::string> lines;
    publish_delay();
    if (!keeper_) {
        return lines;
    }
    if (const auto slept = sleep_watch_.look(); slept && live_input_) {
        live_input_->note_sleep(*slept);
    }
    if (stream_) {
        take_events(lines);
        if (!stream_->is_alive(now)) {
            lose_device(lines);
        }
    }
    take_news(lines);
    watch_silence(now);
    return lines;
}

void LiveGraph::take_events(std::vector<std::string>& lines) {
    using Kind = audio::DeviceEvent::Kind;
    while (const auto event = stream_->poll()) {
        switch (event->kind) {
            case Kind::devices_changed:
                keeper_->look();
                break;
            case Kind::moved:
                keeper_->note_move(event->id);
                break;
            case Kind::buffer_grown:
                if (!has_said_growth_) {
                    lines.push_back(
                        fmt::format("the sound had a gap: its buffer is longer from now on, {} ms",
                                    event->milliseconds));
                }
                has_said_growth_ = true;
                break;
            case Kind::source_gone:
                trouble_ = fmt::format("{}: has left JACK; waiting until it is back", event->id);
                lines.push_back(trouble_);
                break;
            case Kind::source_back:
                trouble_.clear();
                lines.push_back(fmt::format("listening to '{}' (JACK) again", event->id));
                break;
        }
    }
}

// `play` stands still until somebody can hear it; for `live` the music goes on, wherever it is.
void LiveGraph::lose_device(std::vector<std::string>& lines) {
    last_heard_after_ = stream_->heard_after();
    stream_->abandon();
    keeper_->close_later(std::move(stream_));
    keeper_->reopen();
    has_lost_device_ = true;
    if (playback_) {
        playback_->stop_clock();
    } else {
        paced_clock_ = std::make_unique<PacedClock>(
            PacedClock::Direction::input, analysis_->rate(), kOwnClockChannels, live_input_->gap());
    }
    trouble_ = fmt::format("{}: the device is gone; {} until it is back",
                           device_.name,
                           playback_ ? "pausing" : "dancing on without sound");
    lines.push_back(trouble_);
}

void LiveGraph::take_news(std::vector<std::string>& lines) {
    using Kind = DeviceKeeper::News::Kind;
    while (auto news = keeper_->take()) {
        switch (news->kind) {
            case Kind::opened:
                take_over(*news, lines);
                break;
            case Kind::moved:
                if (news->device.id != device_.id) {
                    set_device(news->device);
                    lines.push_back(about(device_, "now"));
                }
                break;
            case Kind::elsewhere:
                if (!has_said_elsewhere_) {
                    lines.push_back(
                        fmt::format("nothing is heard from '{}', but '{}' has sound: "
                                    "--device \"{}\" listens there",
                                    device_.name,
                                    news->device.name,
                                    news->device.name));
                }
                has_said_elsewhere_ = true;
                break;
        }
    }
}

// The stream before ends before its callback is made ready for the new one's rate.
void LiveGraph::take_over(DeviceKeeper::News& news, std::vector<std::string>& lines) {
    if (stream_) {
        stream_->disconnect();
        keeper_->close_later(std::move(stream_));
    }
    paced_clock_.reset();
    const SampleRate rate = news.stream->rate();
    const auto ready = playback_ ? playback_->prepare(rate) : live_input_->resume(rate);
    stream_ = std::move(news.stream);
    xruns_before_ = 0;
    if (motion_) {
        motion_->stay_below(stream_->callback_priority());
    }
    lines.push_back(
        about(news.device, has_lost_device_ && news.device.id == device_.id ? "again" : "now"));
    set_device(news.device);
    has_lost_device_ = !ready;
    trouble_.clear();
    if (!ready) {
        trouble_ = device_.name + ": " + ready.error().message;
        lines.back() = trouble_;
        return;
    }
    stream_->connect(callback());
}

void LiveGraph::watch_silence(HostTime now) {
    if (!live_input_ || has_lost_device_ || device_.system != audio::AudioSystemKind::pulse) {
        return;
    }
    if (analysis_->level_dbfs(now) > kSilentDbfs) {
        heard_last_ = now;
        has_said_elsewhere_ = false;
    } else if (now - heard_last_ >= kSilentFor && !has_said_elsewhere_) {
        heard_last_ = now;
        keeper_->listen_around();
    }
}

bool LiveGraph::is_played_out(HostTime now) noexcept {
    if (!playback_ || !playback_->is_finished()) {
        finished_.reset();
        return false;
    }
    finished_ = finished_.value_or(now);
    return now - *finished_ >= heard_after();
}

Nanos LiveGraph::heard_after() const noexcept {
    const Nanos reported = stream_ ? stream_->heard_after() : last_heard_after_;
    return reported + device_offset_ + latency_offset_;
}

HostTime LiveGraph::heard_at(StreamTime t) noexcept {
    return HeardLine{analysis_->clock(), heard_after()}.heard_at(t);
}

StreamTime LiveGraph::moment_at(HostTime seen_at) noexcept {
    return HeardLine{analysis_->clock(), heard_after()}.heard_by(seen_at) + pose_lead_;
}

StreamTime LiveGraph::passing_at(HostTime host) noexcept {
    const Nanos after =
        stream_ ? stream_->heard_after() - stream_->behind_server() : last_heard_after_;
    return HeardLine{analysis_->clock(), after}.heard_by(host) + pose_lead_;
}

// Readers on other threads and the motion thread are told how late it is heard. What is analyzed
// long before that is danced only when it is nearly due: tracks keep poses for a while only, and
// what a person asks for must not come after what was danced ahead.
void LiveGraph::publish_delay() noexcept {
    const Nanos after = heard_after();
    analysis_->feed()->set_heard_after(after);
    const Nanos ahead = after - pose_lead_ - kLongestAhead;
    if (motion_) {
        motion_->hold_back(ahead > Nanos(0) ? static_cast<std::size_t>(ahead / kHop) : 0);
    }
}

const MusicState& LiveGraph::newest_music() noexcept {
    while (!motion_ && analysis_->states().pop(newest_music_)) {
    }
    return newest_music_;
}

LiveCounters LiveGraph::counters() const noexcept {
    LiveCounters counters;
    counters.dropped_states = analysis_->states().dropped();
    counters.xruns = stream_ ? stream_->xruns() - xruns_before_ : 0;
    counters.underruns = playback_ ? playback_->player().underruns() : 0;
    return counters;
}

bool LiveGraph::command(audio::AnalyzerCommand::Kind kind, double value, HostTime came) noexcept {
    // Dated by the picture that the person was looking at when the key was pressed.
    return analysis_->command({kind, moment_at(came), value});
}

bool LiveGraph::follow_song(std::shared_ptr<const audio::SongPlan> plan, Nanos shift) {
    if (plan == nullptr) {
        return tell({.kind = SongNews::Kind::unknown});
    }
    const bool is_told = tell({.kind = SongNews::Kind::known, .plan = plan.get(), .shift = shift});
    if (is_told) {
        std::rotate(heard_plans_.begin(), heard_plans_.end() - 1, heard_plans_.end());
        heard_plans_.front() = std::move(plan);
    }
    return is_told;
}

bool LiveGraph::command(motion::DancerCommand::Kind kind, double value) noexcept {
    return motion_ && motion_->command({kind, moment_at(HostClock::now()), value});
}

Expected<void> LiveGraph::replace_dancers(const Cast& cast, MotionStage::Entry entry) {
    // Prepared here, since the motion thread must neither allocate nor wait.
    motion::Ensemble dancers;
    if (auto ok = dancers.prepare(cast); !ok) {
        return ok;
    }
    if (!motion_->replace(std::move(dancers), entry)) {
        return fail("too many keys at once: the dancers stay as they are; press again");
    }
    return {};
}

}  // namespace raks::engine
