#include "motion/skeleton/body/trunk_chain.hpp"

#include <algorithm>
#include <string>

#include "motion/skeleton/body/bone_words.hpp"

namespace raks::motion {

std::vector<int> trunk_chain(const MotionClip& clip,
                             const PosedSkeleton& skeleton,
                             const HumanoidMapping& mapping) {
    const auto joint = [&](Bone bone) {
        return mapping.joint(bone) ? static_cast<int>(*mapping.joint(bone)) : -1;
    };
    const ParentTree& tree = skeleton.tree();
    const int hips = joint(Bone::hips);
    if (hips < 0 || joint(Bone::left_upper_arm) < 0 || joint(Bone::right_upper_arm) < 0) {
        return {};
    }
    int top = tree.carrier_of(joint(Bone::left_upper_arm), joint(Bone::right_upper_arm));
    if (top >= 0 && top == joint(Bone::neck)) {  // Biped hangs the arms on the neck
        top = tree.parent(top);
    }
    std::vector<int> all;
    double length = 0.0;
    for (int at = top; at >= 0 && at != hips; at = tree.parent(at)) {
        all.push_back(at);
        length += skeleton.length(at);
    }
    std::reverse(all.begin(), all.end());
    constexpr double kNoLength = 1e-3;  // of the trunk
    std::vector<int> chain;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool is_last = i + 1 == all.size();
        const auto words = words_of_name(clip.joints[static_cast<std::size_t>(all[i])].name);
        const bool is_twist = std::find(words.begin(), words.end(), "twist") != words.end();
        if (is_last || (!is_twist && skeleton.length(all[i + 1]) > kNoLength * length)) {
            chain.push_back(all[i]);
        }
    }
    return chain;
}

}  // namespace raks::motion
