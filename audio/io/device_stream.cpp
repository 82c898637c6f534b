#include "audio/io/device_stream.hpp"

#include <portaudio.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <optional>
#include <thread>
#include <utility>

#include "audio/io/callback_gate.hpp"
#include "audio/io/portaudio_session.hpp"
#include "base/realtime.hpp"

namespace raks::audio {
namespace {

// Time without a callback after which a device counts as dead. JACK calls every few milliseconds,
// but may pause on an overloaded machine, and a device that was given up is not taken up again. A
// PulseAudio sink may play out its own buffer first: pauses of 1.6 to 2.2 s were seen after the
// first callback.
constexpr Nanos kJackDeadAfter = std::chrono::milliseconds(1500);
constexpr Nanos kDeadAfter = std::chrono::seconds(3);
constexpr Nanos kFirstCallbackWithin = std::chrono::seconds(2);  // of the start
constexpr std::chrono::seconds kCloseWithin(1);                  // then close() gives up
constexpr double kMostLatency = 2.0;     // seconds; PipeWire reported 89,478 s
constexpr double kPulseLatency = 0.050;  // seconds; shorter ones underrun at every load

HostTime host_now() noexcept { return std::chrono::time_point_cast<Nanos>(HostClock::now()); }

// A latency that PortAudio reports, or `otherwise` when it is not plausible.
double sane_latency(double seconds, double otherwise) {
    return std::isfinite(seconds) && seconds >= 0.0 && seconds <= kMostLatency ? seconds
                                                                               : otherwise;
}

// Sets an environment variable and restores it in the end. Safe as only the control thread opens
// devices.
class ScopedVariable {
 public:
    ScopedVariable(const char* name, const std::string& value) : name_(name) {
        // NOLINTNEXTLINE(concurrency-mt-unsafe): no other way to name a source to ALSA's plug-in
        if (const char* old = std::getenv(name)) {
            old_ = old;
        }
        setenv(name, value.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
    }
    ~ScopedVariable() {
        if (old_) {
            setenv(name_, old_->c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
        } else {
            unsetenv(name_);  // NOLINT(concurrency-mt-unsafe)
        }
    }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;

 private:
    const char* name_;
    std::optional<std::string> old_;
};

}  // namespace

struct DeviceStream::Impl {
    enum class Direction { input, output };

    CallbackGate gate;
    Direction direction = Direction::input;
    PaStream* stream = nullptr;
    int channels = 2;
    SampleRate rate{48'000};
    Nanos latency{0};
    Nanos dead_after = kDeadAfter;
    bool is_abandoned = false;
    HostTime started{};
    std::int64_t frames = 0;  // counted by the callback alone
    // Relaxed order is enough: each value is a statistic or a sign of life by itself; no other data
    // is published by it.
    std::atomic<std::uint64_t> callbacks{0};
    std::atomic<std::uint64_t> xruns{0};
    std::atomic<std::int64_t> last_callback_ns{0};
    std::atomic<int> block_frames{0};
    std::atomic<pthread_t> thread{};  // of the callback, for scheduling()

    static int on_block(const void* input,
                        void* output,
                        unsigned long frame_count,
                        const PaStreamCallbackTimeInfo* time,
                        PaStreamCallbackFlags flags,
                        void* self) noexcept;
    Expected<void> open(const AudioDevice& device, const StreamConfig& config);
    PaError try_open(const AudioDevice& device, int channel_count, double hertz, double latency);
    [[nodiscard]] double latency_for(const AudioDevice& device, const StreamConfig& config) const;
    void close() noexcept;
};

// The device's audio thread: keeps the statistics, then passes the block on through the gate.
int DeviceStream::Impl::on_block(const void* input,
                                 void* output,
                                 unsigned long frame_count,
                                 const PaStreamCallbackTimeInfo*,
                                 PaStreamCallbackFlags flags,
                                 void* self) noexcept {
    const FlushToZeroScope flush_to_zero;
    Impl& me = *static_cast<Impl*>(self);
    const HostTime now = host_now();
    constexpr PaStreamCallbackFlags kXrun =
        paInputOverflow | paInputUnderflow | paOutputUnderflow | paOutputOverflow;
    const BlockTime time{.first_frame = me.frames, .entered = now, .is_xrun = (flags & kXrun) != 0};
    me.last_callback_ns.store(now.time_since_epoch().count(), std::memory_order_relaxed);
    me.block_frames.store(static_cast<int>(frame_count), std::memory_order_relaxed);
    me.thread.store(pthread_self(), std::memory_order_relaxed);
    me.callbacks.fetch_add(1, std::memory_order_relaxed);
    me.xruns.fetch_add(time.is_xrun ? 1 : 0, std::memory_order_relaxed);
    const std::size_t samples = frame_count * static_cast<std::size_t>(me.channels);
    if (me.direction == Direction::input && input != nullptr) {
        me.gate.on_input({static_cast<const float*>(input), samples}, me.channels, time);
    } else if (me.direction == Direction::output && output != nullptr) {
        const std::span<float> block(static_cast<float*>(output), samples);
        std::fill(block.begin(), block.end(), 0.0F);
        me.gate.on_output(block, me.channels, time);
    }
    me.frames += static_cast<std::int64_t>(frame_count);
    return paContinue;
}

// The latency to ask for. PulseAudio's own low default underruns, so sinks and monitors that go
// through it get 50 ms.
double DeviceStream::Impl::latency_for(const AudioDevice& device,
                                       const StreamConfig& config) const {
    if (config.latency_seconds > 0.0) {
        return std::min(config.latency_seconds, kMostLatency);
    }
    const PaDeviceInfo* info = Pa_GetDeviceInfo(device.portaudio_index);
    if (info == nullptr || device.is_monitor() || device.name == "pulse") {
        return kPulseLatency;
    }
    return sane_latency(direction == Direction::input ? info->defaultLowInputLatency
                                                      : info->defaultLowOutputLatency,
                        kPulseLatency);
}

// One attempt to open the device; leaves channels and rate as tried.
PaError DeviceStream::Impl::try_open(const AudioDevice& device,
                                     int channel_count,
                                     double hertz,
                                     double suggested) {
    const PaStreamParameters parameters{.device = device.portaudio_index,
                                        .channelCount = channel_count,
                                        .sampleFormat = paFloat32,
                                        .suggestedLatency = suggested,
                                        .hostApiSpecificStreamInfo = nullptr};
    const bool is_input = direction == Direction::input;
    channels = channel_count;
    rate = SampleRate(static_cast<int>(std::lround(hertz)));
    // Any block size: PortAudio adds a buffer of delay when one is asked for.
    return Pa_OpenStream(&stream,
                         is_input ? &parameters : nullptr,
                         is_input ? nullptr : &parameters,
                         hertz,
                         paFramesPerBufferUnspecified,
                         paNoFlag,
                         &Impl::on_block,
                         this);
}

Expected<void> DeviceStream::Impl::open(const AudioDevice& device, const StreamConfig& config) {
    const bool is_input = direction == Direction::input;
    const int most = is_input ? device.input_channels : device.output_channels;
    const auto unusable = [&](const std::string& why) {
        return fail("device '" + device.name + "' (" + device.host_api + ", " +
                    std::to_string(device.input_channels) + " in, " +
                    std::to_string(device.output_channels) + " out, " +
                    std::to_string(std::lround(device.default_rate)) + " Hz) cannot be opened as " +
                    (is_input ? "input: " : "output: ") + why);
    };
    if (most < 1) {
        return unusable("it has no such channels");
    }
    const double suggested = latency_for(device, config);
    const double wanted_rate = config.rate_hz > 0 ? config.rate_hz : device.default_rate;
    const int wanted_channels = std::clamp(config.channels, 1, std::min(most, 8));
    PaError error = paInvalidSampleRate;
    // First the wanted rate and channels, then fewer or more channels, then the device's own rate:
    // each device refuses something else.
    for (const double hertz : {wanted_rate, device.default_rate}) {
        for (const int count : {wanted_channels, std::min(2, most), 1, std::min(most, 8)}) {
            error = error == paNoError ? error : try_open(device, count, hertz, suggested);
        }
    }
    if (error != paNoError) {
        return unusable(portaudio_reason(error));
    }
    // The device may run at another rate than asked for.
    const PaStreamInfo* info = Pa_GetStreamInfo(stream);
    if (info != nullptr) {
        const double said = is_input ? info->inputLatency : info->outputLatency;
        latency = nanos_from_seconds(sane_latency(said, suggested));
        rate = SampleRate(static_cast<int>(std::lround(info->sampleRate)));
    }
    if (error = Pa_StartStream(stream); error != paNoError) {
        Pa_CloseStream(stream);
        return unusable(portaudio_reason(error));
    }
    started = host_now();
    return {};
}

// Stops and closes on another thread, as these calls never return when the device dies meanwhile;
// then the thread and the stream are left behind.
void DeviceStream::Impl::close() noexcept {
    std::promise<void> promise;
    std::future<void> done = promise.get_future();
    std::thread([pa_stream = stream, promise = std::move(promise)]() mutable {
        Pa_StopStream(pa_stream);
        Pa_CloseStream(pa_stream);
        promise.set_value();
    }).detach();
    is_abandoned = done.wait_for(kCloseWithin) != std::future_status::ready;
}

DeviceStream::DeviceStream(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

// The gate first: whatever becomes of the stream, its callback is not called any more.
DeviceStream::~DeviceStream() {
    impl_->gate.close();
    if (!impl_->is_abandoned && !is_alive(host_now())) {
        abandon();
    }
    if (!impl_->is_abandoned) {
        impl_->close();
    }
    if (impl_->is_abandoned) {
        leak_portaudio();
        static_cast<void>(impl_.release());  // leaked: the device's thread may still use it
        return;
    }
    release_portaudio();
}

namespace {

// Opens PortAudio, applies the source variable while the device is opened, and keeps the libraries'
// messages off stderr. A template, as Impl is private to DeviceStream.
template <typename ImplType>
Expected<std::unique_ptr<ImplType>> open_impl(typename ImplType::Direction direction,
                                              const AudioDevice& device,
                                              const StreamConfig& config) {
    if (auto acquired = acquire_portaudio(); !acquired) {
        return fail(acquired.error());
    }
    auto impl = std::make_unique<ImplType>();
    impl->direction = direction;
    impl->dead_after = device.host_api == "JACK" ? kJackDeadAfter : kDeadAfter;
    std::optional<ScopedVariable> source;
    // ALSA's pulse plug-in reads the name of the source from the environment when it opens.
    if (device.is_monitor()) {
        source.emplace("PULSE_SOURCE", device.pulse_source);
    }
    const SilentStderr silence;
    if (auto opened = impl->open(device, config); !opened) {
        release_portaudio();
        return fail(opened.error());
    }
    return impl;
}

}  // namespace

Expected<std::unique_ptr<DeviceStream>> DeviceStream::open_input(const AudioDevice& device,
                                                                 const StreamConfig& config) {
    auto impl = open_impl<Impl>(Impl::Direction::input, device, config);
    if (!impl) {
        return fail(impl.error());
    }
    return std::unique_ptr<DeviceStream>(new DeviceStream(std::move(*impl)));
}

Expected<std::unique_ptr<DeviceStream>> DeviceStream::open_output(const AudioDevice& device,
                                                                  const StreamConfig& config) {
    auto impl = open_impl<Impl>(Impl::Direction::output, device, config);
    if (!impl) {
        return fail(impl.error());
    }
    return std::unique_ptr<DeviceStream>(new DeviceStream(std::move(*impl)));
}

void DeviceStream::connect(StreamCallback& callback) noexcept { impl_->gate.open(callback); }

SampleRate DeviceStream::rate() const noexcept { return impl_->rate; }
int DeviceStream::channels() const noexcept { return impl_->channels; }
Nanos DeviceStream::reported_latency() const noexcept { return impl_->latency; }

std::uint64_t DeviceStream::callbacks() const noexcept {
    return impl_->callbacks.load(std::memory_order_relaxed);
}

int DeviceStream::block_frames() const noexcept {
    return impl_->block_frames.load(std::memory_order_relaxed);
}

std::string DeviceStream::scheduling() const {
    if (callbacks() == 0 || !is_alive(host_now())) {
        return "unknown";
    }
    int policy = 0;
    sched_param parameters{};
    if (pthread_getschedparam(
            impl_->thread.load(std::memory_order_relaxed), &policy, &parameters) != 0) {
        return "unknown";
    }
    // With this flag JACK makes threads that its own start be of the ordinary class; it is not a
    // part of the class.
    switch (policy & ~SCHED_RESET_ON_FORK) {
        case SCHED_FIFO:
            return "SCHED_FIFO";
        case SCHED_RR:
            return "SCHED_RR";
        default:
            return "SCHED_OTHER";
    }
}

std::uint64_t DeviceStream::xruns() const noexcept {
    return impl_->xruns.load(std::memory_order_relaxed);
}

// Before the first callback the time since the start counts.
bool DeviceStream::is_alive(HostTime now) const noexcept {
    const std::int64_t last = impl_->last_callback_ns.load(std::memory_order_relaxed);
    const bool is_calling_back = last == 0 ? now - impl_->started <= kFirstCallbackWithin
                                           : now - HostTime(Nanos(last)) <= impl_->dead_after;
    return is_calling_back && !impl_->is_abandoned && Pa_IsStreamActive(impl_->stream) == 1;
}

void DeviceStream::abandon() noexcept {
    impl_->gate.close();
    impl_->is_abandoned = true;
    leak_portaudio();
}

// Without leaked streams an ordinary exit runs all destructors; with them only open files are
// flushed.
void end_process(int exit_code) noexcept {
    if (is_portaudio_leaked()) {
        std::fflush(nullptr);
        std::_Exit(exit_code);
    }
    std::exit(exit_code);  // NOLINT(concurrency-mt-unsafe)
}

}  // namespace raks::audio
