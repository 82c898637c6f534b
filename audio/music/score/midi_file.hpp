#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::audio {

/// One event of a standard MIDI file: a channel message, or a meta event (status 0xFF).
struct MidiEvent {
    std::int64_t pulse = 0;   ///< since the file's start
    std::uint8_t status = 0;  ///< 0x80 to 0xEF, or 0xFF
    std::uint8_t first = 0;   ///< data byte, [0, 127]; of meta events: the type
    std::uint8_t second = 0;  ///< data byte, [0, 127]
    std::string meta;         ///< of meta events: what they say
};

/// A standard MIDI file with all tracks merged.
struct MidiFile {
    int pulses_per_quarter = 480;   ///< MIDI's unit of time
    std::vector<MidiEvent> events;  ///< by pulse; at one pulse in the order of the tracks
};

/// Reads the bytes of a file (Standard MIDI Files 1.0). A track ends at the first bytes that are no
/// event and keeps what came before. Tracks that are cut short and system-exclusive messages are
/// skipped. Errors: no header, time code (SMPTE) instead of beats, no whole track.
[[nodiscard]] Expected<MidiFile> parse_midi(std::string_view bytes);

}  // namespace raks::audio
