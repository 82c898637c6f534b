// Where Raks is built without RtMidi.
#include "engine/midi/alsa_midi.hpp"

namespace raks::engine {
namespace {

constexpr const char* kNeither =
    "no JACK server runs, and this raks was built without MIDI by ALSA (RAKS_RTMIDI)";

}  // namespace

Expected<std::unique_ptr<MidiClockPort>> open_alsa_midi_clock(const std::string& /*name*/,
                                                              int /*clocks_per_beat*/) {
    return fail(kNeither);
}

Expected<std::unique_ptr<MidiInputPort>> open_alsa_midi_input(const std::string& /*name*/) {
    return fail(kNeither);
}

}  // namespace raks::engine
