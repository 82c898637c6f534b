#pragma once

#include <memory>
#include <string>

#include "base/expected.hpp"
#include "engine/outputs/output.hpp"

namespace raks::engine {

/// A MIDI clock (engine/midi/midi_clock.hpp) to the port whose name holds `NAME`, and options of
/// the timing. Errors: the target; neither JACK nor ALSA can be had.
[[nodiscard]] Expected<std::unique_ptr<Output>> open_midi_clock(const std::string& target);
/// See OutputKind::check.
[[nodiscard]] Expected<void> check_midi_clock(const std::string& target);

}  // namespace raks::engine
