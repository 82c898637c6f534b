// The body of an avatar as its mesh says: what a dance must be solved for.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/avatar/avatar.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// A point of the mesh in the T-pose and what moves it most.
struct FleshPoint {
    glm::vec3 place{};  ///< metres; the floor may lie anywhere
    /// motion::Bone; kBoneCount: none, as of hair, skirts and others that swing
    std::size_t bone = motion::kBoneCount;
};

/// All vertices of an avatar, in the T-pose, where its rig or, without one, its skeleton puts it.
/// Threads: any. Real-time: no.
[[nodiscard]] std::vector<FleshPoint> flesh_of(const Avatar& avatar);

/// What is known of a body's bones in the T-pose.
struct BonePlaces {
    std::array<glm::vec3, motion::kBoneCount> places{};  ///< of the joints; metres
    std::array<bool, motion::kBoneCount> is_there{};     ///< false: the body lacks the bone
};

/// A body, measured.
struct MeasuredBody {
    motion::Skeleton skeleton;  ///< standing on the floor
    float soles = 0.0F;         ///< height of the soles where `flesh` was measured; metres
    float height = 0.0F;        ///< from soles to top; metres
    float pelvis_drop = 0.0F;   ///< as Avatar has it
};

/// Measures bones, soles and girth. What the mesh does not say (no foot, no finger, fewer than 8
/// vertices on a limb) is taken from the mannequin, as large as this body by the height of the
/// legs; girth is kept within 0.5 and 8 times that. A foot without toes bends at its tip.
/// Threads: any. Real-time: no.
[[nodiscard]] MeasuredBody measure_body(std::span<const FleshPoint> flesh, const BonePlaces& bones);

}  // namespace raks::render
