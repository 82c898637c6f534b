#pragma once

#include <array>
#include <optional>

#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Tempo from a row of taps: the median of the last intervals (at most seven), from the third tap
/// on. A pause of more than 2 s starts a new row.
/// Threads: one. Real-time: yes.
class TapTempo {
 public:
    /// Beats per minute as tapped so far; empty until three taps.
    std::optional<double> tap(StreamTime time) noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING { count_ = 0; }

 private:
    static constexpr std::size_t kTaps = 8;
    std::array<StreamTime, kTaps> taps_{};  // oldest first
    std::size_t count_ = 0;
};

}  // namespace raks::audio
