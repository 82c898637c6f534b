#pragma once

#include <systemd/sd-bus.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/players/player_list.hpp"

namespace raks::engine {

/// One connection to the session bus, and the players on it. Threads: one. Real-time: no.
class PlayerBus {
 public:
    /// What is heard goes to `list`, which must outlive this. Call open() before anything else.
    explicit PlayerBus(PlayerList& list) : list_(list) {}
    ~PlayerBus() = default;
    PlayerBus(const PlayerBus&) = delete;             ///< the library calls back
    PlayerBus& operator=(const PlayerBus&) = delete;  ///< likewise

    /// Connects to this user's session bus; what it says comes in later. Errors: there is none.
    [[nodiscard]] Expected<void> open();
    /// Works on at most one message. Returns whether there may be more. Errors: the connection has
    /// ended.
    [[nodiscard]] Expected<bool> turn(HostTime now);
    /// What to wait for: file, events of poll(), and until when; no time: for ever.
    struct Wait {
        int file = -1;
        short events = 0;
        std::optional<HostTime> until{};
    };
    [[nodiscard]] Wait wait() const;

 private:
    struct CloseBus {
        void operator()(sd_bus* bus) const noexcept { sd_bus_close_unref(bus); }
    };
    struct DropSlot {
        void operator()(sd_bus_slot* slot) const noexcept { sd_bus_slot_unref(slot); }
    };
    using Slot = std::unique_ptr<sd_bus_slot, DropSlot>;

    // A player that was asked, or has answered.
    struct Known {
        PlayerBus* bus = nullptr;
        std::string name;   // "org.mpris.MediaPlayer2.mpv"
        std::string owner;  // ":1.42"; empty: not known yet
        Slot question;      // that it has not answered
    };

    static int on_names(sd_bus_message* message, void* self, sd_bus_error* error);
    static int on_owner(sd_bus_message* message, void* self, sd_bus_error* error);
    static int on_change(sd_bus_message* message, void* self, sd_bus_error* error);
    static int on_seek(sd_bus_message* message, void* self, sd_bus_error* error);
    static int on_answer(sd_bus_message* message, void* known, sd_bus_error* error);

    [[nodiscard]] bool listen();
    void meet(std::string_view name, std::string_view owner, PlayerList::Arrival how);
    void ask(Known& known);
    [[nodiscard]] Known* sender_of(sd_bus_message* message);

    PlayerList& list_;
    HostTime now_{};  // of this turn
    std::unique_ptr<sd_bus, CloseBus> bus_;
    std::map<std::string, Known, std::less<>> known_;  // their slots go before the bus does
};

}  // namespace raks::engine
