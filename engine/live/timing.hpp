#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// How long something took, as a histogram that a real-time thread can fill: logarithmic bins, 32
/// an octave (2.2 % wide), 1 us to 4 s; shorter and longer times fall into the outer bins. Threads:
/// add from one thread, the rest from any. Real-time: add yes.
class TimingHistogram {
 public:
    /// Counts one time. Real-time: yes (no allocation, no lock).
    void add(Nanos span) noexcept RAKS_NONBLOCKING;

    /// How many times were added.
    [[nodiscard]] std::int64_t count() const noexcept;
    /// The time that the share `share`, [0, 1], of all times does not exceed, in ms, to the width
    /// of a bin; 0 when empty.
    [[nodiscard]] double quantile_ms(double share) const noexcept;
    /// The longest time, exact, in ms.
    [[nodiscard]] double max_ms() const noexcept;

 private:
    static constexpr int kBinsPerOctave = 32;
    static constexpr int kOctaves = 22;
    static constexpr int kBins = kBinsPerOctave * kOctaves;

    // relaxed everywhere: counters that order nothing; a reader may miss the newest few.
    std::array<std::atomic<std::uint32_t>, kBins> bins_{};
    std::atomic<std::int64_t> max_ns_{0};
};

}  // namespace raks::engine
