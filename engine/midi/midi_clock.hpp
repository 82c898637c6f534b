#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// The beats that a MIDI clock follows: a straight line over host time.
struct MidiClockBeats {
    HostTime anchor{};              ///< when the beat stands at `beat`
    double beat = 0.0;              ///< beats since a count 1, of any sign
    double beats_per_second = 2.0;  ///< > 0
    int beats_per_bar = 4;          ///< 2 to 7
    bool is_followed = false;       ///< false: they are not known, the last tempo goes on
    bool is_held = false;           ///< a person holds the tempo: it does not waver

    /// Beats since a count 1 at a time.
    [[nodiscard]] double beat_at(HostTime time) const noexcept {
        return beat + to_seconds(time - anchor) * beats_per_second;
    }
};

/// When a MIDI clock ticks, by counting samples: 24 clocks a beat. A start goes before the clock
/// that falls on a count 1, once beats are known. Clocks never cease from then on, none is skipped,
/// none comes within 2 ms of another: the interval follows tempo and phase of the beats, corrected
/// by at most 5 %. Where beats jump a stop goes out, and a start at a next count 1. While no
/// beats are known, the last tempo goes on.
///
/// Pure; it knows no device. Threads: one, such as the audio callback. Real-time: yes.
class MidiClock {
 public:
    static constexpr std::uint8_t kClock = 0xF8;  ///< timing clock
    static constexpr std::uint8_t kStart = 0xFA;  ///< the next clock is count 1
    static constexpr std::uint8_t kStop = 0xFC;   ///< no beats from here on, clocks may go on

    /// One byte to be sent.
    struct Message {
        std::uint32_t offset = 0;  ///< samples from the beginning of the block
        std::uint8_t byte = 0;     ///< kClock, kStart or kStop
    };

    /// `rate`: samples a second, or any ticks, >= 8,000. `clocks_per_beat`: 24; of beats that come
    /// half or twice as often 12 or 48.
    explicit MidiClock(double rate, int clocks_per_beat = 24) noexcept
        : rate_(rate), clocks_per_beat_(clocks_per_beat) {}

    /// What is to be sent within the next `samples`, which begin at `begins`, in order; valid until
    /// the next call. Blocks follow each other; samples that are lost in between make clocks later,
    /// which then catch up.
    [[nodiscard]] std::span<const Message> advance(const MidiClockBeats& beats,
                                                   HostTime begins,
                                                   std::uint32_t samples) noexcept RAKS_NONBLOCKING;
    /// What is to be sent before no block follows; valid until the next call.
    [[nodiscard]] std::span<const Message> stop() noexcept RAKS_NONBLOCKING;

    /// Samples from the end of the last block to the next clock; while none is sent: a second.
    [[nodiscard]] double next_in() const noexcept { return has_begun_ ? next_ : rate_; }

 private:
    void begin(const MidiClockBeats& beats, HostTime begins) noexcept;
    void tick(const MidiClockBeats& beats, HostTime at) noexcept;
    [[nodiscard]] double error_of(const MidiClockBeats& beats, double clocks) noexcept;
    [[nodiscard]] double correction_of(const MidiClockBeats& beats,
                                       double error,
                                       double interval) noexcept;
    void send(std::uint8_t byte) noexcept;

    // A block of 8,192 samples at 8 kHz has 400 clocks at twice the fastest tempo.
    static constexpr std::size_t kMostMessages = 512;

    double rate_;
    int clocks_per_beat_;
    double beats_per_second_ = 2.0;  // as followed last
    double next_ = 0.0;              // samples from the beginning of the block to the next clock
    std::int64_t count_ = 0;         // clocks since the start
    int apart_ = 0;                  // clocks in a row that were far from the beats
    bool has_begun_ = false;
    bool is_running_ = false;      // between start and stop
    bool is_catching_up_ = false;  // a held tempo, after its beats were moved
    std::array<Message, kMostMessages> messages_{};
    std::size_t sent_ = 0;
};

}  // namespace raks::engine
