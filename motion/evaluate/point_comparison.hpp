// Point comparison: how far each point of one motion is from the same point of another, over time.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/points/joint_points.hpp"

namespace raks::motion {

/// A point that both motions have.
struct PointPair {
    std::size_t one = 0;    ///< index in the first motion
    std::size_t other = 0;  ///< index in the second
    std::string name;       ///< as the first has it
};

/// The points that both have: by name as written; else by name without "prefix:" and case; else, of
/// two bodies, by bone. No point is in two pairs. In the first motion's order. Tips are left out.
[[nodiscard]] std::vector<PointPair> common_points(const WorldPoints& one,
                                                   const WorldPoints& other);

/// The second motion at the frames of the first: places on the line between two of its frames, NaN
/// where either was not seen or there is no such moment. `shift`: seconds by which the second
/// begins later.
[[nodiscard]] WorldPoints at_frames_of(const WorldPoints& one,
                                       const WorldPoints& other,
                                       double shift = 0.0);

/// How far one point is from itself in the other motion.
struct PointDistance {
    std::string name;
    double rms = 0.0;              ///< metres, over the frames in which both are seen
    double worst = 0.0;            ///< metres
    std::size_t worst_frame = 0;   ///< where it is
    std::size_t frames = 0;        ///< in which both are seen; 0: the rest says nothing
    std::vector<float> over_time;  ///< metres, by frame of the first motion; NaN: not seen in both
};

/// How far two motions are apart.
struct PointComparison {
    std::vector<PointDistance> points;  ///< by pair
    double rms = 0.0;                   ///< metres, over all points and frames
    std::size_t worst_point = 0;        ///< index: that of the largest RMS
    std::size_t worst_frame = 0;        ///< that of the largest RMS over its points
    double worst_frame_rms = 0.0;       ///< metres, there
    std::vector<float> rms_over_time;   ///< metres, by frame, over its points; NaN: none is seen
    std::size_t frames = 0;             ///< in which at least one pair is seen
};

/// Compares point by point; `other` is at the frames of `one`. Errors: no pair, or none that both
/// see at any moment. Threads: any. Real-time: no.
[[nodiscard]] Expected<PointComparison> compare_points(const WorldPoints& one,
                                                       const WorldPoints& other,
                                                       const std::vector<PointPair>& pairs);

}  // namespace raks::motion
