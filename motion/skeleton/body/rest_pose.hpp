// Rest pose: how the bones of a file lie in its joints' frames, and from there to our T-pose.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "motion/skeleton/body/posed_body.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {

/// What a file's joints are when none is rotated.
enum class RestKind : std::uint8_t {
    t_pose,         ///< ours: facing +z
    turned_t_pose,  ///< a T-pose along other axes
    other,          ///< arms down, sitting, all bones along one axis, the first frame, ...
};

/// Rotations from the frames of a clip's joints to those of our T-pose.
///
/// Where the joints of a body are in the world does not depend on how its file describes the rest
/// pose; the joints' frames do. Any rest pose gives each joint another frame, turned by a rotation
/// that is constant over the clip. It is found bone by bone from the hips down:
///
/// 1. *Direction.* The bone as it lies in the joint's frame (mean over posed frames) is turned to
///    where it points in the T-pose of the mannequin. Hips, the bone that carries the shoulders and
///    hands with fingers have a second direction (left to right), so nothing is left open.
/// 2. *Twist* about the bone, which its direction leaves open. What the motion says: knees bend
///    backward and elbows forward, about the hinge that lies across the thigh or arm in the T-pose;
///    all others are twisted as little as possible against the bone above, on average over the
///    frames. This is good to some 20 degrees, so it only chooses between what files are written
///    like:
///    a. the frame of the bone above or of the whole figure, where that already points the bone
///       right (the forearm of an A-pose, the shin of a sitting body);
///    b. the shortest turn from the file's direction to the T-pose's, where the rest pose is the
///       same on both sides (arms down);
///    c. for a bone along an axis, that turn and quarter turns about the bone.
///    Only where none of these is near (the rest pose is some frame) the estimate itself is taken.
///
/// So rest poses that were drawn give exact rotations; one that is a moment of the dance gives
/// exact directions (places of all joints), and twists of the mildest motion. A limb whose rest
/// pose is a T-pose within some degrees is taken as it is.
struct RestPose {
    RestKind kind = RestKind::t_pose;
    std::vector<glm::dquat> joints;  ///< by joint of the clip; those without a bone move with one
    std::array<glm::dquat, kBoneCount> bones{};  ///< by bone; the parent's where the clip has none
    double confidence = 1.0;                     ///< 0 to 1
    std::string reason;                          ///< a few words
};

/// Finds the rest pose. `upright`: turns the file's world to y up (up_finder.hpp).
[[nodiscard]] RestPose find_rest_pose(const PosedBody& body, const glm::dquat& upright);

}  // namespace raks::motion
