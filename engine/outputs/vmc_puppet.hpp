#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/outputs/vmc_target.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/avatar/avatar.hpp"
#include "render/avatar/avatar_rig.hpp"
#include "render/avatar/face.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace raks::engine {

/// A bone as VMC has it. Unity's axes, here and in VmcFrame: left-handed, metres, y up, the figure
/// faces +z, its left is -x.
struct VmcBone {
    std::string name;  ///< of Unity's HumanBodyBones: "LeftUpperLeg"
    glm::vec3 position{0.0F};
    glm::quat rotation = motion::kNoRotation;
};

/// All that is told of a dancer at one moment.
struct VmcFrame {
    glm::vec3 root{0.0F};        ///< place of the model's root
    std::vector<VmcBone> bones;  ///< all that the avatar has, parents first
    std::array<float, render::kFaceExpressionCount> expressions{};  ///< by FaceExpression; 0..1
};

/// A dance on one avatar, as a program that shows the same avatar must be told it.
///
/// Of a VRM the bones that its file names are told, eyes too, each against the node above it, in
/// the metres of the file; rotations of bones that it lacks are in the next ones that it has. Any
/// other avatar, and the mannequin, is told as a humanoid with all 52 bones and no rotations at
/// rest. Only the hips move from their place at rest.
///
/// Threads: one.
class VmcPuppet {
 public:
    /// `avatar`: null: the mannequin.
    VmcPuppet(std::shared_ptr<const render::Avatar> avatar, const VmcStyle& style);

    /// The pose as this avatar dances it, about the place of its dancer. `danced`: of a dance body
    /// as high as the mannequin.
    [[nodiscard]] motion::Pose worn(const motion::Pose& danced, glm::vec2 place) const noexcept;
    /// What is told of it; `pose`: as worn() gives it. Holds until the next call.
    [[nodiscard]] const VmcFrame& frame(const motion::Pose& pose, const render::Face& face);
    /// The body of worn poses.
    [[nodiscard]] const motion::Skeleton& skeleton() const noexcept { return skeleton_; }
    /// The avatar that it is made for.
    [[nodiscard]] const std::shared_ptr<const render::Avatar>& avatar() const noexcept {
        return avatar_;
    }
    /// Whether rotations were asked for raw that can only be told normalised.
    [[nodiscard]] bool lacks_raw() const noexcept {
        return style_.rotations == VmcRotations::raw && !is_raw_;
    }

 private:
    // What moves a bone.
    struct Source {
        std::size_t joint = 0;  // of the rig, or a bone
        // What makes a rotation of the node one against the T-pose in the avatar's axes: W L^-1 and
        // W^-1, as HumanoidRig has L and W.
        glm::quat before = motion::kNoRotation;
        glm::quat after = motion::kNoRotation;
        glm::quat parent = motion::kNoRotation;  // the avatar's axes from those of the node above
    };
    void add_bones_of_rig();
    void add_bones_of_skeleton();
    void add_joint(std::string name, int joint, const render::JointState& rest);
    void tell_rig(const motion::Pose& pose, const render::Face& face);

    std::shared_ptr<const render::Avatar> avatar_;
    VmcStyle style_;
    motion::Skeleton skeleton_;
    float pelvis_drop_ = 0.0F;
    bool is_raw_ = false;
    std::optional<render::RigState> state_;                        // of a VRM
    std::array<int, render::kFaceExpressionCount> expressions_{};  // of the rig; -1: it lacks it
    std::vector<Source> sources_;                                  // of frame_.bones
    VmcFrame frame_;
};

}  // namespace raks::engine
