#include "render/import/limb_faults.hpp"

#include <fmt/format.h>

#include "base/printable.hpp"
#include "render/import/node_tree.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

constexpr float kMostUneven = 3.0F;  // of the lengths of a limb's two bones
constexpr float kNarrow = 0.12F;     // half the way between both upper arms, of an arm's length

}  // namespace

std::string limb_fault(const Model& model,
                       const HumanoidMap& humanoid,
                       const CheckedLimb& limb,
                       std::span<const glm::mat4> world,
                       const NodeFlesh& flesh) {
    const auto node = [&](motion::Bone bone) { return humanoid.nodes[motion::index_of(bone)]; };
    const auto place = [&](motion::Bone bone) {
        return glm::vec3(world[static_cast<std::size_t>(node(bone))][3]);
    };
    const auto says = [&](motion::Bone bone, const char* what) {
        return fmt::format("\"{}\" ({}) {}",
                           printable(node_of(model, node(bone)).name, 40),
                           motion::kBoneNames[motion::index_of(bone)],
                           what);
    };
    if (node(limb.upper) < 0 || node(limb.lower) < 0) {
        return {};
    }
    if (!is_below(model, node(limb.lower), node(limb.upper))) {
        return says(limb.lower, "does not hang on the bone above it");
    }
    for (const motion::Bone bone : {limb.upper, limb.lower}) {
        if (!flesh.is_empty() && !flesh.is_fleshy[static_cast<std::size_t>(node(bone))]) {
            return says(bone, "moves nothing of its skin");
        }
    }
    const float upper = glm::distance(place(limb.upper), place(limb.lower));
    float arm = upper;
    if (node(limb.last) >= 0) {
        const float lower = glm::distance(place(limb.lower), place(limb.last));
        arm += lower;
        if (upper > kMostUneven * lower || lower > kMostUneven * upper) {
            return says(limb.upper, "is far longer or shorter than the bone below it");
        }
    }
    const motion::Bone other = mirrored(limb.upper);
    const bool is_arm =
        limb.last == motion::Bone::left_hand || limb.last == motion::Bone::right_hand;
    if (is_arm && node(other) >= 0 &&
        0.5F * glm::distance(place(limb.upper), place(other)) < kNarrow * arm) {
        return says(limb.upper, "lies inside the chest");
    }
    return {};
}

}  // namespace raks::render
