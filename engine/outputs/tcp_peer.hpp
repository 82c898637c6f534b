#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/descriptor.hpp"
#include "engine/outputs/host_lookup.hpp"
#include "engine/outputs/output_target.hpp"

namespace raks::engine {

/// A connection to a server that gets messages, each by one write. It is made again where it ends:
/// after 0.5 s, 1 s, 2 s .. 10 s. Nothing here blocks; what the server says is read and thrown
/// away. Threads: one. Real-time: no (system calls).
class TcpPeer {
 public:
    explicit TcpPeer(HostPort place);  ///< looks the host up meanwhile

    /// Looks, connects, reads. Call it every few milliseconds.
    void turn(HostTime now);
    /// Whether a message can be tried.
    [[nodiscard]] bool is_connected() const noexcept { return stage_ == Stage::connected; }
    /// One message, at once and whole. False: it is lost, as there is no connection or the server
    /// does not read; after a part of it the connection is made anew.
    [[nodiscard]] bool send(std::string_view message, HostTime now);
    /// What is wrong, once: the first time that something is.
    [[nodiscard]] std::optional<std::string> take_trouble();

 private:
    enum class Stage { waiting, looking, connecting, connected };

    void look(HostTime now);
    void connect(const SocketAddress& address, HostTime now);
    void await_connection(HostTime now);
    void read_away(HostTime now);
    void lose(HostTime now, const std::string& why);
    void complain(const std::string& why);

    HostPort place_;
    Stage stage_ = Stage::waiting;
    std::optional<HostLookup> lookup_;
    HostTime next_step_{};  // waiting: when it is tried again; connecting: when it is given up
    Nanos patience_;        // before the next try
    Descriptor socket_;
    bool has_complained_ = false;
    std::optional<std::string> trouble_;
};

}  // namespace raks::engine
