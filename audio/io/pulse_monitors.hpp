#pragma once

#include <string>
#include <vector>

namespace raks::audio {

/// A PulseAudio source that carries what a sink plays.
struct PulseMonitor {
    std::string name;                 ///< "alsa_output.pci.monitor": what PULSE_SOURCE takes
    std::string description;          ///< "Monitor of Built-in Audio"
    bool is_of_default_sink = false;  ///< of the sink that plays by default
};

/// All monitors of the PulseAudio (or pipewire-pulse) server, the default sink's first; empty when
/// no server answers within a second. Never starts a server.
/// Threads: any. Real-time: no.
[[nodiscard]] std::vector<PulseMonitor> list_pulse_monitors();

}  // namespace raks::audio
