// Bones by the names of nodes: of a model as of a recorded skeleton.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "motion/skeleton/body/parent_tree.hpp"
#include "motion/skeleton/humanoid.hpp"

namespace raks::motion {

/// A node by its name.
struct NamedNode {
    std::string_view name;
    bool is_joint = true;  ///< false: it moves nothing, though others do; taken only for want
};

/// Which nodes their names give away as bones; -1: none does.
struct BonesByName {
    std::array<int, kBoneCount> nodes = [] {
        std::array<int, kBoneCount> none{};
        none.fill(-1);
        return none;
    }();
    bool are_hips_by_tree = false;  ///< hips are what carries legs and arms, whatever its name
    int left_eye = -1;
    int right_eye = -1;
    int jaw = -1;
};

/// The bones that names give away: motion capture suits, research sets, engines, modelling
/// programs and all that is built like them (see bone_words.hpp); what no name tells is left open.
/// Names alone do not decide: hips carry legs and trunk, "leg" is the upper one where a knee is
/// named, the trunk is counted from hips to arms. `nodes` and `tree`: of the same nodes.
/// Threads: workers. Real-time: no.
[[nodiscard]] BonesByName bones_by_name(std::span<const NamedNode> nodes, const ParentTree& tree);

}  // namespace raks::motion
