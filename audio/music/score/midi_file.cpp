#include "audio/music/score/midi_file.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace raks::audio {
namespace {

/// Takes bytes off the front; nothing when there are too few.
class MidiBytes {
 public:
    explicit MidiBytes(std::string_view bytes) : left_(bytes) {}

    std::optional<std::string_view> take(std::size_t count) {
        if (count > left_.size()) {
            return std::nullopt;
        }
        const std::string_view taken = left_.substr(0, count);
        left_.remove_prefix(count);
        return taken;
    }
    /// Big-endian, as all numbers of the format are.
    std::optional<std::uint32_t> number(std::size_t bytes) {
        const auto taken = take(bytes);
        if (!taken) {
            return std::nullopt;
        }
        std::uint32_t value = 0;
        for (const char byte : *taken) {
            value = value << 8U | static_cast<std::uint8_t>(byte);
        }
        return value;
    }
    /// Seven bits a byte, the last without the high bit; at most four bytes.
    std::optional<std::uint32_t> variable() {
        std::uint32_t value = 0;
        for (int i = 0; i < 4; ++i) {
            const auto byte = number(1);
            if (!byte) {
                return std::nullopt;
            }
            value = value << 7U | (*byte & 0x7FU);
            if (*byte < 0x80U) {
                return value;
            }
        }
        return std::nullopt;
    }
    /// The next byte, which stays.
    [[nodiscard]] std::optional<std::uint8_t> peek() const {
        return left_.empty() ? std::nullopt
                             : std::optional(static_cast<std::uint8_t>(left_.front()));
    }
    [[nodiscard]] bool is_empty() const { return left_.empty(); }

 private:
    std::string_view left_;
};

/// One event after its delta time; nothing where the bytes end or make no sense.
std::optional<MidiEvent> read_event(MidiBytes& bytes, std::uint8_t& running) {
    const auto next = bytes.peek();
    if (!next) {
        return std::nullopt;
    }
    // Running status: an event without a status byte has that of the channel message before it.
    const std::uint8_t status = *next >= 0x80 ? *next : running;
    if (*next >= 0x80) {
        static_cast<void>(bytes.take(1));
    }
    MidiEvent event;
    event.status = status;
    // Meta events and system-exclusive messages say how long they are; only meta has a type.
    if (status >= 0xF0) {
        const auto type = status == 0xFF ? bytes.number(1) : std::optional<std::uint32_t>(0);
        const auto length = bytes.variable();
        const auto payload = length ? bytes.take(*length) : std::nullopt;
        if (!type || !payload) {
            return std::nullopt;
        }
        event.first = static_cast<std::uint8_t>(*type);
        event.meta = *payload;
        return event;
    }
    if (status < 0x80) {
        return std::nullopt;  // data without a status
    }
    // Meta events, above, leave the running status as it was.
    running = status;
    // Program change and channel pressure have one data byte, all others two.
    const bool has_two = (status & 0xE0) != 0xC0;
    const auto first = bytes.number(1);
    const auto second = has_two ? bytes.number(1) : std::optional<std::uint32_t>(0);
    if (!first || !second) {
        return std::nullopt;
    }
    event.first = static_cast<std::uint8_t>(*first & 0x7FU);
    event.second = static_cast<std::uint8_t>(*second & 0x7FU);
    return event;
}

/// Appends the track's events with their pulses since the start of the file.
void read_track(std::string_view track, std::vector<MidiEvent>& events) {
    constexpr std::uint8_t kMeta = 0xFF;
    constexpr std::uint8_t kEndOfTrack = 0x2F;
    MidiBytes bytes(track);
    std::int64_t pulse = 0;
    std::uint8_t running = 0;
    while (!bytes.is_empty()) {
        const auto delta = bytes.variable();
        auto event = delta ? read_event(bytes, running) : std::nullopt;
        if (!event || (event->status == kMeta && event->first == kEndOfTrack)) {
            return;
        }
        // Times are relative to the event before, also to one that is passed over.
        pulse += *delta;
        event->pulse = pulse;
        if (event->status < 0xF0 || event->status == kMeta) {
            events.push_back(std::move(*event));
        }
    }
}

}  // namespace

Expected<MidiFile> parse_midi(std::string_view bytes) {
    constexpr std::uint32_t kHeader = 0x4D546864;  // "MThd"
    constexpr std::uint32_t kTrack = 0x4D54726B;   // "MTrk"
    MidiBytes file(bytes);
    const auto name = file.number(4);
    const auto length = file.number(4);
    auto header = length ? file.take(*length) : std::nullopt;
    if (!name || *name != kHeader || !header || header->size() < 6) {
        return fail("is not a MIDI file");
    }
    const std::uint32_t division = *MidiBytes(header->substr(4)).number(2);
    // With the upper bit set the division counts parts of a second.
    if (division == 0 || division >= 0x8000) {
        return fail("is MIDI in time code, not in beats, which is not read");
    }
    MidiFile midi;
    midi.pulses_per_quarter = static_cast<int>(division);
    std::size_t tracks = 0;
    while (!file.is_empty()) {
        const auto chunk = file.number(4);
        const auto size = file.number(4);
        if (!chunk || !size) {
            break;
        }
        auto body = file.take(*size);
        if (!body) {
            break;
        }
        // Chunks of other kinds are allowed and passed over.
        if (*chunk == kTrack) {
            read_track(*body, midi.events);
            ++tracks;
        }
    }
    if (tracks == 0) {
        return fail("has no complete track of MIDI");
    }
    // Stable: at one pulse a track's own order matters (program change before note).
    std::stable_sort(midi.events.begin(),
                     midi.events.end(),
                     [](const MidiEvent& a, const MidiEvent& b) { return a.pulse < b.pulse; });
    return midi;
}

}  // namespace raks::audio
