#pragma once

#include <cstddef>
#include <vector>

#include "training/cells/grid_cues.hpp"

namespace raks::motion {

/// Rows of TakeLikeness a second.
inline constexpr double kLikenessRate = 30.0;

/// How alike the moments of a take are that lie a while apart: the mean distance of the joints'
/// places about the hips, over that of two random moments within 8 s. Threads: any once it is made.
class TakeLikeness {
 public:
    /// Lags up to `longest` seconds.
    TakeLikeness(const GridCues& cues, double longest);

    /// Seconds from one row to the next are 1 / kLikenessRate.
    [[nodiscard]] std::size_t rows() const noexcept { return bases_.size(); }
    /// Over the moments of [from, to) rows whose counterpart is in the clip, too; 1 where there are
    /// none, or the lag is longer than was asked for.
    [[nodiscard]] double distance(std::size_t from, std::size_t to, double lag_seconds) const;

 private:
    [[nodiscard]] double mean(std::size_t from, std::size_t to, std::size_t lag) const;

    std::vector<std::vector<double>> sums_;  // by lag: of distances up to a row
    std::vector<double> bases_;              // of random moments, by row
};

}  // namespace raks::motion
