#include "engine/outputs/udp_peer.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

namespace raks::engine {
namespace {

constexpr Nanos kLooksAgainAfter = std::chrono::seconds(10);

std::string in_words(int error) { return std::generic_category().message(error); }

}  // namespace

UdpPeer::UdpPeer(HostPort place) : place_(std::move(place)), lookup_(place_) { turn(host_now()); }

void UdpPeer::complain(const std::string& what) {
    if (!std::exchange(has_complained_, true)) {
        trouble_ = place_.text() + ": " + what;
    }
}

std::optional<std::string> UdpPeer::take_trouble() { return std::exchange(trouble_, std::nullopt); }

void UdpPeer::turn(HostTime now) {
    if (socket_.number >= 0) {
        return;
    }
    if (!lookup_ && now >= looks_again_) {
        lookup_.emplace(place_);
    }
    if (!lookup_) {
        return;
    }
    if (const auto found = lookup_->found()) {
        lookup_.reset();
        looks_again_ = now + kLooksAgainAfter;
        *found ? open(**found) : complain(found->error().message + "; it is sought again");
    }
}

// Connected, so that the system tells when nobody listens there.
void UdpPeer::open(const SocketAddress& address) {
    socket_ =
        Descriptor(socket(address.storage.ss_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (socket_.number < 0 || connect(socket_.number, address.get(), address.length) != 0) {
        complain(in_words(errno));
        socket_.close();
    }
}

bool UdpPeer::send(std::span<const char> datagram) {
    if (socket_.number < 0) {
        return false;
    }
    const auto send_it = [&] {
        return ::send(socket_.number, datagram.data(), datagram.size(), MSG_NOSIGNAL) >= 0;
    };
    if (send_it()) {
        return true;
    }
    // The error is of the datagram before; this one is still to go.
    const int error = errno;
    if (error == ECONNREFUSED) {
        complain("nobody listens there; it is sent on");
        static_cast<void>(send_it());
    } else if (error != EAGAIN && error != ENOBUFS) {
        complain(in_words(error) + "; it is sent on");
    }
    return false;
}

}  // namespace raks::engine
