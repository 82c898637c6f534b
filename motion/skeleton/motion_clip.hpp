// Motion clip: recorded motion as its file has it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "motion/skeleton/expression_track.hpp"
#include "motion/skeleton/joint_labels.hpp"
#include "motion/skeleton/known_body.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {

/// One joint of a recorded skeleton. Lengths are in file units.
struct ClipJoint {
    std::string name;        ///< as written, with any "prefix:"; may be empty, blank or used twice
    std::size_t parent = 0;  ///< index; smaller than its children's; a root is its own parent
    glm::dvec3 offset{};     ///< from the parent's joint at rest
    std::optional<glm::dvec3> end_site;  ///< tip of a leaf, in this joint's frame
};

/// Recorded motion of any skeleton, in file units: the content of a motion file. It is meant for
/// training and tools: double precision, may allocate.
struct MotionClip {
    std::vector<ClipJoint> joints;          ///< parents before their children
    double frames_per_second = 0.0;         ///< > 0 once read
    std::size_t frame_count = 0;            ///< at least 1 once read
    std::vector<glm::dquat> rotations;      ///< local; frames x joints, row-major
    std::vector<glm::dvec3> positions;      ///< in the parent's frame; frames x joints, row-major
    std::optional<double> metres_per_unit;  ///< where the format or the file says it; > 0
    std::optional<glm::dvec3> up;           ///< where the format or the file says it; unit length
    /// Whether the format rests in our T-pose, y up, facing +z. Its joints' frames are then known
    /// though no bone of a real body lies quite along an axis.
    bool rests_in_t_pose = false;
    /// Of the face, one weight a frame, where the format has them.
    std::vector<ExpressionTrack> expressions;
    std::vector<std::string> warnings;  ///< one line each, without the file's name
    std::optional<KnownBody> known{};   ///< of a clip in a model whose body is found
    JointLabels labels;  ///< which joint is which bone, where a person said so; no reader sets it

    /// Local rotation of a joint at a frame.
    [[nodiscard]] const glm::dquat& rotation(std::size_t frame, std::size_t joint) const noexcept {
        return rotations[frame * joints.size() + joint];
    }
    /// Place of a joint in its parent's frame.
    [[nodiscard]] const glm::dvec3& position(std::size_t frame, std::size_t joint) const noexcept {
        return positions[frame * joints.size() + joint];
    }
};

/// Place and orientation of every joint in the world at one frame, file units.
struct ClipWorldPose {
    std::vector<glm::dvec3> positions;  ///< by joint
    std::vector<glm::dquat> rotations;  ///< by joint
};
/// Forward kinematics of one frame, `frame` < frame_count. Threads: any. Real-time: no.
[[nodiscard]] ClipWorldPose world_pose(const MotionClip& clip, std::size_t frame);

/// The rest pose: places of the joints with no rotation and the root at its offset, file units.
[[nodiscard]] std::vector<glm::dvec3> rest_positions(const MotionClip& clip);

/// Metres per file unit: what the clip says, else guessed from the height of the rest pose (tips
/// included): centimetres, metres or millimetres, the first that gives a body of 0.5 to 2.5 m;
/// otherwise scaled to 1.7 m.
[[nodiscard]] double guess_metres_per_unit(const MotionClip& clip);

/// Number of frames at the start that are not part of the motion: 1 when frame 0 is a T-pose that
/// the next frame leaves by a jump (as in most CMU conversions), else 0. Training leaves them out.
[[nodiscard]] std::size_t leading_rest_frames(const MotionClip& clip);

}  // namespace raks::motion
