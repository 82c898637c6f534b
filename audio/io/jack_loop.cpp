#include "audio/io/jack_loop.hpp"

#include <jack/jack.h>

#include <algorithm>
#include <string>
#include <vector>

#include "audio/io/jack_devices.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

// Other sources would mix with the loop's signal, and other sinks would count as its latency.
void disconnect_all(jack_client_t* client, const std::vector<std::string>& ports) {
    for (const std::string& port : ports) {
        // By name through our own connection: only a port's owner may call jack_port_disconnect().
        const jack_port_t* const found = jack_port_by_name(client, port.c_str());
        const char** const others =
            found == nullptr ? nullptr : jack_port_get_all_connections(client, found);
        for (const char** other = others; other != nullptr && *other != nullptr; ++other) {
            jack_disconnect(client, port.c_str(), *other);
            jack_disconnect(client, *other, port.c_str());
        }
        jack_free(static_cast<void*>(others));
    }
}

}  // namespace

Expected<int> connect_jack_loop(const DeviceStream& output, const DeviceStream& input) {
    if (output.client_name().empty() || input.client_name().empty()) {
        return fail("JACK: Raks does not both play and listen there (--audio-system jack)");
    }
    const auto client = open_jack_client("raks-loop");
    if (!client || !*client) {
        return fail("JACK: the server does not answer");
    }
    const auto from = jack_ports(client->get(), output.client_name(), true);
    const auto to = jack_ports(client->get(), input.client_name(), false);
    disconnect_all(client->get(), from);
    disconnect_all(client->get(), to);
    const std::size_t pairs = std::min(from.size(), to.size());
    for (std::size_t i = 0; i < pairs; ++i) {
        if (jack_connect(client->get(), from[i].c_str(), to[i].c_str()) != 0) {
            return fail(fmt::format("JACK: cannot connect {} to {}", from[i], to[i]));
        }
    }
    return pairs > 0 ? Expected<int>(static_cast<int>(pairs))
                     : fail("JACK: Raks has no ports to connect there");
}

}  // namespace raks::audio
