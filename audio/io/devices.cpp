#include "audio/io/devices.hpp"

#include <portaudio.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "audio/io/portaudio_session.hpp"
#include "audio/io/pulse_monitors.hpp"

namespace raks::audio {
namespace {

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
