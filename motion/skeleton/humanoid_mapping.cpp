#include "motion/skeleton/humanoid_mapping.hpp"

#include "motion/skeleton/body/joint_finder.hpp"

namespace raks::motion {

std::optional<Bone> mapped_parent(const HumanoidMapping& mapping, Bone bone) {
    while (bone != Bone::hips) {
        bone = static_cast<Bone>(kBoneParents[index_of(bone)]);
        if (mapping.joint(bone)) {
            return bone;
        }
    }
    return std::nullopt;
}

Expected<HumanoidMapping> map_humanoid(const MotionClip& clip) {
    const Expected<FoundJoints> found = find_joints(clip);
    if (!found) {
        return fail(found.error());
    }
    return found->mapping;
}

}  // namespace raks::motion
