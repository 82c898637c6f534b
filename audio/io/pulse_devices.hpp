#pragma once

#include <optional>
#include <string>
#include <vector>

#include "audio/io/devices.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// All sources and sinks of the PulseAudio or PipeWire server by the desktop's names: monitors
/// first, then the rest; the defaults first in each. Empty: no server is running. Never starts one.
/// Errors: it accepts but does not answer within 2 s. Threads: any. Real-time: no.
[[nodiscard]] Expected<std::vector<AudioDevice>> list_pulse_devices();

/// A monitor, other than that with the id `except`, that has sound above -60 dBFS now. Listens for
/// 2 s at most. Nothing: all are silent, or no server answers. Threads: any.
[[nodiscard]] std::optional<AudioDevice> other_monitor_with_sound(const std::string& except);

}  // namespace raks::audio
