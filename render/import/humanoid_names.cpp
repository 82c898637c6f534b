#include "render/import/humanoid_names.hpp"

#include <vector>

#include "motion/skeleton/body/bones_by_name.hpp"
#include "render/import/node_tree.hpp"

namespace raks::render {

HumanoidMap map_by_names(const Model& model, const NodeFlesh& flesh) {
    // Whether a node may be a bone is asked of skins first.
    std::vector<motion::NamedNode> nodes;
    for (const ModelNode& node : model.nodes) {
        nodes.push_back({.name = node.name, .is_joint = model.skins.empty()});
    }
    for (const ModelSkin& skin : model.skins) {
        for (const int node : skin.joints) {
            const auto at = static_cast<std::size_t>(node);
            nodes[at].is_joint = flesh.is_empty() || flesh.is_fleshy[at];
        }
    }
    const motion::BonesByName found = motion::bones_by_name(nodes, TreeOrder(model));
    HumanoidMap map;
    map.nodes = found.nodes;
    for (std::size_t bone = 0; bone < map.nodes.size(); ++bone) {
        constexpr float kByName = 0.9F;
        map.reasons[bone] = map.nodes[bone] < 0 ? BoneReason::none : BoneReason::name;
        map.confidence[bone] = map.nodes[bone] < 0 ? 0.0F : kByName;
    }
    if (map.nodes[0] >= 0 && found.are_hips_by_tree) {
        map.reasons[0] = BoneReason::shape;
    }
    map.left_eye = found.left_eye;
    map.right_eye = found.right_eye;
    map.jaw = found.jaw;
    return map;
}

}  // namespace raks::render
