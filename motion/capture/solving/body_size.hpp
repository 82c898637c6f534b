// Body size: how a dancer's body differs from the mannequin's.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/solving/body_model.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::capture {

inline constexpr double kMannequinHeight = 1.714;  ///< metres

/// Parts of a body that differ in size, alike on both sides.
enum class BodyPart : std::uint8_t {
    pelvis,     ///< from the hips to the legs' joints
    thigh,      ///< from there to the knee
    shin,       ///< from the knee to the ankle
    foot,       ///< from the ankle to toes and sole
    trunk,      ///< from the hips to the neck
    neck,       ///< from the neck to the head
    shoulder,   ///< from the upper chest to the arm's joint
    upper_arm,  ///< from there to the elbow
    forearm,    ///< from the elbow to the hand
    hand,       ///< the hand and its fingers
};
inline constexpr std::size_t kBodyParts = 10;  ///< number of parts
/// Their names, by BodyPart.
inline constexpr std::array<std::string_view, kBodyParts> kBodyPartNames = {
    "pelvis", "thigh", "shin", "foot", "trunk", "neck", "shoulder", "upper_arm", "forearm", "hand"};

/// The part whose size sets how far a bone's joint is from its parent's.
[[nodiscard]] BodyPart part_before(motion::Bone bone) noexcept;
/// The part whose size sets where points of a bone are.
[[nodiscard]] BodyPart part_of(motion::Bone bone) noexcept;

/// A body by its differences from the mannequin.
struct BodySize {
    double whole = 1.0;  ///< height / the mannequin's
    std::array<double, kBodyParts> parts = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    ///< by BodyPart: length / that of the mannequin as tall
    /// By bone: distance of its joint from its parent's / what the parts make of it. 1: as they do.
    std::array<double, motion::kBoneCount> bones = filled_with_ones();
    std::vector<glm::dvec3> marker_shifts;  ///< by marker, in the bone's frame, metres

    /// Length of a bone or place on it / the mannequin's.
    [[nodiscard]] double factor(BodyPart part) const noexcept {
        return whole * parts[static_cast<std::size_t>(part)];
    }

    /// How far a bone's joint is from its parent's / in the mannequin.
    [[nodiscard]] double bone_factor(motion::Bone bone) const noexcept {
        return factor(part_before(bone)) * bones[motion::index_of(bone)];
    }

 private:
    static constexpr std::array<double, motion::kBoneCount> filled_with_ones() noexcept {
        std::array<double, motion::kBoneCount> ones{};
        for (double& one : ones) {
            one = 1.0;
        }
        return ones;
    }
};

/// The shape of a body of this size with these markers.
[[nodiscard]] BodyShape shape_of(const BodySize& size, const MarkerSet& markers);
/// The same as a skeleton.
[[nodiscard]] motion::Skeleton skeleton_of(const BodySize& size);

}  // namespace raks::capture
