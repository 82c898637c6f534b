#include "motion/skeleton/body/bones_by_name.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "motion/skeleton/body/bone_words.hpp"

namespace raks::motion {
namespace {

/// A node whose name says that it may be a bone.
struct Candidate {
    int node = -1;
    int depth = 0;
    BoneWords words;
};

constexpr std::size_t kMostCandidates = 4096;  // richest known: 300 nodes in all
constexpr int kNoJoint = 50;  // doubt about a node that moves no skin though others do
constexpr int kRather = 10;   // a name with this doubt yields to one that is less precise

class NameMapper {
 public:
    NameMapper(std::span<const NamedNode> nodes, const ParentTree& tree)
        : nodes_(nodes), tree_(tree) {
        collect();
    }

    BonesByName map() {
        for (const Side side : kSides) {
            map_leg(side);
            map_arm(side);
        }
        map_trunk();
        for (const Side side : kSides) {
            map_fingers(side);
        }
        map_face();
        return map_;
    }

 private:
    void collect() {
        std::vector<std::vector<std::string>> names;
        for (const NamedNode& node : nodes_) {
            names.push_back(words_of_name(node.name));
        }
        const auto noise = shared_words(names);
        for (std::size_t i = 0; i < names.size(); ++i) {
            Candidate one{.node = static_cast<int>(i), .words = read_bone_words(names[i], noise)};
            if (one.words.part == BodyPart::none) {
                continue;
            }
            one.words.doubt += nodes_[i].is_joint ? 0 : kNoJoint;
            one.depth = tree_.depth(one.node);
            all_.push_back(one);
            if (all_.size() == kMostCandidates) {
                return;
            }
        }
    }

    /// All of a part, those that move nothing last, else the nearest to the root first.
    std::vector<Candidate> named(BodyPart part, std::optional<Side> side) const {
        std::vector<Candidate> found;
        for (const Candidate& one : all_) {
            if (one.words.part == part && one.words.side == side) {
                found.push_back(one);
            }
        }
        std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
            const bool moves = a.words.doubt < kNoJoint;
            return moves != (b.words.doubt < kNoJoint) ? moves : a.depth < b.depth;
        });
        return found;
    }

    /// The one with the least doubt, nearest to the root; of several that are alike ("Palm1" to
    /// "Palm3") the middle one by name. -1: there is none.
    int best_of(const std::vector<Candidate>& found, int most_doubt = 1000) const {
        std::vector<Candidate> best;
        for (const Candidate& one : found) {
            const auto rank = std::pair(one.words.doubt, one.depth);
            if (one.words.doubt > most_doubt ||
                (!best.empty() && rank > std::pair(best[0].words.doubt, best[0].depth))) {
                continue;
            }
            if (!best.empty() && rank < std::pair(best[0].words.doubt, best[0].depth)) {
                best.clear();
            }
            best.push_back(one);
        }
        std::stable_sort(best.begin(), best.end(), [this](const Candidate& a, const Candidate& b) {
            return name_of(a.node) < name_of(b.node);
        });
        return best.empty() ? -1 : best[(best.size() - 1) / 2].node;
    }

    int best(BodyPart part, std::optional<Side> side, int most_doubt = 1000) const {
        return best_of(named(part, side), most_doubt);
    }

    /// The same, below `above` where one of them is.
    int best_below(BodyPart part, std::optional<Side> side, int above) const {
        std::vector<Candidate> found = named(part, side);
        if (above >= 0) {
            std::vector<Candidate> below;
            for (const Candidate& one : found) {
                if (tree_.is_below(one.node, above)) {
                    below.push_back(one);
                }
            }
            if (!below.empty()) {
                found = std::move(below);
            }
        }
        return best_of(found);
    }

    /// The last of a part's nodes that hang on each other, from `first` down.
    int last_below(BodyPart part, Side side, int first) const {
        int last = first;
        for (const Candidate& one : named(part, side)) {
            last = last >= 0 && one.words.doubt < kRather && tree_.is_below(one.node, last)
                       ? one.node
                       : last;
        }
        return last;
    }

    int node(Bone bone) const { return map_.nodes[index_of(bone)]; }

    void set(Bone bone, int node) {
        const bool is_taken =
            std::find(map_.nodes.begin(), map_.nodes.end(), node) != map_.nodes.end();
        if (node >= 0 && !is_taken) {
            map_.nodes[index_of(bone)] = node;
        }
    }

    /// "arm" or "leg" by order along the limb: what no word says better.
    struct Limb {
        int upper = -1;
        int lower = -1;
        int end = -1;  // hand, foot
        int tip = -1;  // toes
    };
    Limb limb(int upper, int rather_upper, int lower, std::vector<Candidate> plain) const {
        std::size_t next = 0;
        const auto take = [&](int below) {
            while (next < plain.size() && below >= 0 && !tree_.is_below(plain[next].node, below)) {
                ++next;
            }
            return next < plain.size() ? plain[next++].node : -1;
        };
        Limb limb{.upper = upper, .lower = lower};
        if (limb.upper < 0 && (limb.lower >= 0 || plain.size() > 1)) {
            limb.upper = take(-1);
        }
        if (limb.upper < 0) {
            limb.upper = rather_upper >= 0 ? rather_upper : take(-1);
        }
        if (limb.lower < 0) {
            limb.lower = take(limb.upper);
        }
        limb.end = take(limb.lower);
        limb.tip = take(limb.end);
        return limb;
    }

    void map_leg(Side side) {
        const int upper = best(BodyPart::upper_leg, side, kRather - 1);
        const Limb found = limb(upper,
                                best(BodyPart::upper_leg, side),
                                best_lower(BodyPart::lower_leg, side, upper),
                                named(BodyPart::leg, side));
        const std::vector<Candidate> feet = named(BodyPart::foot, side);
        int foot = best_below(BodyPart::foot, side, found.lower);
        int toes = best_below(BodyPart::toes, side, foot);
        if (foot < 0) {
            foot = found.end;
            toes = toes >= 0 ? toes : found.tip;
        } else if (toes < 0) {
            for (const Candidate& one : feet) {  // "foot 01", "foot 02"
                const bool is_sure = one.words.doubt < kRather;
                toes = toes < 0 && is_sure && tree_.is_below(one.node, foot) ? one.node : toes;
            }
        }
        set(on_side(Bone::left_upper_leg, side), found.upper);
        set(on_side(Bone::left_lower_leg, side), found.lower);
        set(on_side(Bone::left_foot, side), foot);
        set(on_side(Bone::left_toes, side), toes);
    }

    /// The best of a limb's lower bones: one that hangs on the upper one where that is known. The
    /// target of a pole vector, "elbow.R", hangs elsewhere.
    int best_lower(BodyPart part, Side side, int upper) const {
        std::vector<Candidate> found = named(part, side);
        std::erase_if(found, [&](const Candidate& one) {
            return upper >= 0 && !tree_.is_below(one.node, upper);
        });
        return best_of(found);
    }

    void map_arm(Side side) {
        int shoulder = best(BodyPart::shoulder, side);
        const int collar_bone = best(BodyPart::collar_bone, side);
        std::vector<Candidate> plain = named(BodyPart::arm, side);
        // What a hand carries is no part of its arm: a weapon has such a name in some languages.
        std::erase_if(plain, [&](const Candidate& one) { return is_carried(one.node, side); });
        int upper = best(BodyPart::upper_arm, side);
        if (upper < 0 && plain.empty()) {  // shoulder, elbow, wrist; or collar, shoulder, ...
            upper = last_below(BodyPart::shoulder, side, shoulder);
            shoulder = upper == shoulder ? -1 : shoulder;
        }
        shoulder = collar_bone >= 0 ? collar_bone : shoulder;
        Limb found = limb(upper, -1, best_lower(BodyPart::lower_arm, side, upper), plain);
        int hand = best_below(BodyPart::hand, side, found.lower);
        // An arm of two joints: the one that is called the hand turns the forearm with it.
        if (found.upper >= 0 && found.lower < 0 && hand >= 0 && tree_.is_below(hand, found.upper) &&
            tree_.depth(hand) == tree_.depth(found.upper) + 1) {
            found.lower = std::exchange(hand, -1);
        }
        if (shoulder >= 0 && found.upper >= 0 && tree_.is_below(found.upper, shoulder)) {
            set(on_side(Bone::left_shoulder, side), shoulder);
        }
        set(on_side(Bone::left_upper_arm, side), found.upper);
        set(on_side(Bone::left_lower_arm, side), found.lower);
        set(on_side(Bone::left_hand, side), hand >= 0 ? hand : found.end);
    }

    /// Whether a node hangs on a hand.
    bool is_carried(int node, Side side) const {
        const std::vector<Candidate> hands = named(BodyPart::hand, side);
        return std::any_of(hands.begin(), hands.end(), [&](const Candidate& hand) {
            return hand.words.doubt < kRather && tree_.is_below(node, hand.node);
        });
    }

    bool carries(int node, int other) const {
        return other < 0 || node == other || tree_.is_below(other, node);
    }

    void map_trunk() {
        const int arms = tree_.carrier_of(node(Bone::left_upper_arm), node(Bone::right_upper_arm));
        const int legs = tree_.carrier_of(node(Bone::left_upper_leg), node(Bone::right_upper_leg));
        int hips = best(BodyPart::hips, {});
        const bool is_named = hips >= 0 && carries(hips, legs) && carries(hips, arms);
        if (!is_named) {
            const int carrier = tree_.carrier_of(legs, arms);
            hips = carrier >= 0 ? carrier : (hips >= 0 ? hips : best(BodyPart::root, {}));
        }
        set(Bone::hips, hips);
        map_.are_hips_by_tree = !is_named;
        map_spine(arms);
        map_head(arms);
    }

    /// The trunk from hips to what carries the arms: named nodes of it, from below.
    std::vector<Candidate> trunk_below(int arms) const {
        std::vector<Candidate> trunk;
        for (const BodyPart part : {BodyPart::spine, BodyPart::chest, BodyPart::upper_chest}) {
            for (const Candidate& one : named(part, {})) {
                const int hips = node(Bone::hips);
                if (one.node != hips && carries(one.node, arms) &&
                    (hips < 0 || tree_.is_below(one.node, hips))) {
                    trunk.push_back(one);
                }
            }
        }
        std::stable_sort(trunk.begin(), trunk.end(), [](const Candidate& a, const Candidate& b) {
            return a.depth < b.depth;
        });
        return trunk;
    }

    void map_spine(int arms) {
        const std::vector<Candidate> trunk = trunk_below(arms);
        if (trunk.empty()) {
            return;
        }
        std::size_t chest = trunk.size() < 3 ? 1 : (trunk.size() == 3 ? 1 : trunk.size() / 2);
        for (std::size_t i = trunk.size(); i-- > 1;) {
            chest = trunk[i].words.part == BodyPart::chest ? i : chest;
        }
        set(Bone::spine, trunk.front().node);
        if (chest < trunk.size()) {
            set(Bone::chest, trunk[chest].node);
        }
        if (chest + 1 < trunk.size()) {
            set(Bone::upper_chest, trunk.back().node);
        }
    }

    void map_head(int arms) {
        std::vector<Candidate> necks = named(BodyPart::neck, {});
        int head = best(BodyPart::head, {});
        if (head < 0 && necks.size() > 1) {  // "neck 1", "neck 2"
            head = necks.back().node;
            necks.pop_back();
        }
        if (head < 0) {  // all of the spine is "spine"
            std::vector<Candidate> above;
            for (const Candidate& one : named(BodyPart::spine, {})) {
                if (arms >= 0 && tree_.is_below(one.node, arms)) {
                    above.push_back(one);
                }
            }
            head = above.empty() ? -1 : above.back().node;
            if (above.size() > 1) {
                necks = {above.front()};
            }
        }
        set(Bone::neck, best_of(necks));
        set(Bone::head, head);
    }

    void map_fingers(Side side) {
        constexpr std::array<BodyPart, 5> kParts = {
            BodyPart::thumb, BodyPart::index, BodyPart::middle, BodyPart::ring, BodyPart::little};
        const std::vector<Candidate> numbered = named(BodyPart::finger, side);
        int first = 1;  // Biped counts from 0, MakeHuman from 1
        for (const Candidate& one : numbered) {
            first = one.words.finger == 0 ? 0 : first;
        }
        for (std::size_t finger = 0; finger < kParts.size(); ++finger) {
            std::vector<Candidate> found = named(kParts[finger], side);
            for (const Candidate& one : numbered) {
                if (one.words.finger == first + static_cast<int>(finger)) {
                    found.push_back(one);
                }
            }
            map_finger(side, finger, found);
        }
    }

    /// Fingers hang on the hand or, with it, on the forearm; what carries the arm is no thumb.
    bool is_of_hand(int joint, Side side) const {
        const int hand = node(on_side(Bone::left_hand, side));
        const int forearm = node(on_side(Bone::left_lower_arm, side));
        return (hand < 0 && forearm < 0) || (hand >= 0 && tree_.is_below(joint, hand)) ||
               (forearm >= 0 && tree_.is_below(joint, forearm));
    }

    void map_finger(Side side, std::size_t finger, const std::vector<Candidate>& found) {
        std::vector<int> joints;
        for (const Candidate& one : found) {
            const bool counts =
                (finger == 0 || !one.words.is_metacarpal) && is_of_hand(one.node, side);
            if (counts && one.words.doubt < kRather && joints.size() < 3 &&
                (joints.empty() || tree_.is_below(one.node, joints.back()))) {
                joints.push_back(one.node);
            }
        }
        // Of a thumb with less than three joints the metacarpal is what is not there.
        const std::size_t skipped = finger == 0 && joints.size() < 3 ? 1 : 0;
        const auto base = index_of(on_side(Bone::left_thumb_metacarpal, side)) + 3 * finger;
        for (std::size_t j = 0; j < joints.size(); ++j) {
            set(static_cast<Bone>(base + j + skipped), joints[j]);
        }
    }

    void map_face() {
        map_.left_eye = best(BodyPart::eye, Side::left, kRather - 1);
        map_.right_eye = best(BodyPart::eye, Side::right, kRather - 1);
        map_.jaw = best(BodyPart::jaw, {}, kRather - 1);
    }

    std::string_view name_of(int node) const { return nodes_[static_cast<std::size_t>(node)].name; }

    std::span<const NamedNode> nodes_;
    const ParentTree& tree_;
    std::vector<Candidate> all_;
    BonesByName map_;
};

}  // namespace

BonesByName bones_by_name(std::span<const NamedNode> nodes, const ParentTree& tree) {
    return NameMapper(nodes, tree).map();
}

}  // namespace raks::motion
