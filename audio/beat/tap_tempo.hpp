#pragma once

#include <array>
#include <optional>

#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Tempo from a series of taps: the median of the last intervals (at most seven), from the third
/// tap on. A pause of more than 2 s starts a new series.
/// Threads: one. Real-time: yes.
class TapTempo {
 public:
    /// Takes a tap. Returns the tempo in BPM so far; empty before the third tap.
    std::optional<double> tap(StreamTime time) noexcept RAKS_NONBLOCKING;
    /// Starts a new series.
    void reset() noexcept RAKS_NONBLOCKING { count_ = 0; }

 private:
    static constexpr std::size_t kTaps = 8;
    std::array<StreamTime, kTaps> taps_{};  // oldest first
    std::size_t count_ = 0;
};

}  // namespace raks::audio
