#include "tests/support/peers.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace raks::test {
namespace {

constexpr int kPatienceMs = 10'000;

// Bound to 127.0.0.1; the port that it got.
std::uint16_t bind_here(int file, std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    const int yes = 1;
    setsockopt(file, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    socklen_t length = sizeof(address);
    if (bind(file, reinterpret_cast<sockaddr*>(&address), length) != 0 ||
        getsockname(file, reinterpret_cast<sockaddr*>(&address), &length) != 0) {
        throw std::system_error(errno, std::generic_category(), "bind");
    }
    return ntohs(address.sin_port);
}

bool is_readable(int file) {
    pollfd state{file, POLLIN, 0};
    return poll(&state, 1, kPatienceMs) > 0;
}

}  // namespace

UdpReceiver::UdpReceiver(std::uint16_t port)
    : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    const int room = 4 << 20;
    setsockopt(socket_.number, SOL_SOCKET, SO_RCVBUFFORCE, &room, sizeof(room));
    setsockopt(socket_.number, SOL_SOCKET, SO_RCVBUF, &room, sizeof(room));
    port_ = bind_here(socket_.number, port);
}

std::string UdpReceiver::place() const { return "127.0.0.1:" + std::to_string(port_); }

std::vector<std::string> UdpReceiver::take_all() {
    std::vector<std::string> all;
    std::array<char, 65'536> part{};
    for (;;) {
        const ssize_t got = recv(socket_.number, part.data(), part.size(), MSG_DONTWAIT);
        if (got < 0) {
            return all;
        }
        all.emplace_back(part.data(), static_cast<std::size_t>(got));
    }
}

TcpListener::TcpListener(std::uint16_t port)
    : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    port_ = bind_here(socket_.number, port);
    if (listen(socket_.number, 4) != 0) {
        throw std::system_error(errno, std::generic_category(), "listen");
    }
}

std::string TcpListener::place() const { return "127.0.0.1:" + std::to_string(port_); }

bool TcpListener::accept() {
    if (!is_readable(socket_.number)) {
        return false;
    }
    connection_ = Descriptor(::accept4(socket_.number, nullptr, nullptr, SOCK_CLOEXEC));
    return connection_.number >= 0;
}

std::string TcpListener::read() {
    std::array<char, 65'536> part{};
    if (!is_readable(connection_.number)) {
        return {};
    }
    const ssize_t got = recv(connection_.number, part.data(), part.size(), 0);
    return got > 0 ? std::string(part.data(), static_cast<std::size_t>(got)) : std::string();
}

void TcpListener::write(const std::string& text) {
    static_cast<void>(send(connection_.number, text.data(), text.size(), MSG_NOSIGNAL));
}

}  // namespace raks::test
