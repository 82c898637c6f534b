// From the humanoid to a body of MikuMikuDance.
#pragma once

#include <cstdint>

#include "motion/skeleton/formats/mmd/mmd_body.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// How the legs of a motion that is written are moved.
enum class MmdLegs : std::uint8_t {
    ik,  ///< by goals for the feet, which stand on the floor under bodies of any height
    fk,  ///< by turns alone, with the inverse kinematics switched off
};

/// The keys that put the standard body into a pose of `skeleton`: each bone turned in the world as
/// there, the way scaled by the ratio of the hips' heights. Of the spine's three turns the first
/// and the last are kept. With MmdLegs::ik a knee is a hinge about its x, as MikuMikuDance's solver
/// makes it: thigh and shin point as there, and what the shin turns about itself goes into the
/// foot's joint; goals of the feet are where the turns put them, so that a solver has nothing left
/// to do on the standard body. Threads: any. Real-time: no.
[[nodiscard]] MmdPose mmd_pose_of(const MmdBody& body,
                                  const Skeleton& skeleton,
                                  const Pose& pose,
                                  MmdLegs legs);

}  // namespace raks::motion
