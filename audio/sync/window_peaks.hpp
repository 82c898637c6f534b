#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "audio/sync/clock_line.hpp"
#include "audio/sync/phase_correlator.hpp"

namespace raks::audio {

/// One window of a track.
struct AlignmentWindow {
    bool is_tried = false;            ///< it lies within both tracks
    std::optional<ClockPoint> point;  ///< its middle by both clocks; nothing: no peak stood out
};

/// All windows of a track along a line.
struct WindowMeasurements {
    std::vector<AlignmentWindow> windows;
    /// Sum of the correlations of all windows, by their lag behind the line: WindowPeaks::kReach
    /// before it to as much behind it, at SyncTrack::kRate. What all windows share stands out
    /// here: the direct sound, and the reflections of the rooms.
    std::vector<float> stack;
};

/// Measures where the windows of one track lie in another: 5 s every 2.5 s, at most 60 of them,
/// each against what a line says that the other track has there (PhaseCorrelator, 150 to 6,000 Hz).
/// Threads: one. Real-time: no.
class WindowPeaks {
 public:
    static constexpr double kReach = 0.1;  ///< how far from the line peaks are searched, seconds
    static constexpr double kLeast = 6.0;  ///< standard deviations that count as a peak

    /// Both at SyncTrack::kRate; they must stay where they are while this lives.
    WindowPeaks(std::span<const float> part, std::span<const float> whole);

    /// The windows by this line from the part's clock to the whole's; window k is the same stretch
    /// of the part for any line.
    [[nodiscard]] WindowMeasurements measure(const ClockLine& line);

 private:
    // Adds to `stack`.
    [[nodiscard]] AlignmentWindow measure_one(std::size_t first,
                                              const ClockLine& line,
                                              std::span<float> stack);

    std::span<const float> part_;
    std::span<const float> whole_;
    PhaseCorrelator correlator_;
    std::vector<std::size_t> firsts_;  // first sample of each window
};

}  // namespace raks::audio
