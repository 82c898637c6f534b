#include "render/import/humanoid_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "render/import/bind_places.hpp"
#include "render/import/node_tree.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

using motion::Bone;
using motion::Side;

// What it costs to look has a bound: no figure has more joints.
constexpr std::size_t kMostShapeJoints = 2000;
constexpr glm::vec3 kUp{0.0F, 1.0F, 0.0F};

/// Which nodes may be joints of a body: those of skins that move some of it.
std::vector<bool> skin_joints(const Model& model, const NodeFlesh& flesh) {
    std::vector<bool> joints(model.nodes.size(), false);
    for (const ModelSkin& skin : model.skins) {
        for (const int joint : skin.joints) {
            const auto at = static_cast<std::size_t>(joint);
            joints[at] = flesh.is_empty() || flesh.is_fleshy[at];
        }
    }
    return joints;
}

/// Upper, lower and last joint of a limb, as places in the way along it. `last` is as many as the
/// way has joints where the limb has no hand: it then ends where its flesh does.
struct LimbJoints {
    std::size_t upper = 0;
    std::size_t lower = 1;
    std::size_t last = 2;
    float cost = std::numeric_limits<float>::infinity();
};

class ShapeMapper {
 public:
    explicit ShapeMapper(const JointShape& shape) : shape_(shape) {}

    HumanoidMap map() {
        constexpr std::size_t kLegJoints = 3;
        for (const std::size_t arm_joints : {std::size_t{3}, std::size_t{2}}) {
            for (const int node : shape_.nodes()) {
                const LimbPair legs =
                    shape_.alike_limbs(node, -1, kLegJoints, [this](const std::vector<int>& way) {
                        const float end = shape_.place(way.back()).y - shape_.lowest();
                        return end < 0.15F * shape_.height() &&
                               shape_.reach(way.front()) > 0.25F * shape_.height();
                    });
                if (!legs.left.empty() && map_trunk(node, legs, arm_joints)) {
                    map_leg(legs.left, Side::left);
                    map_leg(legs.right, Side::right);
                    return map_;
                }
                map_ = HumanoidMap();
            }
        }
        return {};
    }

 private:
    void set(Bone bone, int node) {
        map_.nodes[motion::index_of(bone)] = node;
        constexpr float kByShape = 0.8F;
        map_.reasons[motion::index_of(bone)] = BoneReason::shape;
        map_.confidence[motion::index_of(bone)] = kByShape;
    }

    static bool begins_with(const LimbPair& limbs, int node) {
        return !limbs.left.empty() && (node == limbs.left.front() || node == limbs.right.front());
    }

    /// The child that leads highest, but for `back` and what limbs begin with; where none leads
    /// above `from`, the parent, if that does, as where hips hang under the trunk. -1: none does.
    int way_up(int from, int back, const LimbPair& legs, const LimbPair& arms) const {
        int best = -1;
        float highest = shape_.place(from).y;
        for (const int child : shape_.children(from)) {
            if (child != back && !begins_with(legs, child) && !begins_with(arms, child) &&
                shape_.top(child) > highest) {
                highest = shape_.top(child);
                best = child;
            }
        }
        const int parent = shape_.parent(from);
        const bool leads_up = parent >= 0 && parent != back && shape_.top_above(from) > highest;
        return best < 0 && leads_up ? parent : best;
    }

    /// The arms that hang on a node of the trunk. Empty: none do.
    LimbPair arms_at(int node, int back, const LimbPair& legs, std::size_t joints) const {
        return shape_.alike_limbs(node, back, joints, [&](const std::vector<int>& way) {
            return !begins_with(legs, way.front()) &&
                   shape_.reach(way.front()) > 0.2F * shape_.height();
        });
    }

    /// From the hips up to the arms; false: there is no trunk with arms.
    bool map_trunk(int hips, const LimbPair& legs, std::size_t arm_joints) {
        std::vector<int> trunk;
        LimbPair arms = arms_at(hips, -1, legs, arm_joints);
        int back = -1;
        int node = hips;
        while (arms.left.empty()) {
            const int next = way_up(node, back, legs, {});
            if (next < 0 || trunk.size() > shape_.nodes().size()) {
                return false;
            }
            back = node;
            node = next;
            trunk.push_back(node);
            arms = arms_at(node, back, legs, arm_joints);
        }
        const int head = way_up(node, back, legs, arms);
        if (head < 0) {
            return false;
        }
        // A root on the floor, on which hips and trunk hang side by side, is no part of the trunk.
        const float lowest = shape_.place(hips).y - 0.05F * shape_.height();
        std::erase_if(trunk, [&](int one) { return shape_.place(one).y < lowest; });
        set(Bone::hips, hips);
        if (!trunk.empty()) {
            set(Bone::spine, trunk.front());
        }
        if (trunk.size() > 1) {
            set(Bone::chest, trunk[trunk.size() / 2]);
        }
        if (trunk.size() > 2) {
            set(Bone::upper_chest, trunk.back());
        }
        map_head(head);
        map_arm(arms.left, arms.right, Side::left);
        map_arm(arms.right, arms.left, Side::right);
        return true;
    }

    /// Neck and head: the head is where the way parts (eyes, hair), else the second joint.
    void map_head(int first) {
        const std::vector<int> way = shape_.longest_way(first);
        std::size_t head = way.size() > 1 ? 1 : 0;
        if (way.size() > 2 && shape_.children(first).size() > 1) {
            head = 0;
        }
        set(Bone::head, way[head]);
        if (head > 0) {
            set(Bone::neck, first);
        }
    }

    /// The place of a joint of a way; its tip behind the last.
    glm::vec3 place_along(const std::vector<int>& way, std::size_t at) const {
        return at < way.size() ? shape_.place(way[at]) : shape_.tip(way.back());
    }

    /// How badly three joints of a way are upper, lower and last joint of a limb: about 0 for those
    /// that are. `usual_ratio`: of the upper bone's length to the lower one's; `usual_tail`: the
    /// share of the whole that hangs on the last joint.
    float cost_of(const std::vector<int>& way,
                  const LimbJoints& joints,
                  float usual_ratio,
                  float usual_tail) const {
        constexpr float kRatioSpread = 0.4F;  // of the logarithm
        constexpr float kInFront = 1.0F;      // a collar bone is no long part of an arm
        constexpr float kBehind = 2.0F;
        const auto length = [&](std::size_t from, std::size_t to) {
            float sum = 0.0F;
            for (std::size_t i = from; i < to; ++i) {
                sum += glm::distance(place_along(way, i), place_along(way, i + 1));
            }
            return sum;
        };
        const float upper = length(joints.upper, joints.lower);
        const float lower = length(joints.lower, joints.last);
        const float all = length(0, way.size());
        if (!(upper > 0.0F) || !(lower > 0.0F)) {
            return std::numeric_limits<float>::infinity();
        }
        const float ratio = std::log(upper / lower / usual_ratio) / kRatioSpread;
        const float front = length(0, joints.upper) / all;
        const float tail = length(joints.last, way.size()) / all;
        return 0.5F * ratio * ratio + kInFront * front + kBehind * std::abs(tail - usual_tail);
    }

    /// What it costs if the upper joint of a limb lies on the middle line of the body, as collar
    /// bones do: `other` is the same limb of the other side.
    float cost_of_middle(const std::vector<int>& way,
                         const std::vector<int>& other,
                         std::size_t upper) const {
        constexpr float kNarrow = 0.12F;  // of the limb's length
        if (upper >= other.size()) {
            return 0.0F;
        }
        const float apart = glm::distance(shape_.place(way[upper]), shape_.place(other[upper]));
        return 0.5F * apart < kNarrow * shape_.reach(way[upper]) ? 1.0F : 0.0F;
    }

    /// The joints of a leg whose foot is known.
    LimbJoints leg_joints(const std::vector<int>& way, std::size_t foot) const {
        LimbJoints best{.upper = 0, .lower = 1, .last = foot};
        for (std::size_t upper = 0; upper + 1 < foot; ++upper) {
            for (std::size_t lower = upper + 1; lower < foot; ++lower) {
                LimbJoints joints{.upper = upper, .lower = lower, .last = foot};
                joints.cost = cost_of(way, joints, 1.05F, 0.2F);
                best = joints.cost < best.cost ? joints : best;
            }
        }
        return best;
    }

    /// The joints of an arm; `hand`: where its fingers begin, 0: they do not tell.
    LimbJoints arm_joints(const std::vector<int>& way,
                          const std::vector<int>& other,
                          std::size_t hand) const {
        constexpr float kNoHand = 0.3F;
        LimbJoints best;
        const std::size_t first = hand > 0 ? hand : 1;
        const std::size_t end = hand > 0 ? hand : way.size();
        for (std::size_t last = first; last <= end; ++last) {
            const bool has_hand = last < way.size();
            for (std::size_t upper = 0; upper + 1 < last; ++upper) {
                for (std::size_t lower = upper + 1; lower < last; ++lower) {
                    LimbJoints joints{.upper = upper, .lower = lower, .last = last};
                    joints.cost =
                        cost_of(way, joints, has_hand ? 1.1F : 0.65F, has_hand ? 0.22F : 0.0F) +
                        cost_of_middle(way, other, upper) + (has_hand ? 0.0F : kNoHand);
                    best = joints.cost < best.cost ? joints : best;
                }
            }
        }
        return best;
    }

    /// Whether the way goes on more level than down: from an ankle.
    bool goes_level(int from, int to) const {
        const glm::vec3 step = shape_.place(to) - shape_.place(from);
        return std::hypot(step.x, step.z) > std::abs(step.y);
    }

    void map_leg(const std::vector<int>& way, Side side) {
        const float leg = shape_.reach(way.front());
        std::size_t foot = 2;
        while (foot + 1 < way.size() && shape_.reach(way[foot]) > 0.35F * leg &&
               !goes_level(way[foot], way[foot + 1])) {
            ++foot;
        }
        const LimbJoints joints = leg_joints(way, foot);
        set(on_side(Bone::left_upper_leg, side), way[joints.upper]);
        set(on_side(Bone::left_lower_leg, side), way[joints.lower]);
        set(on_side(Bone::left_foot, side), way[foot]);
        if (foot + 1 < way.size()) {
            set(on_side(Bone::left_toes, side), way[foot + 1]);
        }
    }

    /// Where fingers begin, as a place in the way; 0: nowhere.
    std::size_t fingers_of(const std::vector<int>& way) const {
        std::size_t hand = 0;
        for (std::size_t i = way.size(); i-- > 2;) {
            hand = shape_.children(way[i]).size() > 2 ? i : hand;
        }
        const auto length = [&](std::size_t i) {
            return glm::length(shape_.place(way[i + 1]) - shape_.place(way[i]));
        };
        // A joint in the palm that carries the fingers.
        return hand > 2 && length(hand - 1) < 0.25F * length(hand - 2) ? hand - 1 : hand;
    }

    void map_arm(const std::vector<int>& way, const std::vector<int>& other, Side side) {
        const LimbJoints joints = arm_joints(way, other, fingers_of(way));
        if (joints.lower >= way.size()) {
            return;
        }
        if (joints.upper > 0) {
            set(on_side(Bone::left_shoulder, side), way.front());
        }
        set(on_side(Bone::left_upper_arm, side), way[joints.upper]);
        set(on_side(Bone::left_lower_arm, side), way[joints.lower]);
        if (joints.last < way.size()) {
            set(on_side(Bone::left_hand, side), way[joints.last]);
        }
    }

    const JointShape& shape_;
    HumanoidMap map_;
};

glm::vec3 level(const glm::vec3& direction) { return {direction.x, 0.0F, direction.z}; }

glm::vec3 bone_place(const HumanoidMap& humanoid, std::span<const glm::vec3> places, Bone bone) {
    return places[static_cast<std::size_t>(humanoid.nodes[motion::index_of(bone)])];
}

bool is_mapped(const HumanoidMap& humanoid, Bone bone) {
    return humanoid.nodes[motion::index_of(bone)] >= 0;
}

}  // namespace

HumanoidMap map_by_shape(const Model& model,
                         std::span<const glm::vec3> places,
                         const NodeFlesh& flesh) {
    HumanoidMap map;
    // Skins first: where they hold a figure, other nodes only confuse.
    for (const bool takes_all : {false, true}) {
        const JointShape shape(
            model,
            places,
            flesh,
            takes_all ? std::vector<bool>(model.nodes.size(), true) : skin_joints(model, flesh));
        if (map.nodes[0] < 0 && shape.nodes().size() <= kMostShapeJoints) {
            map = ShapeMapper(shape).map();
        }
    }
    return map;
}

std::optional<glm::vec3> feet_direction(const Model& model,
                                        const HumanoidMap& humanoid,
                                        std::span<const glm::mat4> world) {
    const std::vector<glm::vec3> places = places_of(world);
    std::vector<glm::vec3> offsets;
    glm::vec3 sum(0.0F);
    for (const Side side : motion::kSides) {
        const Bone foot = on_side(Bone::left_foot, side);
        const Bone toes = on_side(Bone::left_toes, side);
        if (!is_mapped(humanoid, foot)) {
            return std::nullopt;
        }
        glm::vec3 forward(0.0F);
        if (is_mapped(humanoid, toes)) {
            forward = bone_place(humanoid, places, toes) - bone_place(humanoid, places, foot);
        } else {
            // The flesh about a rig's goal for a foot says nothing of how the leg stands.
            const Bone shin = on_side(Bone::left_lower_leg, side);
            const auto node = [&](Bone bone) { return humanoid.nodes[motion::index_of(bone)]; };
            if (is_mapped(humanoid, shin) && !is_below(model, node(foot), node(shin))) {
                return std::nullopt;
            }
            if (offsets.empty()) {
                offsets = mean_offsets(model, world);
            }
            forward = offsets[static_cast<std::size_t>(humanoid.nodes[motion::index_of(foot)])];
        }
        forward = level(forward);
        if (glm::length(forward) < 1.0e-4F) {
            return std::nullopt;
        }
        sum += glm::normalize(forward);
    }
    // Toes of a standing figure point apart by less than a right angle.
    return glm::length(sum) > 1.4F ? std::optional(glm::normalize(sum)) : std::nullopt;
}

glm::vec3 facing_of(const HumanoidMap& humanoid, std::span<const glm::vec3> places) {
    for (const Bone left : {Bone::left_upper_leg, Bone::left_upper_arm}) {
        if (!is_mapped(humanoid, left) || !is_mapped(humanoid, mirrored(left))) {
            continue;
        }
        const glm::vec3 across = level(bone_place(humanoid, places, left) -
                                       bone_place(humanoid, places, mirrored(left)));
        if (glm::length(across) > 1.0e-4F) {
            return glm::normalize(glm::cross(across, kUp));
        }
    }
    return {0.0F, 0.0F, 1.0F};
}

float trunk_lean(const HumanoidMap& humanoid, std::span<const glm::vec3> places) {
    const auto middle = [&](Bone left) {
        return (bone_place(humanoid, places, left) + bone_place(humanoid, places, mirrored(left))) *
               0.5F;
    };
    const glm::vec3 trunk = middle(Bone::left_upper_arm) - middle(Bone::left_upper_leg);
    const float length = glm::length(trunk);
    return length > 0.0F ? std::acos(std::clamp(trunk.y / length, -1.0F, 1.0F)) : 0.0F;
}

}  // namespace raks::render
