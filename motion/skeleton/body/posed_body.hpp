// Posed body: the humanoid of a clip in some of its frames, for finding out how it is built.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/skeleton/humanoid_mapping.hpp"
#include "motion/skeleton/motion_clip.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {

/// Bones of a clip in frames evenly over it (at most kMostFrames, first and last among them), in
/// the axes of the file and in its units. What is asked of it are places, which do not depend on
/// how a file describes its rest pose. The clip must outlive it. Threads: workers. Real-time: no.
class PosedBody {
 public:
    /// More frames tell nothing new about how a body is built.
    static constexpr std::size_t kMostFrames = 300;

    /// `clip` has a frame; `mapping` is of its joints.
    PosedBody(const MotionClip& clip, const HumanoidMapping& mapping);

    /// Frames that were taken.
    [[nodiscard]] std::size_t frames() const noexcept { return worlds_.size(); }
    /// The pose of the i-th of them.
    [[nodiscard]] const ClipWorldPose& world(std::size_t i) const { return worlds_[i]; }
    /// The clip.
    [[nodiscard]] const MotionClip& clip() const noexcept { return *clip_; }
    /// Its joints.
    [[nodiscard]] const HumanoidMapping& mapping() const noexcept { return *mapping_; }

    /// Whether the clip has a joint for a bone.
    [[nodiscard]] bool has(Bone bone) const { return mapping_->joint(bone).has_value(); }
    /// Joint of a bone that it has.
    [[nodiscard]] std::size_t joint(Bone bone) const { return *mapping_->joint(bone); }
    /// Place of a bone that it has.
    [[nodiscard]] const glm::dvec3& place(std::size_t i, Bone bone) const {
        return worlds_[i].positions[joint(bone)];
    }
    /// The lowest tip of a side's foot: end site of toes or foot, or the joint.
    [[nodiscard]] glm::dvec3 toe_tip(std::size_t i, Side side) const;

    /// Mean of the vector from one joint to another in the first one's frame: constant where
    /// nothing between them moves.
    [[nodiscard]] glm::dvec3 local_vector(std::size_t from, std::size_t to) const;
    /// Median distance of two bones that it has.
    [[nodiscard]] double distance(Bone a, Bone b) const;

 private:
    const MotionClip* clip_;
    const HumanoidMapping* mapping_;
    std::vector<ClipWorldPose> worlds_;
};

/// Tip of a foot in the world: end site of the toes or of the foot, or the joint itself; file
/// units.
[[nodiscard]] glm::dvec3 toe_tip_of(const MotionClip& clip,
                                    const HumanoidMapping& mapping,
                                    Side side,
                                    const std::vector<glm::dvec3>& positions,
                                    const std::vector<glm::dquat>& rotations);

}  // namespace raks::motion
