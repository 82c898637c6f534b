#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// What a key, pad, pedal or knob says.
struct MidiMessage {
    /// What was moved.
    enum class Kind : std::uint8_t {
        note,     ///< a key or pad: `value` is how hard it is hit, 0: let go
        control,  ///< a knob, fader, pedal or button: `value` is where it stands
        program,  ///< a button that chooses a program: `value` is always 127
    };
    Kind kind = Kind::note;   ///< what was moved
    std::uint8_t channel{1};  ///< 1 to 16
    std::uint8_t number{};    ///< of the key, the controller or the program, 0 to 127
    std::uint8_t value{};     ///< 0 to 127
    HostTime came{};          ///< when; the parser leaves it as it is

    friend bool operator==(const MidiMessage&, const MidiMessage&) = default;
};

/// Reads a stream of MIDI 1.0 bytes as they come: running status, real-time bytes within other
/// messages, system-exclusive data of any length, messages that are cut short. What is neither a
/// note, a controller nor a program is passed over.
///
/// Threads: one. Real-time: yes.
class MidiParser {
 public:
    /// The message that this byte completes; nothing: none is complete.
    [[nodiscard]] std::optional<MidiMessage> take(std::uint8_t byte) noexcept RAKS_NONBLOCKING;

 private:
    void begin(std::uint8_t status) noexcept;
    [[nodiscard]] std::optional<MidiMessage> message() const noexcept;

    std::uint8_t status_ = 0;  // that data bytes belong to; 0: none, they are passed over
    std::size_t wanted_ = 0;   // data bytes of a message
    std::size_t count_ = 0;    // of those, so far
    std::array<std::uint8_t, 2> data_{};
};

}  // namespace raks::engine
