#include <array>

#include "engine/outputs/line_output.hpp"
#include "engine/outputs/midi_clock_output.hpp"
#include "engine/outputs/os2l_output.hpp"
#include "engine/outputs/osc_output.hpp"
#include "engine/outputs/output.hpp"
#include "engine/outputs/vmc_output.hpp"
#include "engine/outputs/wled_output.hpp"

namespace raks::engine {
namespace {

constexpr std::array kKinds = std::to_array<OutputKind>({
    {"lines",
     "FILE",
     "beats and events, as they are heard, as lines of JSON; - for stdout",
     false,
     check_lines,
     open_lines},
    {"osc",
     "HOST:PORT",
     "beats, events and more by OSC; also HOST:PORT,preset=plain,lead=30,...",
     true,
     check_osc,
     open_osc},
    {"os2l",
     "HOST",
     "beats and buttons to a light program by OS2L; also HOST:9996,lead=30,...",
     true,
     check_os2l,
     open_os2l},
    {"wled",
     "HOST",
     "sound for the lights of WLED, or multicast; also HOST:11988,lead=30,...",
     true,
     check_wled,
     open_wled},
    {"vmc",
     "HOST",
     "pose and face to VTuber programs by VMC; also HOST:39539,dancer=2,...",
     true,
     check_vmc,
     open_vmc,
     true},
    {"midi-clock",
     "NAME",
     "a MIDI clock to the port whose name holds NAME; also NAME,lead=30,...",
     true,
     check_midi_clock,
     open_midi_clock},
});

}  // namespace

std::span<const OutputKind> output_kinds() noexcept { return kKinds; }

}  // namespace raks::engine
