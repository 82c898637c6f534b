#pragma once

#include <optional>
#include <string_view>

namespace raks::engine {

/// Whether the desktop asks programs for calm pictures: GNOME's `enable-animations` is false, or
/// KDE's `AnimationDurationFactor` is 0. Asks the settings portal of the session's bus, for 0.8 s
/// in all at most, and where it does not know reads $XDG_CONFIG_HOME/kdeglobals. Without a bus
/// ($DBUS_SESSION_BUS_ADDRESS) nothing is asked, and the file alone counts.
/// Threads: main. Real-time: no.
[[nodiscard]] bool desktop_asks_for_calm();

/// What a kdeglobals file says: whether AnimationDurationFactor in its group [KDE] is 0; nothing
/// where it says nothing of it. Pure.
[[nodiscard]] std::optional<bool> calm_in_kdeglobals(std::string_view text);

}  // namespace raks::engine
