#include "audio/io/devices.hpp"

#include <poll.h>
#include <portaudio.h>
#include <pulse/pulseaudio.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "audio/io/portaudio_session.hpp"

namespace raks::audio {
namespace {

/// A PulseAudio source that carries what a sink plays.
struct PulseMonitor {
    std::string name;                 ///< "alsa_output.pci.monitor": what PULSE_SOURCE takes
    std::string description;          ///< "Monitor of Built-in Audio"
    bool is_of_default_sink = false;  ///< of the sink that plays by default
};

constexpr std::chrono::milliseconds kPatience(1000);  // for the whole exchange with the server

// One connection to the server. Its main loop is run step by step, so that it ends at the deadline
// even when the server does not answer.
class Conversation {
 public:
    Conversation()
        : loop_(pa_mainloop_new()),
          context_(pa_context_new(pa_mainloop_get_api(loop_.get()), "raks")),
          deadline_(std::chrono::steady_clock::now() + kPatience) {}

    ~Conversation() {
        pa_context_disconnect(context_.get());  // before the loop is freed
    }
    Conversation(const Conversation&) = delete;
    Conversation& operator=(const Conversation&) = delete;

    [[nodiscard]] pa_context* context() const noexcept { return context_.get(); }

    // NOAUTOSPAWN: asking for monitors must not start a server.
    [[nodiscard]] bool connect() {
        if (pa_context_connect(context_.get(), nullptr, PA_CONTEXT_NOAUTOSPAWN, nullptr) < 0) {
            return false;
        }
        while (pa_context_get_state(context_.get()) != PA_CONTEXT_READY) {
            if (PA_CONTEXT_IS_GOOD(pa_context_get_state(context_.get())) == 0 || !step()) {
                return false;
            }
        }
        return true;
    }

    // Runs the loop until `operation` is done or the deadline has passed.
    void finish(pa_operation* operation) {
        while (operation != nullptr && pa_operation_get_state(operation) == PA_OPERATION_RUNNING) {
            if (!step()) {
                pa_operation_cancel(operation);
                break;
            }
        }
        if (operation != nullptr) {
            pa_operation_unref(operation);
        }
    }

 private:
    // One turn of the loop of at most 50 ms; false at the deadline or on an error.
    [[nodiscard]] bool step() {
        constexpr int kStepMicroseconds = 50'000;
        return std::chrono::steady_clock::now() < deadline_ &&
               pa_mainloop_prepare(loop_.get(), kStepMicroseconds) >= 0 &&
               pa_mainloop_poll(loop_.get()) >= 0 && pa_mainloop_dispatch(loop_.get()) >= 0;
    }

    struct Free {
        void operator()(pa_mainloop* loop) const noexcept { pa_mainloop_free(loop); }
        void operator()(pa_context* context) const noexcept { pa_context_unref(context); }
    };
    std::unique_ptr<pa_mainloop, Free> loop_;
    std::unique_ptr<pa_context, Free> context_;
    std::chrono::steady_clock::time_point deadline_;
};

// Callback of the server's information: name of the default sink.
void take_server(pa_context*, const pa_server_info* info, void* default_sink) {
    if (info != nullptr && info->default_sink_name != nullptr) {
        *static_cast<std::string*>(default_sink) = info->default_sink_name;
    }
}

// A monitor and the sink it belongs to.
struct Found {
    PulseMonitor monitor;
    std::string sink;
};

// Callback of each source; sources that are no monitors (microphones) are left out.
void take_source(pa_context*, const pa_source_info* info, int, void* found) {
    if (info != nullptr && info->monitor_of_sink != PA_INVALID_INDEX && info->name != nullptr) {
        static_cast<std::vector<Found>*>(found)->push_back(
            {{info->name, info->description != nullptr ? info->description : info->name, false},
             info->monitor_of_sink_name != nullptr ? info->monitor_of_sink_name : ""});
    }
}

/// All monitors of the PulseAudio (or pipewire-pulse) server, the default sink's first; empty when
/// no server answers within a second. Never starts a server.
/// Threads: any. Real-time: no.
std::vector<PulseMonitor> list_pulse_monitors() {
    Conversation server;
    if (!server.connect()) {
        return {};
    }
    std::string default_sink;
    std::vector<Found> found;
    server.finish(pa_context_get_server_info(server.context(), take_server, &default_sink));
    server.finish(pa_context_get_source_info_list(server.context(), take_source, &found));
    std::vector<PulseMonitor> monitors;
    // Lists are compared after both answers: which sink is the default is known only then.
    for (Found& each : found) {
        each.monitor.is_of_default_sink = each.sink == default_sink;
        monitors.push_back(std::move(each.monitor));
    }
    // Stable: the others keep the server's order.
    std::stable_partition(monitors.begin(), monitors.end(), [](const PulseMonitor& monitor) {
        return monitor.is_of_default_sink;
    });
    return monitors;
}

constexpr const char* kPulseMonitorApi = "PulseAudio monitor";

// PortAudio's names are longer ("JACK Audio Connection Kit"); users see and type these.
std::string api_name(PaHostApiIndex index) {
    const PaHostApiInfo* info = Pa_GetHostApiInfo(index);
    if (info == nullptr) {
        return "unknown";
    }
    switch (info->type) {
        case paJACK:
            return "JACK";
        case paALSA:
            return "ALSA";
        case paOSS:
            return "OSS";
        default:
            return info->name;
    }
}

// All devices of PortAudio. A rate that cannot be meant becomes 48 kHz.
std::vector<AudioDevice> portaudio_devices() {
    std::vector<AudioDevice> devices;
    const PaDeviceIndex default_input = Pa_GetDefaultInputDevice();
    const PaDeviceIndex default_output = Pa_GetDefaultOutputDevice();
    for (PaDeviceIndex i = 0; i < Pa_GetDeviceCount(); ++i) {
        const PaDeviceInfo* info = Pa_GetDeviceInfo(i);
        if (info == nullptr) {
            continue;
        }
        const double rate = info->defaultSampleRate;
        const bool is_sane = std::isfinite(rate) && rate >= 8'000.0 && rate <= 192'000.0;
        devices.push_back({.portaudio_index = i,
                           .name = info->name,
                           .host_api = api_name(info->hostApi),
                           .input_channels = info->maxInputChannels,
                           .output_channels = info->maxOutputChannels,
                           .default_rate = is_sane ? rate : 48'000.0,
                           .is_default_input = i == default_input,
                           .is_default_output = i == default_output});
    }
    return devices;
}

// PulseAudio's monitors as devices. PortAudio does not list them; they are opened through ALSA's
// `pulse` device, without which there are none.
std::vector<AudioDevice> monitor_devices(const std::vector<AudioDevice>& devices) {
    const auto pulse = std::find_if(devices.begin(), devices.end(), [](const AudioDevice& device) {
        return device.host_api == "ALSA" && device.name == "pulse" && device.input_channels > 0;
    });
    std::vector<AudioDevice> monitors;
    if (pulse == devices.end()) {
        return monitors;
    }
    for (const PulseMonitor& monitor : list_pulse_monitors()) {
        monitors.push_back({.portaudio_index = pulse->portaudio_index,
                            .name = monitor.name,
                            .description = monitor.description,
                            .host_api = kPulseMonitorApi,
                            .input_channels = 2,  // a sink's monitor is recorded as stereo
                            .default_rate = pulse->default_rate,
                            .pulse_source = monitor.name});
    }
    return monitors;
}

// Order of the list: JACK, monitors, others.
int rank(const AudioDevice& device) {
    return device.host_api == "JACK" ? 0 : (device.is_monitor() ? 1 : 2);
}

// The list that users see; within one rank the order is PortAudio's.
std::vector<AudioDevice> all_devices() {
    const SilentStderr silence;
    std::vector<AudioDevice> devices = portaudio_devices();
    std::vector<AudioDevice> monitors = monitor_devices(devices);
    std::move(monitors.begin(), monitors.end(), std::back_inserter(devices));
    std::stable_sort(devices.begin(), devices.end(), [](const auto& a, const auto& b) {
        return rank(a) < rank(b);
    });
    return devices;
}

}  // namespace

Expected<AudioSystem> AudioSystem::open() {
    if (auto acquired = acquire_portaudio(); !acquired) {
        return fail(acquired.error());
    }
    AudioSystem system;
    system.is_open_ = true;
    system.devices_ = all_devices();
    return system;
}

AudioSystem::AudioSystem(AudioSystem&& other) noexcept
    : is_open_(std::exchange(other.is_open_, false)), devices_(std::move(other.devices_)) {}

AudioSystem& AudioSystem::operator=(AudioSystem&& other) noexcept {
    std::swap(is_open_, other.is_open_);
    devices_ = std::move(other.devices_);
    return *this;
}

AudioSystem::~AudioSystem() {
    if (is_open_) {
        release_portaudio();
    }
}

}  // namespace raks::audio
