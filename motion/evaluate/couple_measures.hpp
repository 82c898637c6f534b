#pragma once

#include <span>
#include <vector>

#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Two who dance together.
struct CoupleMeasures {
    std::vector<double> hands;    ///< lead's left wrist to follow's right, by frame; metres
    std::vector<double> facing;   ///< how far either looks past the other, by frame; radians
    std::vector<double> closest;  ///< skin to skin, by frame; metres, negative: into one another
};

/// How near the bodies are, trunks, heads and legs with the mannequin's girth (hands and arms hold
/// one another); metres, negative: so deep into one another. Threads: any. Real-time: no.
[[nodiscard]] double body_clearance(const Skeleton& skeleton, const Pose& one, const Pose& other);

/// As many poses of both. Threads: workers. Real-time: no.
[[nodiscard]] CoupleMeasures measure_couple(const Skeleton& skeleton,
                                            std::span<const Pose> lead,
                                            std::span<const Pose> follow);

}  // namespace raks::motion
