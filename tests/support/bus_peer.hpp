#pragma once

#include <systemd/sd-bus.h>

#include <functional>
#include <string_view>

namespace raks::test {

/// Hands a message with these bytes as its body to `read`, as one that came over a socket from
/// somebody who wrote it by hand: a signal of the signature `a{sv}as`. False: the library has
/// refused it already. Threads: one.
bool with_player_message(std::string_view body, const std::function<void(sd_bus_message*)>& read);

}  // namespace raks::test
