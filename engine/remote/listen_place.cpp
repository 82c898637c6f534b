#include "engine/remote/listen_place.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <system_error>

#include "base/descriptor.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

bool is_address(const std::string& text) {
    in6_addr room{};
    return inet_pton(AF_INET, text.c_str(), &room) == 1 ||
           inet_pton(AF_INET6, text.c_str(), &room) == 1;
}

Expected<std::uint16_t> port_of(std::string_view text) {
    std::uint16_t port = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (fault != std::errc() || end != text.data() + text.size() || port == 0) {
        return fail(fmt::format("port \"{}\" must be 1 to 65535", text));
    }
    return port;
}

socklen_t address_of(const ListenPlace& place, sockaddr_storage& room) {
    auto* const four = reinterpret_cast<sockaddr_in*>(&room);
    auto* const six = reinterpret_cast<sockaddr_in6*>(&room);
    if (inet_pton(AF_INET, place.address.c_str(), &four->sin_addr) == 1) {
        four->sin_family = AF_INET;
        four->sin_port = htons(place.port);
        return sizeof(sockaddr_in);
    }
    inet_pton(AF_INET6, place.address.c_str(), &six->sin6_addr);
    six->sin6_family = AF_INET6;
    six->sin6_port = htons(place.port);
    return sizeof(sockaddr_in6);
}

}  // namespace

std::string ListenPlace::text() const {
    const bool is_six = address.find(':') != std::string::npos;
    return is_six ? fmt::format("[{}]:{}", address, port) : fmt::format("{}:{}", address, port);
}

bool ListenPlace::is_loopback() const { return address == "::1" || address.starts_with("127."); }

Expected<ListenPlace> parse_listen_place(std::string_view text,
                                         std::optional<std::uint16_t> usual_port) {
    const bool is_port = !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return c >= '0' && c <= '9';
    });
    ListenPlace place;
    if (is_port) {
        const auto port = port_of(text);
        return port ? Expected<ListenPlace>(ListenPlace{place.address, *port}) : fail(port.error());
    }
    // Colons belong to the address where it has no brackets and more than one of them.
    const bool is_bare_six =
        !text.starts_with('[') && std::count(text.begin(), text.end(), ':') > 1;
    const std::size_t colon = is_bare_six ? std::string_view::npos : text.rfind(':');
    const std::size_t end_of_address =
        colon != std::string_view::npos && text.ends_with(']') ? text.size() : colon;
    place.address = std::string(text.substr(0, end_of_address));
    if (place.address.starts_with('[') && place.address.ends_with(']')) {
        place.address = place.address.substr(1, place.address.size() - 2);
    }
    if (!is_address(place.address)) {
        return fail(fmt::format(
            "\"{}\" is no numeric address of this machine, such as 127.0.0.1 or 0.0.0.0",
            place.address));
    }
    if (end_of_address >= text.size()) {
        if (!usual_port) {
            return fail("a port is missing: ADDRESS:PORT");
        }
        place.port = *usual_port;
        return place;
    }
    const auto port = port_of(text.substr(end_of_address + 1));
    if (!port) {
        return fail(port.error());
    }
    place.port = *port;
    return place;
}

Expected<int> bind_to(const ListenPlace& place, int type) {
    sockaddr_storage room{};
    const socklen_t size = address_of(place, room);
    Descriptor made(socket(room.ss_family, type | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    const int yes = 1;
    if (made.number >= 0 && type == SOCK_STREAM) {
        setsockopt(made.number, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    }
    if (made.number < 0 || bind(made.number, reinterpret_cast<const sockaddr*>(&room), size) != 0) {
        return fail(place.text() + ": " + std::generic_category().message(errno));
    }
    return made.release();
}

void knock_at(const ListenPlace& place) {
    sockaddr_storage room{};
    const socklen_t size = address_of(place, room);
    const Descriptor made(socket(room.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    static_cast<void>(connect(made.number, reinterpret_cast<const sockaddr*>(&room), size));
}

std::uint16_t port_of_socket(int socket) {
    sockaddr_storage room{};
    socklen_t size = sizeof(room);
    if (getsockname(socket, reinterpret_cast<sockaddr*>(&room), &size) != 0) {
        return 0;
    }
    return ntohs(room.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(room).sin6_port
                                            : reinterpret_cast<const sockaddr_in&>(room).sin_port);
}

}  // namespace raks::engine
