#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/midi/midi_clock.hpp"
#include "engine/midi/midi_parser.hpp"

namespace raks::engine {

/// Sends a MIDI clock through a port of this machine. Threads: the one that opened it, or one other
/// from then on; the destructor any.
class MidiClockPort {
 public:
    virtual ~MidiClockPort() = default;  ///< sends a stop, and closes

    /// The clock follows these beats from now on.
    virtual void follow(const MidiClockBeats& beats) = 0;
    /// Sends what is due, where the port has no thread that does; every 5 ms, and when due() says.
    virtual void turn(HostTime /*now*/) {}
    /// When a turn is wanted to the point; nothing: whenever it comes.
    [[nodiscard]] virtual std::optional<HostTime> due() const { return std::nullopt; }
    /// Messages that were sent since the last call.
    [[nodiscard]] virtual std::uint64_t take_sent() = 0;
    /// What went wrong since the last call, in words for a person.
    [[nodiscard]] virtual std::optional<std::string> take_trouble() = 0;
};

/// Hears a knob box, a keyboard or a pedal through a port of this machine. Threads: one.
class MidiInputPort {
 public:
    static constexpr std::size_t kRoom = 256;  ///< messages that wait; more are lost and counted

    virtual ~MidiInputPort() = default;  ///< closes it

    /// The next message; false: none waits.
    [[nodiscard]] virtual bool take(MidiMessage& message) = 0;
    /// What is heard, as midi_device_name() has it; empty: nothing of that name is there yet.
    [[nodiscard]] virtual std::string device() = 0;
    /// Messages that were lost.
    [[nodiscard]] virtual std::uint64_t lost() const = 0;
    /// What went wrong since the last call, in words for a person.
    [[nodiscard]] virtual std::optional<std::string> take_trouble() = 0;
};

/// Opens a port of ours that is connected to the first one of others whose name holds `name`, also
/// when that comes later: of the JACK server where one runs, else of ALSA. Errors: neither is
/// there, or refuses.
[[nodiscard]] Expected<std::unique_ptr<MidiClockPort>> open_midi_clock_port(const std::string& name,
                                                                            int clocks_per_beat);
/// The same for what is heard.
[[nodiscard]] Expected<std::unique_ptr<MidiInputPort>> open_midi_input_port(
    const std::string& name);

/// Whether a port is meant by `name`: its own holds it, whatever the case. Pure.
[[nodiscard]] bool is_midi_port_meant(std::string_view port, std::string_view name);
/// The name of a port without the numbers that the system gives it anew each time, "[24]" and
/// "20:0", and fit for a line: what is kept of a device stands under it. Pure.
[[nodiscard]] std::string midi_device_name(std::string_view port);

}  // namespace raks::engine
