#include "audio/io/pulse_devices.hpp"

#include <pulse/pulseaudio.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

#include "audio/io/deadline.hpp"
#include "audio/io/pulse_connection.hpp"

namespace raks::audio {
namespace {

PulseConnection::Deadline patience() { return std::chrono::steady_clock::now() + kServerPatience; }

// What the server says about itself.
struct Server {
    std::string default_sink;
    std::string default_source;
    std::string software = "PulseAudio";
};

void take_server(pa_context*, const pa_server_info* info, void* data) {
    Server& server = *static_cast<Server*>(data);
    if (info == nullptr) {
        return;
    }
    const auto text = [](const char* from) { return from != nullptr ? from : ""; };
    server.default_sink = text(info->default_sink_name);
    server.default_source = text(info->default_source_name);
    const bool is_pipewire =
        std::string_view(text(info->server_name)).find("PipeWire") != std::string_view::npos;
    server.software = is_pipewire ? "PipeWire" : "PulseAudio";
}

// The parts that sinks and sources have in common.
template <typename Info>
AudioDevice device_of(const Info& info) {
    const bool is_described = info.description != nullptr && *info.description != '\0';
    return {.system = AudioSystemKind::pulse,
            .name = is_described ? info.description : info.name,
            .id = info.name,
            .default_rate = static_cast<double>(
                std::clamp<std::uint32_t>(info.sample_spec.rate, 8'000, 192'000))};
}

void take_sink(pa_context*, const pa_sink_info* info, int, void* devices) {
    if (info != nullptr && info->name != nullptr) {
        AudioDevice device = device_of(*info);
        device.output_channels = info->sample_spec.channels;
        static_cast<std::vector<AudioDevice>*>(devices)->push_back(device);
    }
}

void take_source(pa_context*, const pa_source_info* info, int, void* devices) {
    if (info != nullptr && info->name != nullptr) {
        AudioDevice device = device_of(*info);
        device.input_channels = info->sample_spec.channels;
        device.is_monitor = info->monitor_of_sink != PA_INVALID_INDEX;
        // The sink's id; finish_list() puts its name there.
        if (device.is_monitor && info->monitor_of_sink_name != nullptr) {
            device.monitor_of = info->monitor_of_sink_name;
        }
        static_cast<std::vector<AudioDevice>*>(devices)->push_back(device);
    }
}

// Marks the defaults, known only when all answers are in, and sorts.
void finish_list(const Server& server, std::vector<AudioDevice>& devices) {
    for (AudioDevice& device : devices) {
        const bool is_input = device.input_channels > 0;
        device.is_default_output = !is_input && device.id == server.default_sink;
        device.is_default_input = device.is_monitor
                                      ? device.monitor_of == server.default_sink
                                      : is_input && device.id == server.default_source;
        device.host_api = server.software;
        const auto sink = std::find_if(devices.begin(), devices.end(), [&](const AudioDevice& d) {
            return d.output_channels > 0 && d.id == device.monitor_of;
        });
        device.monitor_of = device.is_monitor && sink != devices.end() ? sink->name : "";
    }
    // Stable: the others keep the server's order.
    const auto rank = [](const AudioDevice& device) {
        const bool is_default = device.is_default_input || device.is_default_output;
        return (device.is_monitor ? 0 : 2) + (is_default ? 0 : 1);
    };
    std::stable_sort(devices.begin(), devices.end(), [&](const auto& a, const auto& b) {
        return rank(a) < rank(b);
    });
    // The mark put the default sink's monitor first; the default input is a microphone.
    for (AudioDevice& device : devices) {
        device.is_default_input = device.is_default_input && !device.is_monitor;
    }
}

}  // namespace

Expected<std::vector<AudioDevice>> list_pulse_devices() {
    const PulseConnection::Deadline deadline = patience();
    PulseConnection connection("Raks");
    const auto no_reply = [] {
        return fail(
            "the sound server (PulseAudio or PipeWire) accepts but does not answer "
            "(2 s waited); start it again, or choose another with --audio-system");
    };
    switch (connection.connect(deadline)) {
        case PulseConnection::Result::absent:
            return std::vector<AudioDevice>();
        case PulseConnection::Result::no_reply:
            return no_reply();
        default:
            break;
    }
    Server server;
    std::vector<AudioDevice> devices;
    pa_context* const context = connection.context();
    const bool is_answered =
        connection.finish(pa_context_get_server_info(context, take_server, &server), deadline) &&
        connection.finish(pa_context_get_source_info_list(context, take_source, &devices),
                          deadline) &&
        connection.finish(pa_context_get_sink_info_list(context, take_sink, &devices), deadline);
    if (!is_answered) {
        return connection.is_good() ? Expected<std::vector<AudioDevice>>(no_reply())
                                    : std::vector<AudioDevice>();
    }
    finish_list(server, devices);
    return devices;
}

namespace {

// A sink that plays from a long buffer passes it on in pieces as long as that.
constexpr std::chrono::milliseconds kListenFor(2000);
constexpr float kLeastPeak = 1e-3F;  // -60 dBFS

// A stream that asks the server for the peaks of a source alone: 50 a second.
class PeakMeter {
 public:
    PeakMeter(pa_context* context, const std::string& source) {
        const pa_sample_spec peaks{.format = PA_SAMPLE_FLOAT32NE, .rate = 50, .channels = 1};
        stream_.reset(pa_stream_new(context, "level", &peaks, nullptr));
        pa_buffer_attr small{};
        small.maxlength = small.fragsize = sizeof(float);
        if (stream_) {
            pa_stream_connect_record(
                stream_.get(),
                source.c_str(),
                &small,
                static_cast<pa_stream_flags_t>(PA_STREAM_PEAK_DETECT | PA_STREAM_DONT_MOVE |
                                               PA_STREAM_ADJUST_LATENCY));
        }
    }

    // Takes what has come; returns the highest peak since the start.
    float highest() {
        while (stream_ && pa_stream_get_state(stream_.get()) == PA_STREAM_READY &&
               pa_stream_readable_size(stream_.get()) > 0) {
            const void* data = nullptr;
            std::size_t bytes = 0;
            if (pa_stream_peek(stream_.get(), &data, &bytes) < 0 || bytes == 0) {
                break;
            }
            const auto* const peaks = static_cast<const float*>(data);
            for (std::size_t i = 0; peaks != nullptr && i < bytes / sizeof(float); ++i) {
                highest_ = std::max(highest_, std::abs(peaks[i]));
            }
            pa_stream_drop(stream_.get());
        }
        return highest_;
    }

 private:
    struct Free {
        void operator()(pa_stream* stream) const noexcept {
            pa_stream_disconnect(stream);
            pa_stream_unref(stream);
        }
    };
    std::unique_ptr<pa_stream, Free> stream_;
    float highest_ = 0.0F;
};

}  // namespace

std::optional<AudioDevice> other_monitor_with_sound(const std::string& except) {
    auto devices = list_pulse_devices();
    PulseConnection connection("Raks");
    if (!devices || connection.connect(patience()) != PulseConnection::Result::connected) {
        return std::nullopt;
    }
    std::erase_if(*devices, [&](const AudioDevice& device) {
        return !device.is_monitor || device.id == except;
    });
    std::vector<PeakMeter> meters;
    for (const AudioDevice& device : *devices) {
        meters.emplace_back(connection.context(), device.id);
    }
    const auto end = std::chrono::steady_clock::now() + kListenFor;
    while (!meters.empty() && connection.is_good() && connection.step(end)) {
        const auto loud = std::find_if(meters.begin(), meters.end(), [](PeakMeter& meter) {
            return meter.highest() >= kLeastPeak;
        });
        if (loud != meters.end()) {
            return (*devices)[static_cast<std::size_t>(loud - meters.begin())];
        }
    }
    return std::nullopt;
}

}  // namespace raks::audio
