#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "motion/skeleton/humanoid.hpp"
#include "training/cells/take_moments.hpp"
#include "training/figures/figure_trainer.hpp"

/// Grid cues: what the motion of a take says of its beats, at one rate whatever the clip's.
namespace raks::motion {

/// Rows of GridCues a second.
inline constexpr double kCueRate = 60.0;

/// Mean body speed over a second below which nobody dances, m/s.
inline constexpr double kIdleBodySpeed = 0.25;

/// A foot that came to rest after a step.
struct CueLanding {
    double time = 0.0;       ///< seconds of the clip
    Side side = Side::left;  ///< which foot
};

/// What braking feet, hips that are pushed up or aside, trunk and hands that stop say, row by row.
struct GridCues {
    std::vector<double> impulse;       ///< all of it weighed; about 0 on the mean, may be negative
    std::vector<double> hips_height;   ///< metres
    std::vector<double> hips_speed;    ///< m/s
    std::vector<double> feet_speed;    ///< of the faster foot, m/s
    std::vector<double> body_speed;    ///< about the hips, mean over a second, m/s
    std::vector<TakeMoment> moments;   ///< how the body stands and moves
    std::vector<CueLanding> landings;  ///< of both feet, rising

    [[nodiscard]] std::size_t rows() const noexcept { return impulse.size(); }
    [[nodiscard]] double seconds() const noexcept {
        return rows() > 0 ? static_cast<double>(rows() - 1) / kCueRate : 0.0;
    }
    /// The row nearest to a moment, within them; there is at least one.
    [[nodiscard]] std::size_t row_at(double time) const noexcept;
};

/// The cues of a clip, its faults bridged. The clip has poses and feet. Deterministic. Threads:
/// workers. Real-time: no.
[[nodiscard]] GridCues grid_cues(const TrainingClip& clip);

/// Rows [first, last) in which somebody dances.
struct ActiveRows {
    std::size_t first = 0;
    std::size_t last = 0;
};
/// Stretches whose body speed stays above kIdleBodySpeed; pauses under a second do not part them,
/// and what is shorter than two seconds is none.
[[nodiscard]] std::vector<ActiveRows> active_rows(const GridCues& cues);

}  // namespace raks::motion
