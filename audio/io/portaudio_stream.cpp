#include "audio/io/portaudio_stream.hpp"

#include <portaudio.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <thread>
#include <utility>

#include "audio/io/counted_blocks.hpp"
#include "audio/io/deadline.hpp"
#include "audio/io/portaudio_session.hpp"

namespace raks::audio {
namespace {

// Time without a callback after which a device counts as dead. JACK calls every few milliseconds,
// but may pause on an overloaded machine. A sound server behind ALSA may play out its own buffer
// first: pauses of 1.6 to 2.2 s were seen after the first callback.
constexpr Nanos kJackDeadAfter = std::chrono::milliseconds(1500);
constexpr Nanos kDeadAfter = std::chrono::seconds(3);
constexpr Nanos kFirstCallbackWithin = std::chrono::seconds(2);  // of the start
constexpr double kUsualLatency = 0.05;  // seconds; for devices that say nothing sane

// A latency that PortAudio reports, or `otherwise` when it is not plausible: PipeWire's was
// 89,478 s.
double sane_latency(double seconds, double otherwise) {
    return std::isfinite(seconds) && seconds >= 0.0 && seconds <= to_seconds(kMostLatency)
               ? seconds
               : otherwise;
}

// What PortAudio's thread uses, in memory that is leaked with a stream that cannot be stopped.
struct PortAudioLine {
    PortAudioLine(bool input, int channels) : is_input(input), blocks(channels) {}

    const bool is_input;
    CountedBlocks blocks;
};

// The device's audio thread.
int on_block(const void* input,
             void* output,
             unsigned long frame_count,
             const PaStreamCallbackTimeInfo*,
             PaStreamCallbackFlags flags,
             void* data) noexcept RAKS_NONBLOCKING {
    PortAudioLine& line = *static_cast<PortAudioLine*>(data);
    const HostTime entered = host_now();
    constexpr PaStreamCallbackFlags kXrun =
        paInputOverflow | paInputUnderflow | paOutputUnderflow | paOutputOverflow;
    if ((flags & kXrun) != 0) {
        line.blocks.note_xrun();
    }
    const std::size_t samples = frame_count * static_cast<std::size_t>(line.blocks.channels());
    if (line.is_input && input != nullptr) {
        line.blocks.take_input({static_cast<const float*>(input), samples}, entered);
    } else if (!line.is_input && output != nullptr) {
        line.blocks.take_output({static_cast<float*>(output), samples}, entered);
    }
    return paContinue;
}

// One attempt at a device: how it is asked for.
struct Attempt {
    PaDeviceIndex device = paNoDevice;
    bool is_input = false;
    int channels = 2;
    double hertz = 0.0;
    double latency = 0.0;
};

PaError open_stream(const Attempt& attempt, PortAudioLine& line, PaStream** stream) {
    const PaStreamParameters parameters{.device = attempt.device,
                                        .channelCount = attempt.channels,
                                        .sampleFormat = paFloat32,
                                        .suggestedLatency = attempt.latency,
                                        .hostApiSpecificStreamInfo = nullptr};
    // Any block size: PortAudio adds a buffer of delay when one is asked for.
    return Pa_OpenStream(stream,
                         attempt.is_input ? &parameters : nullptr,
                         attempt.is_input ? nullptr : &parameters,
                         attempt.hertz,
                         paFramesPerBufferUnspecified,
                         paNoFlag,
                         on_block,
                         &line);
}

class PortAudioStream final : public DeviceStream {
 public:
    PortAudioStream(std::shared_ptr<PortAudioLine> line,
                    PaStream* stream,
                    SampleRate rate,
                    Nanos heard_after,
                    Nanos dead_after)
        : DeviceStream(std::shared_ptr<CountedBlocks>(line, &line->blocks), rate),
          line_(std::move(line)),
          stream_(stream),
          heard_after_(heard_after),
          dead_after_(dead_after),
          started_(host_now()) {}

    // The gate first: whatever becomes of the stream, its callback is not called any more. Stopping
    // and closing never return when the device dies meanwhile; then the thread and the stream are
    // left behind.
    ~PortAudioStream() override {
        disconnect();
        const auto closed = within(kCloseWithin, [stream = stream_, line = line_] {
            Pa_StopStream(stream);
            return Pa_CloseStream(stream);
        });
        if (!closed) {
            leak_portaudio();
        }
        release_portaudio();
    }
    PortAudioStream(const PortAudioStream&) = delete;
    PortAudioStream& operator=(const PortAudioStream&) = delete;

    [[nodiscard]] Nanos heard_after() const noexcept RAKS_NONBLOCKING override {
        return heard_after_;
    }

    // Before the first callback the time since the start counts.
    [[nodiscard]] bool is_alive(HostTime now) const noexcept override {
        const bool is_calling_back = callbacks() == 0 ? now - started_ <= kFirstCallbackWithin
                                                      : now - blocks().last_block() <= dead_after_;
        return is_calling_back && Pa_IsStreamActive(stream_) == 1;
    }

 private:
    std::shared_ptr<PortAudioLine> line_;
    PaStream* stream_;
    Nanos heard_after_;
    Nanos dead_after_;
    HostTime started_;
};

// Opens and starts a stream in one way. Errors: PortAudio's number; the device stays closed.
tl::expected<std::unique_ptr<DeviceStream>, PaError> try_stream(const Attempt& attempt,
                                                                Nanos dead_after) {
    auto line = std::make_shared<PortAudioLine>(attempt.is_input, attempt.channels);
    PaStream* stream = nullptr;
    if (const PaError error = open_stream(attempt, *line, &stream); error != paNoError) {
        return tl::unexpected(error);
    }
    const PaError error = Pa_StartStream(stream);
    // The device may run at another rate than asked for.
    const PaStreamInfo* const info = Pa_GetStreamInfo(stream);
    if (error != paNoError || info == nullptr) {
        Pa_CloseStream(stream);
        return tl::unexpected(error);
    }
    // What PortAudio says of an input is the length of its buffer, not how old a block is.
    const double heard_after =
        attempt.is_input ? 0.0 : sane_latency(info->outputLatency, attempt.latency);
    return std::make_unique<PortAudioStream>(
        std::move(line),
        stream,
        SampleRate(static_cast<int>(std::lround(info->sampleRate))),
        nanos_from_seconds(heard_after),
        dead_after);
}

// Tries the wanted rate and channels, then fewer or more channels, then the device's own rate: each
// device refuses something else.
Expected<std::unique_ptr<DeviceStream>> open_any(bool is_input,
                                                 const AudioDevice& device,
                                                 const StreamConfig& config) {
    const int most = std::min(8, is_input ? device.input_channels : device.output_channels);
    const PaDeviceInfo* const device_info = Pa_GetDeviceInfo(device.portaudio_index);
    if (device_info == nullptr) {
        return fail("it is gone");
    }
    const double low =
        is_input ? device_info->defaultLowInputLatency : device_info->defaultLowOutputLatency;
    Attempt attempt{.device = device.portaudio_index,
                    .is_input = is_input,
                    .latency = config.latency_seconds > 0.0
                                   ? std::min(config.latency_seconds, to_seconds(kMostLatency))
                                   : sane_latency(low, kUsualLatency)};
    PaError error = paInvalidSampleRate;
    for (const double hertz :
         {config.rate_hz > 0 ? config.rate_hz : device.default_rate, device.default_rate}) {
        for (const int channels :
             {std::clamp(config.channels, 1, most), std::min(2, most), 1, most}) {
            attempt.hertz = hertz;
            attempt.channels = channels;
            auto stream =
                try_stream(attempt, device.host_api == "JACK" ? kJackDeadAfter : kDeadAfter);
            if (stream) {
                return std::move(*stream);
            }
            error = stream.error();
        }
    }
    return fail(portaudio_reason(error));
}

}  // namespace

Expected<std::unique_ptr<DeviceStream>> open_portaudio_stream(DeviceStream::Direction direction,
                                                              const AudioDevice& device,
                                                              const StreamConfig& config) {
    if (auto acquired = acquire_portaudio(); !acquired) {
        return fail(acquired.error());
    }
    const bool is_input = direction == DeviceStream::Direction::input;
    const SilentStderr silence;
    auto stream = open_any(is_input, device, config);
    if (!stream) {
        release_portaudio();
        return fail(stream.error());
    }
    return stream;
}

}  // namespace raks::audio
