// Fingers by shape: which chain of joints on a hand is which finger, whatever they are called.
#pragma once

#include <array>

#include "motion/skeleton/body/joint_finder.hpp"
#include "motion/skeleton/body/posed_skeleton.hpp"

namespace raks::motion {

/// The fingers of one hand.
struct FingersByShape {
    /// Of thumb, index, middle, ring and little finger the joints as VRM counts them, from the
    /// hand on; -1: there is none.
    std::array<std::array<int, 3>, 5> joints = [] {
        std::array<std::array<int, 3>, 5> none{};
        for (auto& finger : none) {
            finger.fill(-1);
        }
        return none;
    }();
    int chains = 0;         ///< of two joints or more on the hand
    bool is_found = false;  ///< whether these are five fingers
};

/// Looks at the chains of joints that end below `hand`. Five are fingers where one begins clearly
/// nearer to the wrist, or is the only one without a joint within the palm: the thumb. The other
/// four are told by the line on which they begin: the index finger is at the thumb's end of it.
/// Joints within the palm and at the tips are passed over. Which hand it is does not matter. Cost:
/// joints below the hand. Threads: workers. Real-time: no.
[[nodiscard]] FingersByShape fingers_by_shape(const PosedSkeleton& skeleton, int hand);

/// Adds the fingers of hands that are found and have none yet; where they are not clear a note says
/// so, once. `skeleton`: of the clip whose joints `found` holds. Threads: workers. Real-time: no.
void take_fingers(const PosedSkeleton& skeleton, FoundJoints& found);

}  // namespace raks::motion
