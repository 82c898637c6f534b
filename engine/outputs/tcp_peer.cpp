#include "engine/outputs/tcp_peer.hpp"

#include <netinet/tcp.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace raks::engine {
namespace {

constexpr Nanos kFirstPatience = std::chrono::milliseconds(500);
constexpr Nanos kLongestPatience = std::chrono::seconds(10);
constexpr Nanos kConnectsFor = std::chrono::seconds(5);
constexpr std::size_t kMostRead = 65'536;  // bytes at a turn

std::string words_of(int error) { return std::generic_category().message(error); }

}  // namespace

TcpPeer::TcpPeer(HostPort place) : place_(std::move(place)), patience_(kFirstPatience) {
    turn(host_now());
}

std::optional<std::string> TcpPeer::take_trouble() { return std::exchange(trouble_, std::nullopt); }

void TcpPeer::lose(HostTime now, const std::string& why) {
    socket_.close();
    lookup_.reset();
    stage_ = Stage::waiting;
    next_step_ = now + patience_;
    patience_ = std::min(2 * patience_, kLongestPatience);
    complain(why + "; it is tried again, in silence");
}

void TcpPeer::complain(const std::string& why) {
    if (!std::exchange(has_complained_, true)) {
        trouble_ = place_.text() + ": " + why;
    }
}

void TcpPeer::turn(HostTime now) {
    switch (stage_) {
        case Stage::waiting:
            if (now >= next_step_) {
                lookup_.emplace(place_);
                stage_ = Stage::looking;
                look(now);
            }
            break;
        case Stage::looking:
            look(now);
            break;
        case Stage::connecting:
            await_connection(now);
            break;
        case Stage::connected:
            read_away(now);
            break;
    }
}

void TcpPeer::look(HostTime now) {
    const auto found = lookup_->found();
    if (!found) {
        return;
    }
    *found ? connect(**found, now) : lose(now, found->error().message);
}

void TcpPeer::connect(const SocketAddress& address, HostTime now) {
    socket_ = Descriptor(
        socket(address.storage.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    const int yes = 1;
    setsockopt(socket_.number, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
    if (::connect(socket_.number, address.get(), address.length) != 0 && errno != EINPROGRESS) {
        lose(now, words_of(errno));
        return;
    }
    stage_ = Stage::connecting;
    next_step_ = now + kConnectsFor;
}

void TcpPeer::await_connection(HostTime now) {
    pollfd state{socket_.number, POLLOUT, 0};
    if (poll(&state, 1, 0) == 0) {
        if (now >= next_step_) {
            lose(now, "no answer");
        }
        return;
    }
    int error = 0;
    socklen_t size = sizeof(error);
    getsockopt(socket_.number, SOL_SOCKET, SO_ERROR, &error, &size);
    if (error != 0) {
        lose(now, words_of(error));
        return;
    }
    stage_ = Stage::connected;
    patience_ = kFirstPatience;
}

void TcpPeer::read_away(HostTime now) {
    std::array<char, 4096> thrown_away{};
    for (std::size_t all = 0; all < kMostRead;) {
        const ssize_t got = recv(socket_.number, thrown_away.data(), thrown_away.size(), 0);
        if (got > 0) {
            all += static_cast<std::size_t>(got);
            continue;
        }
        if (got == 0) {
            lose(now, "it has closed the connection");
        } else if (errno != EAGAIN && errno != EINTR) {
            lose(now, words_of(errno));
        }
        return;
    }
}

bool TcpPeer::send(std::string_view message, HostTime now) {
    if (!is_connected()) {
        return false;
    }
    const ssize_t sent = ::send(socket_.number, message.data(), message.size(), MSG_NOSIGNAL);
    if (sent == static_cast<ssize_t>(message.size())) {
        return true;
    }
    if (sent >= 0) {
        lose(now, "it does not read");
    } else if (errno == EAGAIN) {
        complain("it does not read");
    } else {
        lose(now, words_of(errno));
    }
    return false;
}

}  // namespace raks::engine
