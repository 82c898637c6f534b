#include "engine/midi/midi_parser.hpp"

namespace raks::engine {
namespace {

// Status bytes of MIDI 1.0: the kind of a channel's message, above its channel.
constexpr std::uint8_t kNoteOff = 0x80;
constexpr std::uint8_t kNoteOn = 0x90;
constexpr std::uint8_t kController = 0xB0;
constexpr std::uint8_t kProgram = 0xC0;
constexpr std::uint8_t kChannelPressure = 0xD0;
constexpr std::uint8_t kSystem = 0xF0;
constexpr std::uint8_t kFirstRealTime = 0xF8;
constexpr std::uint8_t kStatusBit = 0x80;

}  // namespace

std::optional<MidiMessage> MidiParser::take(std::uint8_t byte) noexcept RAKS_NONBLOCKING {
    // Clocks and active sensing may come between the bytes of any message.
    if (byte >= kFirstRealTime) {
        return std::nullopt;
    }
    if ((byte & kStatusBit) != 0) {
        begin(byte);
        return std::nullopt;
    }
    if (status_ == 0) {
        return std::nullopt;
    }
    data_[count_++] = byte;
    if (count_ < wanted_) {
        return std::nullopt;
    }
    count_ = 0;  // the next data bytes have the same status: running status
    return message();
}

// Data of the system's messages is passed over, and they end a running status.
void MidiParser::begin(std::uint8_t status) noexcept {
    count_ = 0;
    status_ = status < kSystem ? status : 0;
    const auto kind = static_cast<std::uint8_t>(status & 0xF0U);
    wanted_ = kind == kProgram || kind == kChannelPressure ? 1 : 2;
}

std::optional<MidiMessage> MidiParser::message() const noexcept {
    MidiMessage message;
    message.channel = static_cast<std::uint8_t>((status_ & 0x0FU) + 1);
    message.number = data_[0];
    switch (status_ & 0xF0U) {
        case kNoteOff:
            return message;
        case kNoteOn:
            message.value = data_[1];
            return message;
        case kController:
            message.kind = MidiMessage::Kind::control;
            message.value = data_[1];
            return message;
        case kProgram:
            message.kind = MidiMessage::Kind::program;
            message.value = 127;
            return message;
        default:
            return std::nullopt;
    }
}

}  // namespace raks::engine
