#pragma once

#include <array>
#include <optional>

#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Tempo from a series of taps, from the third tap on: the median slope of all pairs of the last
/// twelve (Theil 1950, Sen 1968), which neither one bad tap nor a delay that trembles moves far.
/// Other taps are followed after a few. A pause of more than 2 s starts a new series.
/// Threads: one. Real-time: yes.
class TapTempo {
 public:
    /// Takes a tap. Returns the tempo in BPM so far; empty before the third tap.
    std::optional<double> tap(StreamTime time) noexcept RAKS_NONBLOCKING;
    /// Starts a new series.
    void reset() noexcept RAKS_NONBLOCKING { count_ = 0; }

 private:
    static constexpr std::size_t kTaps = 12;
    [[nodiscard]] double usual_interval() const noexcept RAKS_NONBLOCKING;
    [[nodiscard]] std::size_t first_of_this_tempo(double usual) const noexcept RAKS_NONBLOCKING;

    std::array<StreamTime, kTaps> taps_{};  // oldest first
    std::size_t count_ = 0;
};

}  // namespace raks::audio
