// Bones by shape: a body's joints from the tree of a clip and its motion, whatever they are called.
#pragma once

#include <array>
#include <vector>

#include "motion/skeleton/body/posed_skeleton.hpp"
#include "motion/skeleton/humanoid_mapping.hpp"

namespace raks::motion {

/// Which joints are the bones of a body; -1: none is.
struct BonesByShape {
    std::array<int, kBoneCount> joints = [] {
        std::array<int, kBoneCount> none{};
        none.fill(-1);
        return none;
    }();
    double fit = 0.0;  ///< 0: no body; to 1: how well lengths and motion fit one

    [[nodiscard]] int joint(Bone bone) const { return joints[index_of(bone)]; }
    [[nodiscard]] HumanoidMapping mapping() const;
};

/// The bodies in a skeleton, the best first, at most two: two equal limbs of three joints or more
/// on a hub, two more on another hub, farther from what carries both (the trunk's length), and a
/// way on from there to a head. The limbs of the nearer hub are the legs. Upper, lower and last
/// joint of a limb are those three whose bones keep their length, are about as long as each other
/// and make up most of the limb: twist, roll and helper joints are passed over. Fingers and spine
/// are left open. Which side is left is not known here: see side_evidence.
/// Threads: workers. Real-time: no.
[[nodiscard]] std::vector<BonesByShape> bodies_by_shape(const PosedSkeleton& skeleton);

/// Two equal limbs that may be legs (longest of the skeleton), where there is no whole body: hips,
/// upper, lower leg, foot and toes. Empty: there are none.
[[nodiscard]] BonesByShape legs_by_shape(const PosedSkeleton& skeleton);

}  // namespace raks::motion
