#include "engine/players/player_bus.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

#include "engine/players/player_message.hpp"

namespace raks::engine {
namespace {

constexpr const char* kDBus = "org.freedesktop.DBus";
constexpr const char* kDBusPath = "/org/freedesktop/DBus";
constexpr const char* kProperties = "org.freedesktop.DBus.Properties";
constexpr std::string_view kPlayers = "org.mpris.MediaPlayer2.";
constexpr const char* kPlayerPath = "/org/mpris/MediaPlayer2";
constexpr const char* kPlayer = "org.mpris.MediaPlayer2.Player";
// Nobody waits for an answer; this only bounds how long one is expected.
constexpr std::uint64_t kPatienceUs = 30'000'000;

constexpr const char* kOwnerMatch =
    "type='signal',sender='org.freedesktop.DBus',interface='org.freedesktop.DBus',"
    "member='NameOwnerChanged',arg0namespace='org.mpris.MediaPlayer2'";
constexpr const char* kChangeMatch =
    "type='signal',interface='org.freedesktop.DBus.Properties',member='PropertiesChanged',"
    "path='/org/mpris/MediaPlayer2',arg0='org.mpris.MediaPlayer2.Player'";
constexpr const char* kSeekMatch =
    "type='signal',interface='org.mpris.MediaPlayer2.Player',member='Seeked',"
    "path='/org/mpris/MediaPlayer2'";

PlayerBus& bus_of(void* self) { return *static_cast<PlayerBus*>(self); }

}  // namespace

Expected<void> PlayerBus::open() {
    sd_bus* bus = nullptr;
    const int opened = sd_bus_open_user(&bus);
    bus_.reset(bus);
    if (opened < 0) {
        return fail("no session bus: " + (opened == -ENOMEDIUM
                                              ? "DBUS_SESSION_BUS_ADDRESS is not set"
                                              : std::generic_category().message(-opened)));
    }
    return listen() ? Expected<void>() : fail("the session bus refuses to be listened to");
}

// Signals first, so that no player is missed between the list and them.
bool PlayerBus::listen() {
    sd_bus* const bus = bus_.get();
    return sd_bus_set_method_call_timeout(bus, kPatienceUs) >= 0 &&
           sd_bus_add_match_async(bus, nullptr, kOwnerMatch, on_owner, nullptr, this) >= 0 &&
           sd_bus_add_match_async(bus, nullptr, kChangeMatch, on_change, nullptr, this) >= 0 &&
           sd_bus_add_match_async(bus, nullptr, kSeekMatch, on_seek, nullptr, this) >= 0 &&
           sd_bus_call_method_async(
               bus, nullptr, kDBus, kDBusPath, kDBus, "ListNames", on_names, this, "") >= 0;
}

Expected<bool> PlayerBus::turn(HostTime now) {
    now_ = now;
    const int result = sd_bus_process(bus_.get(), nullptr);
    if (result < 0) {
        return fail("the session bus has ended the connection: " +
                    std::generic_category().message(-result));
    }
    return result > 0;
}

PlayerBus::Wait PlayerBus::wait() const {
    std::uint64_t until_us = 0;
    const int events = sd_bus_get_events(bus_.get());
    const bool has_end = sd_bus_get_timeout(bus_.get(), &until_us) >= 0 && until_us != UINT64_MAX;
    return {sd_bus_get_fd(bus_.get()),
            static_cast<short>(events < 0 ? 0 : events),
            has_end ? std::optional(HostTime(std::chrono::microseconds(until_us))) : std::nullopt};
}

int PlayerBus::on_names(sd_bus_message* message, void* self, sd_bus_error* /*error*/) {
    const char* name = nullptr;
    if (sd_bus_message_is_method_error(message, nullptr) != 0 ||
        sd_bus_message_enter_container(message, 'a', "s") <= 0) {
        return 0;
    }
    while (sd_bus_message_read_basic(message, 's', &name) > 0) {
        if (std::string_view(name).starts_with(kPlayers)) {
            bus_of(self).meet(name, {}, PlayerList::Arrival::was_there);
        }
    }
    return 0;
}

int PlayerBus::on_owner(sd_bus_message* message, void* self, sd_bus_error* /*error*/) {
    const char* name = nullptr;
    const char* before = nullptr;
    const char* owner = nullptr;
    if (sd_bus_message_read(message, "sss", &name, &before, &owner) <= 0 ||
        !std::string_view(name).starts_with(kPlayers)) {
        return 0;
    }
    PlayerBus& bus = bus_of(self);
    if (*owner == '\0') {
        bus.known_.erase(name);
        bus.list_.leave(name);
    } else {
        bus.meet(name, owner, PlayerList::Arrival::came);
    }
    return 0;
}

// A name that has another owner is another player.
void PlayerBus::meet(std::string_view name, std::string_view owner, PlayerList::Arrival how) {
    const auto before = known_.find(name);
    if (before != known_.end()) {
        if (owner.empty()) {
            return;  // it came while the list was on its way
        }
        known_.erase(before);
    }
    if (!list_.arrive(name, how, now_)) {
        return;
    }
    Known& known = known_[std::string(name)];
    known.bus = this;
    known.name = name;
    known.owner = owner;
    ask(known);
}

void PlayerBus::ask(Known& known) {
    sd_bus_slot* slot = nullptr;
    if (sd_bus_call_method_async(bus_.get(),
                                 &slot,
                                 known.name.c_str(),
                                 kPlayerPath,
                                 kProperties,
                                 "GetAll",
                                 on_answer,
                                 &known,
                                 "s",
                                 kPlayer) >= 0) {
        known.question.reset(slot);
    }
}

int PlayerBus::on_answer(sd_bus_message* message, void* known_player, sd_bus_error* /*error*/) {
    Known& known = *static_cast<Known*>(known_player);
    // An answer of the bus, such as that it came too late, is none of the player's.
    if (sd_bus_message_is_method_error(message, nullptr) == 0) {
        if (const char* const owner = sd_bus_message_get_sender(message)) {
            known.owner = owner;
        }
        if (const auto news = read_player_properties(message)) {
            known.bus->list_.take(known.name, *news, known.bus->now_);
        }
    }
    known.question.reset();
    return 0;
}

PlayerBus::Known* PlayerBus::sender_of(sd_bus_message* message) {
    const char* const sender = sd_bus_message_get_sender(message);
    if (sender == nullptr) {
        return nullptr;
    }
    for (auto& [name, known] : known_) {
        if (known.owner == sender) {
            return &known;
        }
    }
    return nullptr;
}

int PlayerBus::on_change(sd_bus_message* message, void* self, sd_bus_error* /*error*/) {
    PlayerBus& bus = bus_of(self);
    Known* const known = bus.sender_of(message);
    const char* interface = nullptr;
    if (known == nullptr || sd_bus_message_read_basic(message, 's', &interface) <= 0) {
        return 0;
    }
    const auto news = read_player_properties(message);
    if (!news) {
        return 0;
    }
    bus.list_.take(known->name, *news, bus.now_);
    // It has changed something and does not say how.
    if (!known->question && names_player_property(message)) {
        bus.ask(*known);
    }
    return 0;
}

int PlayerBus::on_seek(sd_bus_message* message, void* self, sd_bus_error* /*error*/) {
    PlayerBus& bus = bus_of(self);
    if (const Known* const known = bus.sender_of(message)) {
        bus.list_.jump(known->name, bus.now_);
    }
    return 0;
}

}  // namespace raks::engine
