#pragma once

#include <array>
#include <cstddef>

#include "motion/evaluate/body_track.hpp"
#include "motion/evaluate/dance_metrics.hpp"

/// Played at pace: what the jerk of a dance would measure at another tempo. Divided by pace^3 it
/// would stay the same but for the filter, which cuts at a fixed frequency and so takes more off a
/// faster dance.
namespace raks::motion {

/// Paces (tempo / learnt tempo) that are compared; the dancer's range.
inline constexpr std::array<double, 7> kJudgedPaces = {0.75, 0.85, 0.95, 1.0, 1.1, 1.2, 1.4};

/// The dance `pace` times as fast, at the same frames a second (Catmull-Rom); pace > 0. Threads:
/// any. Real-time: no.
[[nodiscard]] BodyTrack played_at_pace(const BodyTrack& track, double pace);
/// Which frames of it count. `frames`: of the original track with `count` frames, without paces.
[[nodiscard]] MetricFrames frames_at_pace(const MetricFrames& frames,
                                          std::size_t count,
                                          double pace);

/// Sum of squared jerks, to be added up over takes.
struct JerkSquares {
    double sum = 0.0;    ///< of the squares
    double count = 0.0;  ///< of the samples

    /// Root mean square; 0 without samples.
    [[nodiscard]] double rms() const noexcept;
};
using JerkByPace = std::array<JerkSquares, kJudgedPaces.size()>;

/// Jerk (divided by pace^3) of the dance played at each of kJudgedPaces. Threads: workers.
/// Real-time: no.
[[nodiscard]] JerkByPace jerk_by_pace(const BodyTrack& track, const MetricFrames& frames);

}  // namespace raks::motion
