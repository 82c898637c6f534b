#include "audio/io/jack_devices.hpp"

#include <jack/jack.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "audio/io/deadline.hpp"

namespace raks::audio {
namespace {

void print_nothing(const char*) {}

struct FreeNames {
    void operator()(const char** names) const noexcept { jack_free(static_cast<void*>(names)); }
};

// All audio ports with this flag: "system:capture_1".
std::vector<std::string> all_ports(jack_client_t* client, unsigned long flag) {
    const std::unique_ptr<const char*, FreeNames> names(
        jack_get_ports(client, nullptr, JACK_DEFAULT_AUDIO_TYPE, flag));
    std::vector<std::string> ports;
    for (const char** name = names.get(); name != nullptr && *name != nullptr; ++name) {
        ports.emplace_back(*name);
    }
    return ports;
}

std::string client_of(const std::string& port) { return port.substr(0, port.find(':')); }

// PipeWire shows a sink's monitor as a client of that name.
bool is_named_monitor(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return name.find("monitor") != std::string::npos;
}

// The list's entry for a client; made when it is not there yet.
AudioDevice& device_of(const std::string& client, int rate, std::vector<AudioDevice>& devices) {
    const auto found = std::find_if(devices.begin(), devices.end(), [&](const AudioDevice& device) {
        return device.name == client;
    });
    if (found != devices.end()) {
        return *found;
    }
    const bool is_system = client == "system";
    return devices.emplace_back(AudioDevice{.system = AudioSystemKind::jack,
                                            .name = client,
                                            .id = client,
                                            .host_api = "JACK",
                                            .default_rate = static_cast<double>(rate),
                                            .is_default_input = is_system,
                                            .is_default_output = is_system,
                                            .is_monitor = is_named_monitor(client)});
}

std::vector<AudioDevice> devices_seen_by(jack_client_t* client) {
    std::vector<AudioDevice> devices;
    const int rate = static_cast<int>(jack_get_sample_rate(client));
    for (const std::string& port : all_ports(client, JackPortIsOutput)) {
        ++device_of(client_of(port), rate, devices).input_channels;
    }
    for (const std::string& port : all_ports(client, JackPortIsInput)) {
        ++device_of(client_of(port), rate, devices).output_channels;
    }
    std::stable_partition(devices.begin(), devices.end(), [](const AudioDevice& device) {
        return device.is_default_input;
    });
    return devices;
}

}  // namespace

void CloseJackClient::operator()(_jack_client* client) const noexcept {
    static_cast<void>(within(kCloseWithin, [client] { return jack_client_close(client); }));
}

Expected<JackClient> open_jack_client(const std::string& name) {
    jack_set_error_function(print_nothing);
    jack_set_info_function(print_nothing);
    auto client = within(kServerPatience, [name] {
        return JackClient(jack_client_open(name.c_str(), JackNoStartServer, nullptr));
    });
    if (!client) {
        return fail("the JACK server does not answer (2 s waited); start it again");
    }
    return std::move(*client);
}

std::vector<std::string> jack_ports(_jack_client* connection,
                                    const std::string& client,
                                    bool wants_outputs) {
    std::vector<std::string> ports =
        all_ports(connection, wants_outputs ? JackPortIsOutput : JackPortIsInput);
    std::erase_if(ports, [&](const std::string& port) { return client_of(port) != client; });
    return ports;
}

Expected<std::vector<AudioDevice>> list_jack_devices() {
    const auto client = open_jack_client("raks-list");
    if (!client) {
        return fail(client.error());
    }
    return *client ? devices_seen_by(client->get()) : std::vector<AudioDevice>();
}

}  // namespace raks::audio
