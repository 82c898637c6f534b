#include "audio/io/jack_loop.hpp"

#include <jack/jack.h>
#include <pa_jack.h>

#include <memory>
#include <string>

#include <fmt/format.h>

namespace raks::audio {
namespace {

// Deleters of JACK's objects.
struct CloseClient {
    void operator()(jack_client_t* client) const noexcept { jack_client_close(client); }
};
struct FreeNames {
    void operator()(const char** names) const noexcept { jack_free(static_cast<void*>(names)); }
};

// Removes all connections of an input port: other sources would mix with the loop's signal.
void disconnect_all(jack_client_t* client, const jack_port_t* input, const std::string& name) {
    const std::unique_ptr<const char*, FreeNames> sources(
        jack_port_get_all_connections(client, input));
    for (const char** source = sources.get(); source != nullptr && *source != nullptr; ++source) {
        jack_disconnect(client, *source, name.c_str());
    }
}

}  // namespace

// PortAudio names its ports NAME:out_0, NAME:in_0 and so on; a client of our own connects them.
Expected<int> connect_own_outputs_to_inputs() {
    const char* own_name = nullptr;
    if (PaJack_GetClientName(&own_name) != paNoError || own_name == nullptr) {
        return fail("JACK: no stream of ours runs there");
    }
    const std::unique_ptr<jack_client_t, CloseClient> client(
        jack_client_open("raks-loop", JackNoStartServer, nullptr));
    if (!client) {
        return fail("JACK: the server does not answer");
    }
    const std::string own(own_name);
    // Pairs until one side has no further port.
    int connected = 0;
    for (;; ++connected) {
        const std::string from = fmt::format("{}:out_{}", own, connected);
        const std::string to = fmt::format("{}:in_{}", own, connected);
        const jack_port_t* input = jack_port_by_name(client.get(), to.c_str());
        if (input == nullptr || jack_port_by_name(client.get(), from.c_str()) == nullptr) {
            break;
        }
        disconnect_all(client.get(), input, to);
        if (jack_connect(client.get(), from.c_str(), to.c_str()) != 0) {
            return fail(fmt::format("JACK: cannot connect {} to {}", from, to));
        }
    }
    if (connected == 0) {
        return fail("JACK: " + own + " has no output and input that could be connected");
    }
    return connected;
}

}  // namespace raks::audio
