#pragma once

#include <memory>
#include <string>

#include "base/expected.hpp"
#include "engine/midi/midi_port.hpp"

namespace raks::engine {

/// A MIDI clock through RtMidi to a port of ALSA's sequencer, which gets each message when it is
/// due. Errors: there is no sequencer; Raks was built without RtMidi.
[[nodiscard]] Expected<std::unique_ptr<MidiClockPort>> open_alsa_midi_clock(const std::string& name,
                                                                            int clocks_per_beat);
/// What is heard from a port of ALSA's sequencer. Errors: likewise.
[[nodiscard]] Expected<std::unique_ptr<MidiInputPort>> open_alsa_midi_input(
    const std::string& name);

}  // namespace raks::engine
