#pragma once

#include <memory>
#include <string>
#include <vector>

#include "audio/io/devices.hpp"
#include "base/expected.hpp"

struct _jack_client;  // NOLINT(bugprone-reserved-identifier): libjack's jack_client_t

namespace raks::audio {

/// Closes a client; gives up after a second, as that waits for the server.
struct CloseJackClient {
    /// For std::unique_ptr.
    void operator()(_jack_client* client) const noexcept;
};
/// A connection to the JACK server.
using JackClient = std::unique_ptr<_jack_client, CloseJackClient>;

/// Connects to the running server; never starts one, and prints nothing. Null: none is running.
/// Errors: it does not answer within 2 s. Threads: one at a time. Real-time: no.
[[nodiscard]] Expected<JackClient> open_jack_client(const std::string& name);

/// Names of the audio ports of client `client`, in the server's order. `wants_outputs`: those that
/// sound comes out of (they are connected to an input of ours).
[[nodiscard]] std::vector<std::string> jack_ports(_jack_client* connection,
                                                  const std::string& client,
                                                  bool wants_outputs);

/// Every client that has audio ports, as a device: `system` first. Empty: no server is running.
/// Errors: it does not answer within 2 s. Threads: one at a time. Real-time: no.
[[nodiscard]] Expected<std::vector<AudioDevice>> list_jack_devices();

}  // namespace raks::audio
