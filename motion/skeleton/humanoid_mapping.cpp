#include "motion/skeleton/humanoid_mapping.hpp"

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

}  // namespace raks::motion
