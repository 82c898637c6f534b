#pragma once

#include <systemd/sd-bus.h>

#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "engine/players/player_list.hpp"

namespace raks::engine {

/// Reads the properties of a player, a dictionary `a{sv}` at which the message stands: those of
/// MPRIS that count, whatever else there is. Of artists and genres the first eight count; each text
/// is cleaned and cut. Errors: it is none; what was read so far is not used. Threads: one.
/// Real-time: no.
[[nodiscard]] Expected<PlayerNews> read_player_properties(sd_bus_message* message);

/// The path of a URL of a file on this machine; empty where it is none. Nobody looks whether it is
/// there.
[[nodiscard]] std::string local_file_of(std::string_view url);

/// Whether the list `as` at which the message stands names a property that counts: players may say
/// that it has changed, and not how. False, too, where it is no list.
[[nodiscard]] bool names_player_property(sd_bus_message* message);

}  // namespace raks::engine
