#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/expected.hpp"

namespace raks::engine {

/// An address of this machine and a port of it.
struct ListenPlace {
    std::string address = "127.0.0.1";  ///< numeric, without brackets
    std::uint16_t port = 0;             ///< 0: the system chooses one

    /// "127.0.0.1:9000", "[::1]:9000".
    [[nodiscard]] std::string text() const;
    /// Whether no other machine reaches it.
    [[nodiscard]] bool is_loopback() const;
};

/// "9000", "0.0.0.0:9000", "[::1]:9000"; "0.0.0.0" and "::1" with a usual port. A number alone is a
/// port of 127.0.0.1. Errors: no numeric address, no port of 1 to 65535. Threads: any.
[[nodiscard]] Expected<ListenPlace> parse_listen_place(std::string_view text,
                                                       std::optional<std::uint16_t> usual_port);

/// A socket of `type` (SOCK_DGRAM, SOCK_STREAM) that is bound there and does not block. Errors: the
/// system's.
[[nodiscard]] Expected<int> bind_to(const ListenPlace& place, int type);

/// Connects to a TCP port without waiting, and lets go: who listens there looks up.
void knock_at(const ListenPlace& place);

/// The port that a socket is bound to; 0: none.
[[nodiscard]] std::uint16_t port_of_socket(int socket);

}  // namespace raks::engine
