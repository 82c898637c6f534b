// Motion comparison: how far two motions of the same dance are apart.
#pragma once

#include <array>
#include <optional>

#include "base/expected.hpp"
#include "motion/evaluate/body_track.hpp"

namespace raks::motion {

/// How far one joint is from itself in another motion; means over time.
struct JointDifference {
    double from_hips = 0.0;  ///< distance with both hips in one place; metres
    double world = 0.0;      ///< distance; metres
    /// Angle between the two directions of the bone that begins at the joint, degrees; none: no
    /// joint of the 19 follows it.
    std::optional<double> angle;
};

/// How far two motions are apart.
struct MotionComparison {
    std::array<JointDifference, kBodyBones.size()> joints{};  ///< by joint of kBodyBones
    std::array<JointDifference, 2> toes{};                    ///< tips, by Side; no angles
    double from_hips = 0.0;  ///< mean over all joints but the hips; metres
    double world = 0.0;      ///< mean over all joints; metres
    double feet = 0.0;       ///< mean over both ankles, from the hips; metres
    double angle = 0.0;      ///< mean over all bones; degrees
    double seconds = 0.0;    ///< that were compared
    /// Speed of the other's toes while the same toe of `one` stands, which nine tenths of these
    /// moments do not exceed; m/s; none: no toe stands in `one`.
    std::optional<double> planted_toes;
};

/// Compares the moments that both motions have, at the frames of `one`. `shift`: seconds by which
/// `other` begins later than `one`. A toe stands where its tip is slower than 0.12 m/s and within
/// 3 cm of where it is lowest (its 5th percentile). Errors: no moment in common, a track without
/// frames. Threads: any. Real-time: no.
[[nodiscard]] Expected<MotionComparison> compare_motions(const BodyTrack& one,
                                                         const BodyTrack& other,
                                                         double shift = 0.0);

}  // namespace raks::motion
