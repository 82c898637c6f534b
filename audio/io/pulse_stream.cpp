#include "audio/io/pulse_stream.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "audio/io/bell.hpp"
#include "audio/io/counted_blocks.hpp"
#include "audio/io/deadline.hpp"
#include "audio/io/pulse_connection.hpp"
#include "base/channels/audio_ring.hpp"
#include "base/channels/latest_value.hpp"
#include "base/thread_priority.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

constexpr double kOutputBuffer = 0.040;  // seconds, when the caller has no wish
constexpr double kInputFragment = 0.010;
constexpr double kMostBuffer = 0.320;  // to which an output's buffer grows
constexpr int kBlocksPerSecond = 200;  // blocks of the callback: 5 ms
constexpr Nanos kBlock = std::chrono::milliseconds(1000 / kBlocksPerSecond);
constexpr std::size_t kBlocksAhead = 2;  // that wait in the ring for libpulse's thread
constexpr double kSmoothing = 0.005;     // of an output's latency, a block: 1 s
constexpr int kAnswers = 5;              // of the server, that an input's latency is the mean of
constexpr Nanos kOtherLatency = std::chrono::milliseconds(50);  // further off: it has changed
// An input without data for so long is silent: its sink is suspended. A thread that did not run for
// so long was stopped itself.
constexpr Nanos kStarvedAfter = std::chrono::milliseconds(250);
constexpr Nanos kStoppedAfter = std::chrono::milliseconds(800);

// How far the server had played when libpulse's thread looked last.
struct Played {
    HostTime at{};             // when it looked
    Nanos latency{};           // from then to the moment at which frame `written` will be heard
    std::int64_t written = 0;  // frames handed to the server by then
    bool is_known = false;
};

struct FreeStream {
    void operator()(pa_stream* stream) const noexcept { pa_stream_unref(stream); }
};

class PulseStream final : public DeviceStream {
 public:
    PulseStream(Direction direction, SampleRate rate, int channel_count, const StreamConfig& config)
        : DeviceStream(std::make_shared<CountedBlocks>(channel_count), rate),
          direction_(direction),
          frame_bytes_(sizeof(float) * static_cast<std::size_t>(channel_count)),
          block_(static_cast<std::size_t>(rate.hertz() / kBlocksPerSecond * channel_count)),
          ring_(static_cast<std::size_t>(rate.hertz() * channel_count)),
          may_grow_(config.may_grow),
          buffer_seconds_(config.latency_seconds > 0.0    ? config.latency_seconds
                          : direction == Direction::input ? kInputFragment
                                                          : kOutputBuffer) {}
    ~PulseStream() override;
    PulseStream(const PulseStream&) = delete;
    PulseStream& operator=(const PulseStream&) = delete;

    // Errors: why not.
    [[nodiscard]] Expected<void> open(const AudioDevice& device, bool stays);
    // After open().
    void start();

    [[nodiscard]] Nanos heard_after() const noexcept RAKS_NONBLOCKING override {
        return Nanos(heard_after_ns_.load(std::memory_order_relaxed));
    }
    [[nodiscard]] Nanos behind_server() const noexcept RAKS_NONBLOCKING override {
        return Nanos(behind_server_ns_.load(std::memory_order_relaxed));
    }
    [[nodiscard]] bool is_alive(HostTime) const noexcept override {
        return !is_dead_.load(std::memory_order_relaxed);
    }
    [[nodiscard]] std::optional<DeviceEvent> poll() override;

 private:
    [[nodiscard]] pa_buffer_attr buffer() const noexcept;
    [[nodiscard]] bool connect_stream(const AudioDevice& device, bool stays);
    void add_event(DeviceEvent event);
    void grow();
    // libpulse's thread.
    void move_samples();
    void write_samples();
    void read_samples();
    void look_at_clock();
    void look_at_capture();
    void note_heard_after(Nanos now) noexcept;
    void note_sink(Nanos held) noexcept;
    // Our own.
    void play_blocks();
    void record_blocks();
    HostTime handed_over_at() noexcept;

    Direction direction_;
    std::size_t frame_bytes_;
    std::vector<float> block_;  // of the callback's thread
    AudioRing ring_;            // between the two threads
    Bell bell_;                 // the callback's thread has something to do
    bool may_grow_;
    double buffer_seconds_;  // libpulse's thread, once it runs
    PulseConnection connection_{"Raks"};
    std::unique_ptr<pa_stream, FreeStream> stream_;

    std::string opened_;        // id of the device
    std::int64_t written_ = 0;  // frames; libpulse's thread
    // Of an input; likewise.
    HostTime read_at_{};   // when the newest samples were read
    timeval looked_at_{};  // time stamp of the server's newest answer
    int answers_ = 0;      // that the latency is the mean of
    bool was_far_ = true;
    LatestValue<Played> played_;
    // Relaxed: each is a value by itself.
    std::atomic<std::int64_t> heard_after_ns_{0};
    std::atomic<std::int64_t> behind_server_ns_{0};  // what the sink holds
    std::atomic<bool> is_stopping_{false};
    std::atomic<bool> is_dead_{false};
    std::mutex events_mutex_;
    std::deque<DeviceEvent> events_;
    std::thread pulse_thread_;
    std::thread callback_thread_;
};

PulseStream::~PulseStream() {
    disconnect();
    is_stopping_.store(true, std::memory_order_relaxed);
    bell_.ring();
    connection_.wake();
    if (pulse_thread_.joinable()) {
        pulse_thread_.join();
        callback_thread_.join();
    }
    if (stream_) {
        pa_stream_set_moved_callback(stream_.get(), nullptr, nullptr);
        pa_stream_set_underflow_callback(stream_.get(), nullptr, nullptr);
        pa_stream_disconnect(stream_.get());
    }
}

// With these an output starts when its buffer is half full, and again after it ran dry.
pa_buffer_attr PulseStream::buffer() const noexcept {
    const auto bytes = [&](double seconds) {
        return static_cast<std::uint32_t>(
            static_cast<std::size_t>(std::lround(seconds * rate().hertz())) * frame_bytes_);
    };
    constexpr auto kServerChooses = static_cast<std::uint32_t>(-1);
    pa_buffer_attr wish{};
    wish.maxlength = kServerChooses;
    wish.tlength = bytes(buffer_seconds_);
    wish.prebuf = bytes(buffer_seconds_ / 2);
    wish.minreq = bytes(buffer_seconds_ / 4);
    wish.fragsize = bytes(buffer_seconds_);
    return wish;
}

bool PulseStream::connect_stream(const AudioDevice& device, bool stays) {
    const pa_sample_spec form{.format = PA_SAMPLE_FLOAT32NE,
                              .rate = static_cast<std::uint32_t>(rate().hertz()),
                              .channels = static_cast<std::uint8_t>(channels())};
    const bool is_input = direction_ == Direction::input;
    stream_.reset(
        pa_stream_new(connection_.context(), is_input ? "Listening" : "Music", &form, nullptr));
    if (!stream_) {
        return false;
    }
    pa_stream_set_moved_callback(
        stream_.get(),
        [](pa_stream* stream, void* data) {
            const char* const name = pa_stream_get_device_name(stream);
            static_cast<PulseStream*>(data)->add_event(
                {.kind = DeviceEvent::Kind::moved, .id = name != nullptr ? name : ""});
        },
        this);
    pa_stream_set_underflow_callback(
        stream_.get(),
        [](pa_stream*, void* data) { static_cast<PulseStream*>(data)->grow(); },
        this);
    const pa_buffer_attr wish = buffer();
    const auto flags = static_cast<pa_stream_flags_t>(
        PA_STREAM_ADJUST_LATENCY | PA_STREAM_AUTO_TIMING_UPDATE | PA_STREAM_INTERPOLATE_TIMING |
        (is_input || stays ? PA_STREAM_DONT_MOVE : 0));
    if (is_input) {
        return pa_stream_connect_record(stream_.get(), device.id.c_str(), &wish, flags) == 0;
    }
    // Without a name the server puts the stream where the person wants Raks to play, and moves it
    // along with the default.
    const bool is_for_default = device.is_default_output && !stays;
    return pa_stream_connect_playback(stream_.get(),
                                      is_for_default ? nullptr : device.id.c_str(),
                                      &wish,
                                      flags,
                                      nullptr,
                                      nullptr) == 0;
}

Expected<void> PulseStream::open(const AudioDevice& device, bool stays) {
    const auto deadline = std::chrono::steady_clock::now() + kServerPatience;
    if (const auto result = connection_.connect(deadline);
        result != PulseConnection::Result::connected) {
        return fail(result == PulseConnection::Result::absent
                        ? "the sound server is not running"
                        : "the sound server does not answer (2 s waited)");
    }
    opened_ = device.id;
    if (!connect_stream(device, stays)) {
        return fail(connection_.reason());
    }
    while (pa_stream_get_state(stream_.get()) != PA_STREAM_READY) {
        if (PA_STREAM_IS_GOOD(pa_stream_get_state(stream_.get())) == 0) {
            return fail(connection_.reason());
        }
        if (!connection_.is_good() || !connection_.step(deadline)) {
            return fail("the sound server does not answer (2 s waited)");
        }
    }
    pa_context_set_subscribe_callback(
        connection_.context(),
        [](pa_context*, pa_subscription_event_type_t, std::uint32_t, void* data) {
            static_cast<PulseStream*>(data)->add_event({});
        },
        this);
    connection_.finish(
        pa_context_subscribe(connection_.context(),
                             static_cast<pa_subscription_mask_t>(PA_SUBSCRIPTION_MASK_SINK |
                                                                 PA_SUBSCRIPTION_MASK_SOURCE |
                                                                 PA_SUBSCRIPTION_MASK_SERVER),
                             nullptr,
                             nullptr),
        deadline);
    return {};
}

void PulseStream::start() {
    // Until the server tells more: an output is heard when its buffer has been played.
    if (direction_ == Direction::output) {
        // The person may have sent Raks elsewhere before: the server remembers.
        const char* const name = pa_stream_get_device_name(stream_.get());
        if (name != nullptr && name != opened_) {
            add_event({.kind = DeviceEvent::Kind::moved, .id = name});
        }
        heard_after_ns_.store(nanos_from_seconds(buffer_seconds_).count(),
                              std::memory_order_relaxed);
    }
    callback_thread_ = std::thread([this] {
        prefer_this_thread(RealtimeThread::callback);
        direction_ == Direction::output ? play_blocks() : record_blocks();
    });
    pulse_thread_ = std::thread([this] {
        prefer_this_thread(RealtimeThread::transport);
        move_samples();
    });
}

// Many changes in a row are one.
void PulseStream::add_event(DeviceEvent event) {
    const std::lock_guard lock(events_mutex_);
    if (event.kind != DeviceEvent::Kind::devices_changed || events_.empty() ||
        events_.back().kind != event.kind) {
        events_.push_back(std::move(event));
    }
}

std::optional<DeviceEvent> PulseStream::poll() {
    const std::lock_guard lock(events_mutex_);
    if (events_.empty()) {
        return std::nullopt;
    }
    DeviceEvent event = std::move(events_.front());
    events_.pop_front();
    return event;
}

// The output ran dry: a longer buffer from now on.
void PulseStream::grow() {
    blocks().note_xrun();
    const double longer = std::min(2.0 * buffer_seconds_, kMostBuffer);
    if (!may_grow_ || longer <= buffer_seconds_) {
        return;
    }
    buffer_seconds_ = longer;
    const pa_buffer_attr wish = buffer();
    if (pa_operation* const operation =
            pa_stream_set_buffer_attr(stream_.get(), &wish, nullptr, nullptr)) {
        pa_operation_unref(operation);
    }
    add_event({.kind = DeviceEvent::Kind::buffer_grown,
               .milliseconds = static_cast<int>(std::lround(1e3 * longer))});
}

void PulseStream::move_samples() {
    while (!is_stopping_.load(std::memory_order_relaxed)) {
        direction_ == Direction::output ? write_samples() : read_samples();
        look_at_clock();
        if (!connection_.wait() || !connection_.is_good() ||
            pa_stream_get_state(stream_.get()) != PA_STREAM_READY) {
            is_dead_.store(true, std::memory_order_relaxed);
            return;
        }
    }
}

// As much as the server wants and the callback has made.
void PulseStream::write_samples() {
    for (;;) {
        const std::size_t wanted = pa_stream_writable_size(stream_.get());
        std::size_t bytes = std::min(wanted == static_cast<std::size_t>(-1) ? 0 : wanted,
                                     ring_.readable() * sizeof(float));
        bytes -= bytes % frame_bytes_;
        void* room = nullptr;
        if (bytes == 0 || pa_stream_begin_write(stream_.get(), &room, &bytes) < 0) {
            return;
        }
        bytes = std::min(bytes - bytes % frame_bytes_, ring_.readable() * sizeof(float));
        ring_.read({static_cast<float*>(room), bytes / sizeof(float)});
        pa_stream_write(stream_.get(), room, bytes, nullptr, 0, PA_SEEK_RELATIVE);
        written_ += static_cast<std::int64_t>(bytes / frame_bytes_);
        bell_.ring();
    }
}

void PulseStream::read_samples() {
    while (pa_stream_readable_size(stream_.get()) > 0) {
        const void* data = nullptr;
        std::size_t bytes = 0;
        if (pa_stream_peek(stream_.get(), &data, &bytes) < 0 || bytes == 0) {
            return;
        }
        // A hole of that length has no data; it was lost.
        const std::size_t samples = data == nullptr ? 0 : bytes / sizeof(float);
        if (samples == 0 || ring_.write({static_cast<const float*>(data), samples}) < samples) {
            blocks().note_xrun();
        }
        pa_stream_drop(stream_.get());
        read_at_ = HostClock::now();
        bell_.ring();
    }
}

void PulseStream::look_at_clock() {
    if (direction_ == Direction::input) {
        look_at_capture();
        return;
    }
    pa_usec_t latency = 0;
    int is_negative = 0;
    if (pa_stream_get_latency(stream_.get(), &latency, &is_negative) >= 0) {
        const Nanos ahead = is_negative != 0 ? Nanos(0) : Nanos(std::chrono::microseconds(latency));
        played_.write(
            {HostTime(HostClock::now()), std::min<Nanos>(ahead, kMostLatency), written_, true});
        if (const pa_timing_info* const info = pa_stream_get_timing_info(stream_.get());
            info != nullptr && pa_timeval_cmp(&info->timestamp, &looked_at_) != 0) {
            looked_at_ = info->timestamp;
            note_sink(std::chrono::microseconds(info->sink_usec));
        }
    }
}

// What the server said last, about once a second: how old the newest sample was that it had handed
// over, and, of a monitor, how much its sink still held. Samples come in bursts; the newest one was
// read at read_at_. (libpulse's own interpolation takes half a minute to follow a sink that
// starts.)
void PulseStream::look_at_capture() {
    const pa_timing_info* const info = pa_stream_get_timing_info(stream_.get());
    if (info == nullptr || read_at_ == HostTime{} ||
        pa_timeval_cmp(&info->timestamp, &looked_at_) == 0) {
        return;
    }
    looked_at_ = info->timestamp;
    const auto usec = [](pa_usec_t span) { return Nanos(std::chrono::microseconds(span)); };
    note_sink(usec(info->sink_usec));
    const HostTime said = HostClock::now() - usec(pa_timeval_age(&info->timestamp));
    // An answer that is older than the newest sample tells of one before it.
    if (said >= read_at_) {
        note_heard_after(said + usec(info->sink_usec) - usec(info->source_usec) - read_at_);
    }
}

// A sink takes in steps, so that what it holds goes up and down; the line through the ends of the
// steps is where that is at its greatest. Answers are few and find the greatest seldom; another
// sink may hold much less.
void PulseStream::note_sink(Nanos held) noexcept {
    constexpr int kSlow = 32;
    const Nanos before = behind_server();
    const Nanos next = held > before || 2 * held < before ? held : before + (held - before) / kSlow;
    behind_server_ns_.store(std::min<Nanos>(next, kMostLatency).count(), std::memory_order_relaxed);
}

// The mean of the last few answers; two far off in a row stand for another latency.
void PulseStream::note_heard_after(Nanos now) noexcept {
    const Nanos next = std::clamp<Nanos>(now, -kMostLatency, kMostLatency);
    const Nanos error = next - heard_after();
    const bool is_far = std::chrono::abs(error) > kOtherLatency;
    if (is_far && was_far_) {
        answers_ = 0;
    }
    was_far_ = is_far;
    answers_ = std::min(answers_ + 1, kAnswers);
    heard_after_ns_.store((heard_after() + error / answers_).count(), std::memory_order_relaxed);
}

// When the next block was handed over: the moment at which it will be heard, as the server's clock
// says, less the latency. The thread's own time would be off by the bursts in which a server asks.
HostTime PulseStream::handed_over_at() noexcept {
    const Played played = played_.read();
    const HostTime now = HostClock::now();
    const Nanos smooth = heard_after();
    if (!played.is_known) {
        return now;
    }
    const std::int64_t ahead = blocks().frames() - played.written;
    const Nanos waiting = ahead >= 0 ? rate().time_of(ahead).time_since_epoch() : Nanos(0);
    const HostTime heard = played.at + played.latency + waiting;
    const double error = to_seconds(heard - now) - to_seconds(smooth);
    const Nanos next =
        std::clamp<Nanos>(smooth + nanos_from_seconds(kSmoothing * error), Nanos(0), kMostLatency);
    heard_after_ns_.store(next.count(), std::memory_order_relaxed);
    return heard - next;
}

void PulseStream::play_blocks() {
    const std::size_t ahead = kBlocksAhead * block_.size();
    while (!is_stopping_.load(std::memory_order_relaxed)) {
        bool is_fresh = false;
        while (ring_.readable() < ahead) {
            blocks().take_output(block_, handed_over_at());
            ring_.write(block_);
            is_fresh = true;
        }
        if (is_fresh) {
            connection_.wake();
        }
        bell_.wait();
    }
}

void PulseStream::record_blocks() {
    HostTime fed_until = HostClock::now();  // data, or the silence in its place
    HostTime looked = fed_until;
    bool is_starved = false;
    while (!is_stopping_.load(std::memory_order_relaxed)) {
        bell_.wait();
        const HostTime now = HostClock::now();
        // What was lost meanwhile is a gap, which the callback sees by the clock.
        if (now - looked > kStoppedAfter) {
            fed_until = now;
        }
        looked = now;
        while (const std::size_t got = ring_.read(block_)) {
            // The newest sample has just come; those before it came before.
            const auto behind = static_cast<std::int64_t>(ring_.readable()) / channels();
            fed_until = now - rate().time_of(behind).time_since_epoch();
            blocks().take_input(std::span(block_).first(got), fed_until);
            is_starved = false;
        }
        // From then on up to now; the next wake-up adds what has passed by then.
        if (now - fed_until > kStarvedAfter) {
            is_starved = true;
        }
        while (is_starved && now - fed_until >= kBlock) {
            std::fill(block_.begin(), block_.end(), 0.0F);
            fed_until += kBlock;
            blocks().take_input(block_, fed_until);
        }
    }
}

}  // namespace

Expected<std::unique_ptr<DeviceStream>> open_pulse_stream(DeviceStream::Direction direction,
                                                          const AudioDevice& device,
                                                          const StreamConfig& config) {
    const bool is_input = direction == DeviceStream::Direction::input;
    const int most = is_input ? device.input_channels : device.output_channels;
    const int rate =
        config.rate_hz > 0 ? config.rate_hz : static_cast<int>(std::lround(device.default_rate));
    auto stream = std::make_unique<PulseStream>(
        direction, SampleRate(rate), std::clamp(config.channels, 1, std::min(most, 8)), config);
    if (auto opened = stream->open(device, config.stays); !opened) {
        return fail(opened.error());
    }
    stream->start();
    return stream;
}

}  // namespace raks::audio
