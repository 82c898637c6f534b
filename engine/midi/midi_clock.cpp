#include "engine/midi/midi_clock.hpp"

#include <algorithm>
#include <cmath>

namespace raks::engine {
namespace {

// Beats farther off than this, or a tempo that differs by more, are no longer the same beats.
constexpr double kJumpBeats = 0.25;
constexpr double kJumpTempo = 0.08;
// So many beats they have to be off in a row: a tracker that wavers for a moment starts nothing.
constexpr double kJumpLasts = 0.5;
// A start is only given this near to the count 1.
constexpr double kStartWithin = 0.9e-3;  // s

constexpr double kMostCorrection = 0.05;  // of an interval
constexpr double kGainRunning = 0.1;      // of the error, a clock
constexpr double kGainStopped = 0.3;      // nobody counts: the clock may swing in fast
// Of a held tempo nothing is to be heard but its tempo: corrections stay below a sample. They make
// up for a device whose rate is off by 0.02 %.
constexpr double kGainHeld = 0.01;
constexpr double kMostHeld = 0.2;  // samples
// Unless somebody has moved its beats.
constexpr double kMovedBy = 5e-3;  // s
constexpr double kSettled = 1e-3;  // s

// 12 to 560 BPM at any pace: what is outside is no tempo, and would bring clocks within 2 ms.
constexpr double kSlowest = 0.2;      // beats a second
constexpr double kShortest = 2.2e-3;  // s, between clocks

}  // namespace

std::span<const MidiClock::Message> MidiClock::advance(
    const MidiClockBeats& beats, HostTime begins, std::uint32_t samples) noexcept RAKS_NONBLOCKING {
    sent_ = 0;
    if (!has_begun_ && beats.is_followed) {
        begin(beats, begins);
    }
    // A block with more clocks than there is room for is longer than any device's.
    while (has_begun_ && next_ < samples && sent_ + 3 <= kMostMessages) {
        tick(beats, begins + nanos_from_seconds(next_ / rate_));
    }
    next_ = std::max(0.0, next_ - samples);
    return std::span(messages_).first(sent_);
}

std::span<const MidiClock::Message> MidiClock::stop() noexcept RAKS_NONBLOCKING {
    sent_ = 0;
    if (is_running_) {
        next_ = 0.0;
        send(kStop);
    }
    has_begun_ = is_running_ = false;
    return std::span(messages_).first(sent_);
}

// The first clock stands where the beats have one.
void MidiClock::begin(const MidiClockBeats& beats, HostTime begins) noexcept {
    has_begun_ = true;
    beats_per_second_ = beats.beats_per_second;
    const double clocks = beats.beat_at(begins) * clocks_per_beat_;
    next_ = (std::ceil(clocks) - clocks) * rate_ / (clocks_per_beat_ * beats.beats_per_second);
}

void MidiClock::tick(const MidiClockBeats& beats, HostTime at) noexcept {
    double error = 0.0;
    if (beats.is_followed) {
        error = error_of(beats, beats.beat_at(at) * clocks_per_beat_);
    }
    send(kClock);
    ++count_;
    const double per_second = std::max(kSlowest, beats_per_second_) * clocks_per_beat_;
    const double interval = rate_ * std::max(kShortest, 1.0 / per_second);
    next_ += interval - correction_of(beats, error, interval);
}

// How far the beats are ahead of this clock, in clocks; sends stop and start where they are due.
double MidiClock::error_of(const MidiClockBeats& beats, double clocks) noexcept {
    const double bar = static_cast<double>(beats.beats_per_bar) * clocks_per_beat_;
    const bool is_other_tempo =
        std::abs(beats.beats_per_second / beats_per_second_ - 1.0) > kJumpTempo;
    beats_per_second_ = beats.beats_per_second;
    if (is_running_) {
        const double error = std::remainder(clocks - static_cast<double>(count_), bar);
        const bool is_apart = std::abs(error) > kJumpBeats * clocks_per_beat_;
        apart_ = is_apart ? apart_ + 1 : 0;
        if (!is_other_tempo && apart_ <= kJumpLasts * clocks_per_beat_) {
            return is_apart ? 0.0 : error;
        }
        send(kStop);
        is_running_ = false;
    }
    const double nearest = std::round(clocks);
    const double error = clocks - nearest;
    const double seconds = error / (clocks_per_beat_ * beats.beats_per_second);
    if (std::remainder(nearest, bar) == 0.0 && std::abs(seconds) < kStartWithin) {
        send(kStart);
        is_running_ = true;
        is_catching_up_ = false;
        count_ = apart_ = 0;
    }
    return error;
}

// By how many samples the next clock comes earlier.
double MidiClock::correction_of(const MidiClockBeats& beats,
                                double error,
                                double interval) noexcept {
    const double most = kMostCorrection * interval;
    const double early = error * interval;
    if (!is_running_) {
        return std::clamp(kGainStopped * early, -most, most);
    }
    const double seconds = std::abs(early) / rate_;
    is_catching_up_ = beats.is_held && (is_catching_up_ ? seconds > kSettled : seconds > kMovedBy);
    return beats.is_held && !is_catching_up_ ? std::clamp(kGainHeld * early, -kMostHeld, kMostHeld)
                                             : std::clamp(kGainRunning * early, -most, most);
}

void MidiClock::send(std::uint8_t byte) noexcept {
    messages_[sent_++] = {static_cast<std::uint32_t>(next_), byte};
}

}  // namespace raks::engine
