// Couple measures: hands, facing and distance of a couple.
#pragma once

#include <span>
#include <vector>

#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Measures of a couple, by frame.
struct CoupleMeasures {
    std::vector<double> hands;    ///< from the lead's left wrist to the follow's right one; metres
    std::vector<double> facing;   ///< the larger angle by which one looks past the other; radians
    std::vector<double> closest;  ///< distance of their skins; metres; negative: inside one another
};

/// A pair of palms of a couple.
struct PalmPair {
    Side lead = Side::left;     ///< the lead's hand
    Side follow = Side::right;  ///< the follow's
};
/// Where two palms are.
struct PalmsAt {
    double apart = 0.0;   ///< between their middles; metres
    double height = 0.0;  ///< of the middle between them over the floor; metres
};
/// Measures a pair of palms. Threads: any. Real-time: yes.
[[nodiscard]] PalmsAt measure_palms(const Skeleton& skeleton,
                                    const PalmPair& pair,
                                    const Pose& lead,
                                    const Pose& follow);

/// Distance between two bodies' skins (trunk, head and legs with the mannequin's girth; hands and
/// arms are left out, as they hold one another); metres; negative: inside one another. Threads:
/// any. Real-time: no.
[[nodiscard]] double body_clearance(const Skeleton& skeleton, const Pose& one, const Pose& other);

/// Measures a couple; as many poses of both. Threads: workers. Real-time: no.
[[nodiscard]] CoupleMeasures measure_couple(const Skeleton& skeleton,
                                            std::span<const Pose> lead,
                                            std::span<const Pose> follow);

}  // namespace raks::motion
