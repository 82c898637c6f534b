#pragma once

#include <optional>
#include <span>
#include <string>

#include "base/descriptor.hpp"
#include "engine/outputs/host_lookup.hpp"
#include "engine/outputs/output_target.hpp"

namespace raks::engine {

/// Who gets datagrams. Nothing here blocks: what cannot be sent at once is lost, and what comes
/// back is never read. Threads: one. Real-time: no (system calls).
class UdpPeer {
 public:
    explicit UdpPeer(HostPort place);  ///< looks the host up meanwhile

    /// Goes on looking for the host, and again later where there is none. Call it now and then.
    void turn(HostTime now);
    /// One datagram. False: it is lost, as the host is not found yet, the system has no room, or
    /// nobody listened there when the one before came.
    [[nodiscard]] bool send(std::span<const char> datagram);
    /// What is wrong, once: the first time that something is.
    [[nodiscard]] std::optional<std::string> take_trouble();

 private:
    void open(const SocketAddress& address);
    void complain(const std::string& what);

    HostPort place_;
    std::optional<HostLookup> lookup_;
    HostTime looks_again_{};
    Descriptor socket_;
    bool has_complained_ = false;
    std::optional<std::string> trouble_;
};

}  // namespace raks::engine
