#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "engine/control/request_inbox.hpp"
#include "engine/remote/listen_place.hpp"
#include "engine/remote/remote_message.hpp"

namespace raks::engine {

/// Requests that come by HTTP and WebSocket, and the page for phones; docs/using/remote.md has the
/// protocol. Who may is for RemoteGuard to say. It serves no file, and takes none.
///
/// Threads: main, for all methods; it has threads of its own, one a connection.
class RemoteServer {
 public:
    static constexpr int kMostConnections = 8;              ///< the next one is refused (503)
    static constexpr std::size_t kLongestRequest = 65'536;  ///< bytes of a body or a message
    static constexpr double kMostMessages = 50.0;  ///< a second and a page; then it is closed
    /// The port where none is named.
    static constexpr std::uint16_t kUsualPort = 7880;

    /// Whether its library is in this program.
    [[nodiscard]] static bool is_built() noexcept;
    /// Opens the port. `token`: see RemoteGuard; `inbox` must outlive it. Errors: the program was
    /// built without it; the system's, such as a port that is taken.
    [[nodiscard]] static Expected<std::unique_ptr<RemoteServer>> open(const ListenPlace& place,
                                                                      const std::string& token,
                                                                      RequestInbox& inbox);
    virtual ~RemoteServer() = default;                      ///< ends all connections
    RemoteServer(const RemoteServer&) = delete;             ///< its threads refer to it
    RemoteServer& operator=(const RemoteServer&) = delete;  ///< likewise

    /// Where it listens; the port that the system chose.
    [[nodiscard]] virtual const ListenPlace& place() const noexcept = 0;
    /// From now on `GET /state` and pages are told this.
    virtual void publish(const RemoteState& state) = 0;
    /// Pages are told once, where it is another one.
    virtual void publish(const RemoteChoices& choices) = 0;
    /// Pages that are connected.
    [[nodiscard]] virtual int pages() const noexcept = 0;

 protected:
    RemoteServer() = default;
};

/// The link that opens the page with its token, as another machine reaches it where it may: of
/// 0.0.0.0 the first address of this machine that others see.
[[nodiscard]] std::string remote_link(const ListenPlace& place, const std::string& token);

}  // namespace raks::engine
