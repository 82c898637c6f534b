#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/expected.hpp"
#include "training/figures/label_counts.hpp"

namespace raks::motion {

/// The beats of the music that a clip was danced to, in seconds of the clip.
class DancedBeats {
 public:
    /// Those within the clip, and as far as they reach around it. Errors: fewer than four within.
    [[nodiscard]] static Expected<DancedBeats> within(const DancedMusic& music, double seconds);

    /// Median seconds from beat to beat.
    [[nodiscard]] double interval() const noexcept { return interval_; }

    /// How many beats `seconds` are, within 6 %: `wanted`, or half a bar, one, two, four; 0 where
    /// it is none of them.
    [[nodiscard]] int whole_beats(double seconds,
                                  std::optional<int> wanted,
                                  int beats_per_bar) const;

    /// Beats from the nearest beat to a moment, -0.5 to 0.5.
    [[nodiscard]] double beats_after_nearest(double seconds) const;

    /// Seconds of the beat nearest to a moment and of the one `count` beats later; none beyond the
    /// music.
    [[nodiscard]] std::optional<std::pair<double, double>> beats_from(double seconds,
                                                                      int count) const;

    /// Seconds of all beats from one moment to another.
    [[nodiscard]] std::vector<double> between(double from, double to) const;

    /// The share of these moments whose nearest beat begins a bar.
    [[nodiscard]] double share_on_bar_lines(std::span<const double> seconds) const;

 private:
    [[nodiscard]] std::size_t nearest(double seconds) const;

    std::vector<MusicBeat> beats_;  // seconds of the clip, rising
    double interval_ = 0.5;
};

}  // namespace raks::motion
