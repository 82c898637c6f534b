#include "tests/support/bus_peer.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "base/descriptor.hpp"

namespace raks::test {
namespace {

struct CloseBus {
    void operator()(sd_bus* bus) const noexcept { sd_bus_close_unref(bus); }
};

void add_number(std::string& bytes, std::uint32_t number) {
    for (int shift = 0; shift < 32; shift += 8) {
        bytes += static_cast<char>(number >> shift);
    }
}

// A field of the header; they begin at multiples of 8.
void add_field(std::string& fields, char code, char type, std::string_view text) {
    fields.resize((fields.size() + 7) / 8 * 8);
    fields += {code, 1, type, 0};
    if (type == 'g') {
        fields += static_cast<char>(text.size());
    } else {
        add_number(fields, static_cast<std::uint32_t>(text.size()));
    }
    fields += text;
    fields += '\0';
}

// https://dbus.freedesktop.org/doc/dbus-specification.html, "Message Protocol".
std::string signal_of(std::string_view body) {
    std::string fields;
    add_field(fields, 1, 'o', "/org/mpris/MediaPlayer2");
    add_field(fields, 2, 's', "org.freedesktop.DBus.Properties");
    add_field(fields, 3, 's', "PropertiesChanged");
    add_field(fields, 8, 'g', "a{sv}as");
    std::string message("l\4\1\1", 4);
    add_number(message, static_cast<std::uint32_t>(body.size()));
    add_number(message, 1);
    add_number(message, static_cast<std::uint32_t>(fields.size()));
    message += fields;
    message.resize((message.size() + 7) / 8 * 8);
    return message += body;
}

struct Heard {
    const std::function<void(sd_bus_message*)>& read;
    bool is_there = false;
};

int on_message(sd_bus_message* message, void* heard_by, sd_bus_error* /*error*/) {
    Heard& heard = *static_cast<Heard*>(heard_by);
    heard.is_there = true;
    heard.read(message);
    return 1;
}

}  // namespace

bool with_player_message(std::string_view body, const std::function<void(sd_bus_message*)>& read) {
    // As much as a socket takes at once.
    constexpr std::size_t kMostBytes = 64 * 1024;
    std::array<int, 2> sockets{};
    if (body.size() > kMostBytes ||
        socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, sockets.data()) != 0) {
        return false;
    }
    const Descriptor peer(sockets[1]);
    const std::string said =
        "DATA\r\nOK 0123456789abcdef0123456789abcdef\r\nAGREE_UNIX_FD\r\n" + signal_of(body);
    sd_bus* opened = nullptr;
    if (sd_bus_new(&opened) < 0) {
        close(sockets[0]);
        return false;
    }
    const std::unique_ptr<sd_bus, CloseBus> bus(opened);
    Heard heard{read};
    if (sd_bus_set_fd(opened, sockets[0], sockets[0]) < 0 || sd_bus_start(opened) < 0 ||
        sd_bus_add_filter(opened, nullptr, on_message, &heard) < 0 ||
        write(peer.number, said.data(), said.size()) != static_cast<ssize_t>(said.size())) {
        return false;
    }
    constexpr int kMostTurns = 32;
    for (int i = 0; i < kMostTurns && !heard.is_there && sd_bus_process(opened, nullptr) >= 0;
         ++i) {
    }
    return heard.is_there;
}

}  // namespace raks::test
