#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::engine {

/// A device as the list in the window shows it.
struct ListedDevice {
    std::string name{};                 ///< as the desktop shows it
    std::string system{};               ///< "PipeWire"
    bool is_input = false;              ///< it can be listened to
    bool is_output = false;             ///< it can be played to
    bool is_monitor = false;            ///< it hears what the computer plays
    std::string monitor_of{};           ///< of a monitor: its loudspeaker's name
    std::optional<float> level_dbfs{};  ///< what it hears; none: not known
};

/// Reads what `raks devices --json` prints. Errors: it is no such document. Pure.
[[nodiscard]] Expected<std::vector<ListedDevice>> parse_devices(const std::string& json);

/// Asks a child of this program, `raks devices --json --levels`: what a sound server or a driver
/// does there cannot stop this one. It has 5 s. Errors: it cannot be started, says nothing, or
/// says why there are none. Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::vector<ListedDevice>> ask_for_devices();

}  // namespace raks::engine
