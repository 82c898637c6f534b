#pragma once

#include <array>
#include <cstddef>

#include "motion/evaluate/body_track.hpp"
#include "motion/evaluate/dance_metrics.hpp"

/// What a measure makes of the same dance at another tempo. Jerk divided by pace^3 would stay the
/// same but for the filter: it cuts at a fixed rate a second, and so takes more of a faster dance.
namespace raks::motion {

/// Tempo / own tempo, as the dancer dances them.
inline constexpr std::array<double, 7> kJudgedPaces = {0.75, 0.85, 0.95, 1.0, 1.1, 1.2, 1.4};

/// The dance `pace` times as fast, at the same frames a second (Catmull-Rom). pace > 0.
[[nodiscard]] BodyTrack played_at_pace(const BodyTrack& track, double pace);
/// The frames that count of it. `frames`: of the track as it is, without paces.
[[nodiscard]] MetricFrames frames_at_pace(const MetricFrames& frames,
                                          std::size_t count,
                                          double pace);

/// Squares of jerks, to be added up over takes.
struct JerkSquares {
    double sum = 0.0;
    double count = 0.0;

    [[nodiscard]] double rms() const noexcept;
};
using JerkByPace = std::array<JerkSquares, kJudgedPaces.size()>;

/// Jerk (divided by pace^3) of the dance played at every kJudgedPaces. Threads: workers.
[[nodiscard]] JerkByPace jerk_by_pace(const BodyTrack& track, const MetricFrames& frames);

}  // namespace raks::motion
