#pragma once

#include <memory>
#include <string>

#include "base/expected.hpp"
#include "engine/midi/midi_port.hpp"

namespace raks::engine {

/// A MIDI clock as a client `raks-clock` of the JACK server with a port `out`, on JACK's own
/// thread: each message stands at its sample. It comes earlier by what JACK says that its receivers
/// take until they are heard. Null: no server runs. Errors: it does not answer, or refuses.
[[nodiscard]] Expected<std::unique_ptr<MidiClockPort>> open_jack_midi_clock(const std::string& name,
                                                                            int clocks_per_beat);
/// What is heard, as a client `raks-control` with a port `in`. Null and errors: likewise.
[[nodiscard]] Expected<std::unique_ptr<MidiInputPort>> open_jack_midi_input(
    const std::string& name);

}  // namespace raks::engine
