#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <memory>
#include <optional>

#include "base/expected.hpp"
#include "engine/outputs/output_target.hpp"

namespace raks::engine {

/// An address as sockets take it.
struct SocketAddress {
    sockaddr_storage storage{};  ///< of IPv4 or IPv6
    socklen_t length = 0;        ///< of what counts of it

    /// As the calls want it.
    [[nodiscard]] const sockaddr* get() const noexcept {
        return reinterpret_cast<const sockaddr*>(&storage);
    }
};

/// A host that is looked up. Names are asked for on a thread of their own, since that may take
/// seconds; addresses are known at once.
/// Threads: one. Real-time: no.
class HostLookup {
 public:
    /// Begins to look.
    explicit HostLookup(const HostPort& place);

    /// What was found; nothing: not known yet. Errors: the name is not known.
    [[nodiscard]] std::optional<Expected<SocketAddress>> found() const;

 private:
    struct Answer;
    std::shared_ptr<Answer> answer_;  // also of the thread, which may outlive this
};

}  // namespace raks::engine
