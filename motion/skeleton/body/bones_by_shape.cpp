#include "motion/skeleton/body/bones_by_shape.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kAlike = 0.12;         // two limbs differ by less of the longer one
constexpr double kShortestLimb = 0.15;  // of the way between the two farthest ends
// What it costs to look has a bound: no body has more limbs at one joint, or joints in its trunk.
constexpr std::size_t kMostBranches = 24;
constexpr std::size_t kMostPairs = 48;
constexpr int kLongestTrunk = 32;
constexpr double kHead = 0.3;  // what a head counts of a body's score

/// Two limbs that begin at one joint.
struct LimbPair {
    int hub = -1;
    int a = -1;  // first joints
    int b = -1;
    double reach = 0.0;  // of the shorter one, with its first bone
};

/// Upper, lower and last joint of a limb, and the way to them.
struct Limb {
    std::vector<int> way;  // from the first joint below the hub
    std::size_t upper = 0;
    std::size_t lower = 0;
    std::size_t last = 0;
    double cost = 1e9;
};

struct BodyPlan {
    LimbPair legs;
    LimbPair arms;
    int hips = -1;
    double score = -1e9;
};

class ShapeSearch {
 public:
    explicit ShapeSearch(const PosedSkeleton& skeleton) : body_(skeleton), tree_(skeleton.tree()) {
        find_pairs();
    }

    /// The best body none of whose joints lies in `taken`'s.
    BodyPlan best_plan(const std::optional<BodyPlan>& taken) const {
        BodyPlan best;
        for (const LimbPair& legs : pairs_) {
            for (const LimbPair& arms : pairs_) {
                BodyPlan plan = plan_of(legs, arms);
                if (plan.hips < 0 || plan.score + kHead <= best.score ||
                    (taken && overlaps(plan, *taken))) {
                    continue;
                }
                plan.score += head_of(plan) >= 0 ? kHead : 0.0;
                if (plan.score > best.score) {
                    best = plan;
                }
            }
        }
        return best;
    }

    BonesByShape bones_of(const BodyPlan& plan) const {
        BonesByShape bones;
        set(bones, Bone::hips, plan.hips);
        const double legs = place_legs(bones, plan.legs);
        const double arms = place_arms(bones, plan.arms);
        place_head(bones, plan);
        // The sum of both costs is about 1.5 for bodies, 3 for odd ones, more for guesses.
        bones.fit = std::clamp(1.4 - 0.3 * (legs + arms), 0.05, 1.0);
        return bones;
    }

    BonesByShape legs_alone() const {
        BonesByShape bones;
        const auto longest = std::max_element(
            pairs_.begin(), pairs_.end(), [](const LimbPair& a, const LimbPair& b) {
                return a.reach < b.reach;
            });
        if (longest != pairs_.end()) {
            set(bones, Bone::hips, longest->hub);
            bones.fit = std::clamp(1.4 - 0.6 * place_legs(bones, *longest), 0.05, 1.0);
        }
        return bones;
    }

 private:
    static void set(BonesByShape& bones, Bone bone, int joint) {
        bones.joints[index_of(bone)] = joint;
    }

    void find_pairs() {
        for (const int hub : tree_.order()) {
            const std::vector<int>& children = tree_.children(hub);
            const std::size_t count = std::min(children.size(), kMostBranches);
            for (std::size_t i = 0; i < count; ++i) {
                for (std::size_t j = i + 1; j < count; ++j) {
                    add_pair(hub, children[i], children[j]);
                }
            }
        }
        std::stable_sort(pairs_.begin(), pairs_.end(), [](const LimbPair& a, const LimbPair& b) {
            return a.reach > b.reach;
        });
        if (pairs_.size() > kMostPairs) {
            pairs_.resize(kMostPairs);
        }
    }

    void add_pair(int hub, int a, int b) {
        // The first bones are left out: the legs' may be of any length where the hub lies high.
        const double longer = std::max(body_.reach(a), body_.reach(b));
        const double shorter = std::min(body_.reach(a), body_.reach(b));
        const bool is_alike = longer - shorter < kAlike * longer &&
                              std::abs(body_.length(a) - body_.length(b)) < kAlike * longer;
        if (is_alike && shorter > kShortestLimb * body_.size() && body_.longest_way(a).size() > 2 &&
            body_.longest_way(b).size() > 2) {
            pairs_.push_back({hub, a, b, shorter});
        }
    }

    bool is_in(int joint, const LimbPair& pair) const {
        return joint == pair.a || joint == pair.b || tree_.is_below(joint, pair.a) ||
               tree_.is_below(joint, pair.b);
    }

    BodyPlan plan_of(const LimbPair& legs, const LimbPair& arms) const {
        BodyPlan plan{.legs = legs, .arms = arms};
        const bool shares = legs.a == arms.a || legs.a == arms.b || legs.b == arms.a ||
                            legs.b == arms.b || is_in(legs.hub, arms) || is_in(arms.hub, legs);
        if (shares) {
            return plan;
        }
        const int hips = tree_.carrier_of(legs.hub, arms.hub);
        if (hips < 0) {
            return plan;
        }
        const double below = body_.way_up(legs.hub, hips);
        const double trunk = body_.way_up(arms.hub, hips);
        if (hips == arms.hub || !(trunk > below)) {
            return plan;
        }
        plan.hips = hips;
        const double size = body_.size();
        plan.score = (legs.reach + arms.reach) / size - (trunk + 2.0 * below) / size;
        return plan;
    }

    bool overlaps(const BodyPlan& plan, const BodyPlan& other) const {
        return plan.hips == other.hips || tree_.is_below(plan.hips, other.hips) ||
               tree_.is_below(other.hips, plan.hips);
    }

    /// The first joint of the way to the head: on the arms' hub, or between it and the hips, that
    /// leads farthest away from the hips. -1: none does.
    int head_of(const BodyPlan& plan) const {
        int from = plan.arms.hub;
        for (int step = 0; step < kLongestTrunk && from >= 0 && from != plan.hips; ++step) {
            if (const int head = head_at(plan, from); head >= 0) {
                return head;
            }
            from = tree_.parent(from);
        }
        return -1;
    }

    int head_at(const BodyPlan& plan, int from) const {
        const std::vector<int>& children = tree_.children(from);
        const std::size_t count = std::min(children.size(), kMostBranches);
        int best = -1;
        double farthest = body_.distance(from, plan.hips);
        for (std::size_t i = 0; i < count; ++i) {
            const int child = children[i];
            const bool is_trunk = child == plan.arms.hub || tree_.is_below(plan.arms.hub, child);
            if (is_trunk || is_in(child, plan.arms)) {
                continue;
            }
            const double away = std::max(body_.distance(body_.longest_way(child).back(), plan.hips),
                                         body_.distance(child, plan.hips));
            if (away >= farthest) {
                farthest = away;
                best = child;
            }
        }
        return best;
    }

    /// How badly three joints of a way are upper, lower and last joint of a limb: about 0.5 for
    /// those that are.
    double cost_of(const std::vector<int>& way,
                   std::size_t upper,
                   std::size_t lower,
                   std::size_t last,
                   double usual_ratio) const {
        const double first = body_.distance(way[upper], way[lower]);
        const double second = body_.distance(way[lower], way[last]);
        const double all = body_.reach(way.front());
        if (!(first > 0.0) || !(second > 0.0) || !(all > 0.0)) {
            return 1e9;
        }
        constexpr double kRatioSpread = 0.4;  // of the logarithm of the two bones' ratio
        constexpr double kRigid = 0.01;       // bones of a clip are rigid but for rounding
        constexpr double kMostLoose = 4.0;
        const double ratio = std::log(first / second / usual_ratio) / kRatioSpread;
        const double loose = std::min(
            kMostLoose,
            (body_.looseness(way[upper], way[lower]) + body_.looseness(way[lower], way[last])) /
                kRigid);
        const double covered = (first + second) / all;
        // A collar bone or a socket turns by far less than the limb below it.
        constexpr double kSocket = 0.25;
        const bool is_socket = body_.turning(way[upper]) < kSocket * body_.turning(way[lower]);
        return 0.5 * ratio * ratio + loose + 3.0 * std::max(0.0, 1.0 - covered) +
               (is_socket ? 1.0 : 0.0);
    }

    Limb limb_of(int first, double usual_ratio) const {
        Limb limb{.way = body_.longest_way(first)};
        const std::size_t count = limb.way.size();
        for (std::size_t upper = 0; upper + 2 < count; ++upper) {
            for (std::size_t lower = upper + 1; lower + 1 < count; ++lower) {
                for (std::size_t last = lower + 1; last < count; ++last) {
                    const double cost = cost_of(limb.way, upper, lower, last, usual_ratio);
                    // Of joints at one place the lower one turns the bone.
                    if (cost < limb.cost - 1e-9 ||
                        (cost <= limb.cost + 1e-9 && lower > limb.lower)) {
                        limb.upper = upper;
                        limb.lower = lower;
                        limb.last = last;
                        limb.cost = cost;
                    }
                }
            }
        }
        return limb;
    }

    double place_legs(BonesByShape& bones, const LimbPair& pair) const {
        double cost = 0.0;
        for (const Side side : kSides) {
            const Limb leg = limb_of(side == Side::left ? pair.a : pair.b, 1.05);
            set(bones, on_side(Bone::left_upper_leg, side), leg.way[leg.upper]);
            set(bones, on_side(Bone::left_lower_leg, side), leg.way[leg.lower]);
            set(bones, on_side(Bone::left_foot, side), leg.way[leg.last]);
            if (leg.last + 1 < leg.way.size() && !is_end(leg.way[leg.last + 1])) {
                set(bones, on_side(Bone::left_toes, side), leg.way[leg.last + 1]);
            }
            cost = std::max(cost, leg.cost);
        }
        return cost;
    }

    double place_arms(BonesByShape& bones, const LimbPair& pair) const {
        double cost = 0.0;
        for (const Side side : kSides) {
            const Limb arm = limb_of(side == Side::left ? pair.a : pair.b, 1.1);
            set(bones, on_side(Bone::left_upper_arm, side), arm.way[arm.upper]);
            set(bones, on_side(Bone::left_lower_arm, side), arm.way[arm.lower]);
            set(bones, on_side(Bone::left_hand, side), arm.way[arm.last]);
            if (arm.upper > 0) {
                set(bones, on_side(Bone::left_shoulder, side), arm.way.front());
            }
            cost = std::max(cost, arm.cost);
        }
        return cost;
    }

    /// A joint that ends a way and has nothing to turn.
    bool is_end(int joint) const {
        return tree_.children(joint).empty() && !(body_.reach(joint) > 0.0) && !body_.turns(joint);
    }

    /// A joint that never turns, though the one above it does: a part of the head, no joint of it.
    bool is_stiffer(int joint) const {
        return !body_.turns(joint) && body_.turns(tree_.parent(joint));
    }

    /// The head is where the way parts (eyes, jaw, hair), else its last joint that turns something.
    void place_head(BonesByShape& bones, const BodyPlan& plan) const {
        const int first = head_of(plan);
        if (first < 0) {
            return;
        }
        std::vector<int> way = {first};
        while (way.size() < PosedSkeleton::kLongestWay && tree_.children(way.back()).size() == 1) {
            way.push_back(tree_.children(way.back()).front());
        }
        while (way.size() > 2 && (is_end(way.back()) || is_stiffer(way.back()))) {
            way.pop_back();
        }
        set(bones, Bone::head, way.back());
        if (way.size() > 1) {
            set(bones, Bone::neck, way.front());
        }
    }

    const PosedSkeleton& body_;
    const ParentTree& tree_;
    std::vector<LimbPair> pairs_;
};

}  // namespace

HumanoidMapping BonesByShape::mapping() const {
    HumanoidMapping mapping;
    for (std::size_t bone = 0; bone < joints.size(); ++bone) {
        if (joints[bone] >= 0) {
            mapping.joints[bone] = static_cast<std::size_t>(joints[bone]);
        }
    }
    return mapping;
}

std::vector<BonesByShape> bodies_by_shape(const PosedSkeleton& skeleton) {
    const ShapeSearch search(skeleton);
    const BodyPlan first = search.best_plan(std::nullopt);
    std::vector<BonesByShape> bodies;
    if (first.hips < 0) {
        return bodies;
    }
    bodies.push_back(search.bones_of(first));
    if (const BodyPlan second = search.best_plan(first); second.hips >= 0) {
        bodies.push_back(search.bones_of(second));
    }
    return bodies;
}

BonesByShape legs_by_shape(const PosedSkeleton& skeleton) {
    return ShapeSearch(skeleton).legs_alone();
}

}  // namespace raks::motion
