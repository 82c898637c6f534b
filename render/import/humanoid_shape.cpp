#include "render/import/humanoid_shape.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/import/bind_places.hpp"
#include "render/import/node_tree.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

using motion::Bone;
using motion::Side;

constexpr float kAlike = 0.15F;  // two limbs differ by less of their length
// What it costs to look has a bound: no figure has more joints, or limbs at one joint.
constexpr std::size_t kMostShapeJoints = 2000;
constexpr std::size_t kMostBranches = 32;
constexpr glm::vec3 kUp{0.0F, 1.0F, 0.0F};

/// Which nodes are joints of a skin.
std::vector<bool> skin_joints(const Model& model) {
    std::vector<bool> joints(model.nodes.size(), false);
    for (const ModelSkin& skin : model.skins) {
        for (const int joint : skin.joints) {
            joints[static_cast<std::size_t>(joint)] = true;
        }
    }
    return joints;
}

/// The tree of those nodes that count, with what is asked of it.
class JointShape {
 public:
    JointShape(const Model& model,
               std::span<const glm::vec3> places,
               const std::vector<bool>& counts)
        : places_(places),
          children_(model.nodes.size()),
          reach_(model.nodes.size(), 0.0F),
          tops_(model.nodes.size(), 0.0F) {
        for (std::size_t i = 0; i < model.nodes.size(); ++i) {
            if (!counts[i]) {
                continue;
            }
            int parent = model.nodes[i].parent;
            while (parent >= 0 && !counts[static_cast<std::size_t>(parent)]) {
                parent = node_of(model, parent).parent;
            }
            nodes_.push_back(static_cast<int>(i));
            if (parent >= 0) {
                children_[static_cast<std::size_t>(parent)].push_back(static_cast<int>(i));
            } else {
                roots_.push_back(static_cast<int>(i));
            }
        }
        measure();
    }

    [[nodiscard]] const std::vector<int>& nodes() const { return nodes_; }
    [[nodiscard]] const std::vector<int>& children(int node) const {
        return children_[static_cast<std::size_t>(node)];
    }
    [[nodiscard]] glm::vec3 place(int node) const {
        return places_[static_cast<std::size_t>(node)];
    }
    [[nodiscard]] float lowest() const { return lowest_; }
    [[nodiscard]] float height() const { return highest_ - lowest_; }

    /// The longest way from a node to a leaf, the node first.
    [[nodiscard]] std::vector<int> longest_way(int node) const {
        std::vector<int> way = {node};
        while (!children(way.back()).empty()) {
            const std::vector<int>& next = children(way.back());
            way.push_back(*std::max_element(next.begin(), next.end(), [&](int a, int b) {
                return length_to(way.back(), a) < length_to(way.back(), b);
            }));
        }
        return way;
    }

    /// Length of the longest way from a node to a leaf, metres of the file.
    [[nodiscard]] float reach(int node) const { return reach_[static_cast<std::size_t>(node)]; }

    /// Highest place at and below a node.
    [[nodiscard]] float top(int node) const { return tops_[static_cast<std::size_t>(node)]; }

 private:
    [[nodiscard]] float length_to(int from, int child) const {
        return glm::length(place(child) - place(from)) + reach(child);
    }

    void measure() {
        std::vector<int> order = roots_;
        for (std::size_t next = 0; next < order.size(); ++next) {
            order.insert(order.end(), children(order[next]).begin(), children(order[next]).end());
        }
        for (auto node = order.rbegin(); node != order.rend(); ++node) {
            const auto at = static_cast<std::size_t>(*node);
            tops_[at] = place(*node).y;
            for (const int child : children(*node)) {
                reach_[at] = std::max(reach_[at], length_to(*node, child));
                tops_[at] = std::max(tops_[at], top(child));
            }
        }
        for (const int node : nodes_) {
            lowest_ = std::min(lowest_, place(node).y);
            highest_ = std::max(highest_, place(node).y);
        }
    }

    std::span<const glm::vec3> places_;
    std::vector<int> nodes_;
    std::vector<int> roots_;
    std::vector<std::vector<int>> children_;
    std::vector<float> reach_;  // by node
    std::vector<float> tops_;   // by node
    float lowest_ = INFINITY;
    float highest_ = -INFINITY;
};

/// Two limbs of a figure, left at +x.
struct LimbPair {
    std::vector<int> left;
    std::vector<int> right;
};

/// The two limbs that begin at children of `node`, are alike and at least three joints long, and
/// of which `is_fit` approves. Empty: there are none.
template <typename Fit>
LimbPair alike_limbs(const JointShape& shape, int node, const Fit& is_fit) {
    LimbPair best;
    float least = kAlike;
    const std::vector<int>& children = shape.children(node);
    for (std::size_t i = 0; i < children.size() && i < kMostBranches; ++i) {
        for (std::size_t j = i + 1; j < children.size() && j < kMostBranches; ++j) {
            const float longer = std::max(shape.reach(children[i]), shape.reach(children[j]));
            const float difference =
                std::abs(shape.reach(children[i]) - shape.reach(children[j])) / longer;
            if (!(difference < least)) {
                continue;
            }
            const std::vector<int> a = shape.longest_way(children[i]);
            const std::vector<int> b = shape.longest_way(children[j]);
            if (a.size() < 3 || b.size() < 3 || !is_fit(a) || !is_fit(b)) {
                continue;
            }
            least = difference;
            const bool is_left = shape.place(a.back()).x >= shape.place(b.back()).x;
            best = is_left ? LimbPair{a, b} : LimbPair{b, a};
        }
    }
    return best;
}

class ShapeMapper {
 public:
    explicit ShapeMapper(const JointShape& shape) : shape_(shape) {}

    HumanoidMap map() {
        for (const int node : shape_.nodes()) {
            const LimbPair legs = alike_limbs(shape_, node, [this](const std::vector<int>& way) {
                const float end = shape_.place(way.back()).y - shape_.lowest();
                return end < 0.15F * shape_.height() &&
                       shape_.reach(way.front()) > 0.25F * shape_.height();
            });
            if (!legs.left.empty() && map_trunk(node, legs)) {
                map_leg(legs.left, Side::left);
                map_leg(legs.right, Side::right);
                return map_;
            }
            map_ = HumanoidMap();
        }
        return {};
    }

 private:
    void set(Bone bone, int node) {
        map_.nodes[motion::index_of(bone)] = node;
        map_.reasons[motion::index_of(bone)] = BoneReason::shape;
    }

    /// The child that leads highest, but for `others`; -1: none leads above `from`.
    int way_up(int from, const LimbPair& others) const {
        int best = -1;
        float highest = shape_.place(from).y;
        for (const int child : shape_.children(from)) {
            const bool is_other = (!others.left.empty() && child == others.left.front()) ||
                                  (!others.right.empty() && child == others.right.front());
            if (!is_other && shape_.top(child) > highest) {
                highest = shape_.top(child);
                best = child;
            }
        }
        return best;
    }

    /// From the hips up to the arms; false: there is no trunk with arms.
    bool map_trunk(int hips, const LimbPair& legs) {
        std::vector<int> trunk;
        LimbPair arms;
        for (int node = way_up(hips, legs); node >= 0 && arms.left.empty();
             node = way_up(node, arms)) {
            trunk.push_back(node);
            arms = alike_limbs(shape_, node, [this](const std::vector<int>& way) {
                return shape_.reach(way.front()) > 0.2F * shape_.height();
            });
            if (!arms.left.empty()) {
                break;
            }
        }
        const int head = arms.left.empty() ? -1 : way_up(trunk.back(), arms);
        if (head < 0) {
            return false;
        }
        set(Bone::hips, hips);
        set(Bone::spine, trunk.front());
        if (trunk.size() > 1) {
            set(Bone::chest, trunk[trunk.size() / 2]);
        }
        if (trunk.size() > 2) {
            set(Bone::upper_chest, trunk.back());
        }
        map_head(head);
        map_arm(arms.left, Side::left);
        map_arm(arms.right, Side::right);
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

    /// The joint of `way` between two others that is nearest to the middle of the way.
    std::size_t middle_of(const std::vector<int>& way, std::size_t from, std::size_t to) const {
        const glm::vec3 middle = (shape_.place(way[from]) + shape_.place(way[to])) * 0.5F;
        std::size_t best = from + 1;
        for (std::size_t i = from + 1; i < to; ++i) {
            if (glm::length(shape_.place(way[i]) - middle) <
                glm::length(shape_.place(way[best]) - middle)) {
                best = i;
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
        set(on_side(Bone::left_upper_leg, side), way.front());
        set(on_side(Bone::left_lower_leg, side), way[middle_of(way, 0, foot)]);
        set(on_side(Bone::left_foot, side), way[foot]);
        if (foot + 1 < way.size()) {
            set(on_side(Bone::left_toes, side), way[foot + 1]);
        }
    }

    void map_arm(const std::vector<int>& way, Side side) {
        std::size_t hand = way.size() - 1;
        for (std::size_t i = way.size(); i-- > 2;) {
            hand = shape_.children(way[i]).size() > 2 ? i : hand;  // where fingers begin
        }
        const auto length = [&](std::size_t i) {
            return glm::length(shape_.place(way[i + 1]) - shape_.place(way[i]));
        };
        if (hand > 2 && length(hand - 1) < 0.25F * length(hand - 2)) {
            --hand;  // a joint in the palm that carries the fingers
        }
        const std::size_t upper = hand > 2 && length(0) < 0.8F * length(1) ? 1 : 0;
        if (hand == way.size() - 1 && hand > upper + 2) {
            hand = upper + 2;  // no fingers that would tell: what follows is the tip
        }
        if (upper > 0) {
            set(on_side(Bone::left_shoulder, side), way.front());
        }
        set(on_side(Bone::left_upper_arm, side), way[upper]);
        set(on_side(Bone::left_lower_arm, side), way[middle_of(way, upper, hand)]);
        set(on_side(Bone::left_hand, side), way[hand]);
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

HumanoidMap map_by_shape(const Model& model, std::span<const glm::vec3> places) {
    HumanoidMap map;
    // Skins first: where they hold a figure, other nodes only confuse.
    for (const bool takes_all : {false, true}) {
        const JointShape shape(
            model,
            places,
            takes_all ? std::vector<bool>(model.nodes.size(), true) : skin_joints(model));
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
