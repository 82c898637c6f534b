#include "motion/skeleton/body/joint_finder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "motion/skeleton/body/bones_by_name.hpp"
#include "motion/skeleton/body/bones_by_shape.hpp"
#include "motion/skeleton/body/fingers_by_shape.hpp"
#include "motion/skeleton/body/joint_report.hpp"
#include "motion/skeleton/body/labelled_joints.hpp"
#include "motion/skeleton/body/posed_skeleton.hpp"
#include "motion/skeleton/body/side_evidence.hpp"
#include "motion/skeleton/body/trunk_chain.hpp"

namespace raks::motion {
namespace {

// Confidence of a bone.
constexpr double kSaid = 1.0;        // by a person
constexpr double kBoth = 0.97;       // name and shape say the same
constexpr double kNamed = 0.9;       // the name alone
constexpr double kBestShape = 0.85;  // the shape alone, where it fits in all
constexpr double kBetween = 0.8;     // counted between joints that are sure
constexpr double kOneOfTwo = 0.7;    // the name says so, the shape something else
constexpr double kLegsAlone = 0.3;   // two equal limbs that may be legs

constexpr double kLeastFit = 0.3;    // a shape that fits less is none
constexpr double kSecondFit = 0.5;   // the same of a second body: a chair is no person
constexpr double kWrongSide = -0.4;  // evidence against the sides that names give
constexpr double kNoSide = 0.2;      // evidence that tells no side
constexpr double kClear = 0.5;       // one voice of it that leaves no doubt

bool is_sided(Bone bone) { return mirrored(bone) != bone; }

/// All bones, parents before their children.
std::vector<Bone> all_bones() {
    std::vector<Bone> bones;
    for (int bone = 0; bone < kBoneCount; ++bone) {
        bones.push_back(static_cast<Bone>(bone));
    }
    return bones;
}

/// Exchanges the bones from `first` to `last`, of the left side, with those of the right.
void swap_bones(FoundJoints& found, Bone first, Bone last) {
    for (std::size_t left = index_of(first); left <= index_of(last); ++left) {
        const std::size_t right = index_of(mirrored(static_cast<Bone>(left)));
        std::swap(found.mapping.joints[left], found.mapping.joints[right]);
        std::swap(found.reasons[left], found.reasons[right]);
        std::swap(found.confidence[left], found.confidence[right]);
    }
}

/// The search: each step adds to what the steps before it found.
class Finder {
 public:
    explicit Finder(const MotionClip& clip)
        : clip_(clip), body_(clip), tree_(body_.tree()), shapes_(bodies_by_shape(body_)) {}

    Expected<void> take_labels() {
        const Expected<HumanoidMapping> said = labelled_joints(clip_, tree_);
        if (!said) {
            return fail(said.error());
        }
        for (const Bone bone : all_bones()) {
            if (const auto joint = said->joint(bone)) {
                set(bone, static_cast<int>(*joint), "said by " + clip_.labels.source, kSaid);
            }
        }
        return {};
    }

    /// Takes the body that the clip's reader knows, but for what a person said otherwise.
    void take_known(const KnownBody& known) {
        for (const Bone bone : all_bones()) {
            const std::size_t at = index_of(bone);
            if (const auto joint = known.mapping.joint(bone)) {
                add(bone, static_cast<int>(*joint), known.reasons[at], known.confidence[at]);
            }
        }
    }

    void take_names() {
        std::vector<NamedNode> nodes;
        for (const ClipJoint& joint : clip_.joints) {
            nodes.push_back({.name = joint.name});
        }
        const BonesByName named = bones_by_name(nodes, tree_);
        for (const Bone bone : all_bones()) {
            const bool is_by_tree = bone == Bone::hips && named.are_hips_by_tree;
            has_names_ = has_names_ || (is_sided(bone) && named.nodes[index_of(bone)] >= 0);
            add(bone,
                named.nodes[index_of(bone)],
                is_by_tree ? "it carries legs and arms" : "by its name",
                is_by_tree ? kBetween : kNamed);
        }
    }

    /// Drops bones whose joint does not hang below the joint of the bone that carries them.
    void drop_upside_down() {
        for (const Bone bone : all_bones()) {
            const std::optional<Bone> parent = mapped_parent(found_.mapping, bone);
            if (!has(bone) || !parent || tree_.is_below(joint(bone), joint(*parent))) {
                continue;
            }
            found_.notes.push_back(fmt::format("\"{}\" is no {}: it does not hang on the {}",
                                               name_of(bone),
                                               kBoneNames[index_of(bone)],
                                               kBoneNames[index_of(*parent)]));
            drop(bone);
        }
    }

    /// Takes the bones that have no name from the shape. Bones that have both become surer where
    /// both agree.
    void take_shape() {
        if (shapes_.empty() || shapes_.front().fit < kLeastFit) {
            take_legs();
            return;
        }
        BonesByShape& shape = shapes_.front();
        drop_lies(shape);
        const bool is_side_sure = align_sides(shape);
        const double confidence = kBestShape * (is_side_sure ? 1.0 : 0.5) * (0.5 + 0.5 * shape.fit);
        for (const Bone bone : all_bones()) {
            if (shape.joint(bone) < 0 || is_said(bone)) {
                continue;
            }
            if (has(bone)) {
                const bool is_same = joint(bone) == shape.joint(bone);
                found_.confidence[index_of(bone)] = is_same ? kBoth : kOneOfTwo;
            } else {
                add(bone, shape.joint(bone), "by tree and motion", confidence);
            }
        }
        note_doubts(shape);
        if (!has_names_) {
            found_.notes.push_back(fmt::format(
                "names say nothing; joints are found by tree and motion (confidence {:.2f})",
                confidence));
        }
    }

    /// The trunk is counted in its chain, whatever its joints are called, so that one skeleton
    /// under two schemes of names bends alike.
    void spread_spine() {
        constexpr std::array kTrunk = {Bone::spine, Bone::chest, Bone::upper_chest};
        const std::vector<int> chain = trunk_chain(clip_, body_, found_.mapping);
        const bool is_any_said =
            std::any_of(kTrunk.begin(), kTrunk.end(), [this](Bone bone) { return is_said(bone); });
        if (chain.empty() || is_any_said) {
            return;
        }
        for (const Bone bone : kTrunk) {
            drop(bone);
        }
        const std::size_t count = chain.size();
        const auto place = [&](Bone bone, std::size_t at) {
            add(bone,
                chain[at],
                fmt::format("{} of {} between hips and arms", at + 1, count),
                kBetween);
        };
        place(Bone::spine, 0);
        if (count > 1) {
            place(Bone::chest, count < 4 ? 1 : count / 2);
        }
        if (count > 2) {
            place(Bone::upper_chest, count - 1);
        }
    }

    void find_fingers() { take_fingers(body_, found_); }

    /// A left that lies on the right is swapped, where nobody said which is which.
    void check_sides() {
        const std::vector<Bone> bones = all_bones();
        const bool is_side_said = std::any_of(bones.begin(), bones.end(), [this](Bone bone) {
            return is_sided(bone) && is_said(bone);
        });
        if (missing_joints(clip_, found_.mapping) || is_side_said) {
            return;
        }
        if (arms_beside_legs(body_, found_.mapping) < -0.5) {
            swap_bones(found_, Bone::left_shoulder, Bone::left_little_distal);
            found_.notes.emplace_back(
                "its left arm hangs on the side of its right leg; the arms are swapped");
        }
        const SideEvidence evidence = side_evidence(body_, found_.mapping);
        if (evidence.feet > kClear && evidence.knees < -kClear) {
            found_.notes.emplace_back(
                "its knees bend away from where its feet point: joints are wrongly called, or the "
                "file is wrongly converted");
        }
        if (has_names_ && evidence.verdict < kWrongSide) {
            swap_sides(found_);
            for (const Bone bone : bones) {
                if (is_sided(bone) && has(bone)) {
                    found_.reasons[index_of(bone)] += ", sides swapped";
                }
            }
            found_.notes.emplace_back(
                "its left lies on its right, as its feet point and its knees bend; left and right "
                "are swapped");
        }
    }

    JointSearch result() && {
        JointSearch search{.found = {}, .refusal = missing_joints(clip_, found_.mapping)};
        const bool is_second = shapes_.size() > 1 && shapes_[1].fit > kSecondFit;
        if (is_second && !is_said(Bone::hips) && !clip_.known) {
            // What was said of one of them, while joints of both were taken, helps nobody.
            found_.notes.clear();
            search.refusal =
                Error{fmt::format("two bodies in one clip, with hips \"{}\" and \"{}\": keep one",
                                  shape_hips(0),
                                  shape_hips(1))};
        } else if (!search.refusal && goes_on_four(body_, found_.mapping)) {
            search.refusal = Error{"it goes on four legs: no body that dances"};
        }
        search.found = std::move(found_);
        return search;
    }

 private:
    bool has(Bone bone) const { return found_.mapping.joint(bone).has_value(); }
    int joint(Bone bone) const { return static_cast<int>(*found_.mapping.joint(bone)); }
    bool is_said(Bone bone) const { return found_.confidence[index_of(bone)] == kSaid; }
    std::string name_of(Bone bone) const { return shown_joint(clip_, *found_.mapping.joint(bone)); }
    std::string shape_hips(std::size_t shape) const {
        return shown_joint(clip_, static_cast<std::size_t>(shapes_[shape].joint(Bone::hips)));
    }

    void set(Bone bone, int joint, std::string reason, double confidence) {
        found_.mapping.joints[index_of(bone)] = static_cast<std::size_t>(joint);
        found_.reasons[index_of(bone)] = std::move(reason);
        found_.confidence[index_of(bone)] = confidence;
    }
    /// The same for a bone that is not found yet, if its joint is free.
    void add(Bone bone, int joint, std::string reason, double confidence) {
        const auto& taken = found_.mapping.joints;
        if (joint >= 0 && !has(bone) &&
            std::find(taken.begin(), taken.end(), static_cast<std::size_t>(joint)) == taken.end()) {
            set(bone, joint, std::move(reason), confidence);
        }
    }
    void drop(Bone bone) {
        found_.mapping.joints[index_of(bone)].reset();
        found_.reasons[index_of(bone)].clear();
        found_.confidence[index_of(bone)] = 0.0;
    }

    /// Drops all names where more of them contradict the shape of the body than agree with it:
    /// where names of arms stand on the legs, and names of legs on the arms.
    void drop_lies(const BonesByShape& shape) {
        int fitting = 0;
        int lying = 0;
        for (const Bone bone : all_bones()) {
            if (!is_sided(bone) || !has(bone) || is_said(bone)) {
                continue;
            }
            const bool is_of_leg = std::min(bone, mirrored(bone)) <= Bone::left_toes;
            for (const Side side : kSides) {
                fitting +=
                    is_in(bone,
                          shape.joint(on_side(
                              is_of_leg ? Bone::left_upper_leg : Bone::left_upper_arm, side)));
                lying += is_in(bone,
                               shape.joint(on_side(
                                   is_of_leg ? Bone::left_upper_arm : Bone::left_upper_leg, side)));
            }
        }
        if (lying <= fitting) {
            return;
        }
        for (const Bone bone : all_bones()) {
            if (!is_said(bone)) {
                drop(bone);
            }
        }
        has_names_ = false;
        found_.notes.emplace_back("its names put arms where its legs are; they are not believed");
    }

    /// Says so where names and shape disagree about half of the limbs' bones.
    void note_doubts(const BonesByShape& shape) {
        constexpr int kMany = 6;  // of 12
        int doubts = 0;
        std::optional<Bone> first;
        for (const Bone left : {Bone::left_upper_leg,
                                Bone::left_lower_leg,
                                Bone::left_foot,
                                Bone::left_upper_arm,
                                Bone::left_lower_arm,
                                Bone::left_hand}) {
            for (const Side side : kSides) {
                const Bone bone = on_side(left, side);
                if (found_.confidence[index_of(bone)] == kOneOfTwo) {
                    ++doubts;
                    first = first.value_or(bone);
                }
            }
        }
        if (doubts >= kMany) {
            found_.notes.push_back(fmt::format(
                "names and lengths disagree about {} bones: {} is \"{}\" by name and \"{}\" by "
                "length; the names are believed",
                doubts,
                kBoneNames[index_of(*first)],
                name_of(*first),
                shown_joint(clip_, static_cast<std::size_t>(shape.joint(*first)))));
        }
    }

    /// Whether a bone's joint is a limb's first one or below it.
    int is_in(Bone bone, int limb) const {
        return joint(bone) == limb || tree_.is_below(joint(bone), limb) ? 1 : 0;
    }

    /// Where there is no whole body: two limbs that may be legs.
    void take_legs() {
        if (has_names_) {
            return;
        }
        const BonesByShape legs = legs_by_shape(body_);
        for (const Bone bone : all_bones()) {
            if (legs.fit >= kLeastFit) {
                add(bone, legs.joint(bone), "by its tree", kLegsAlone);
            }
        }
    }

    /// Turns a shape's sides to those that names or labels give, else to those that its motion
    /// shows. False, with a note: neither tells.
    bool align_sides(BonesByShape& shape) {
        const auto swap = [&](Bone first, Bone last) {
            for (std::size_t left = index_of(first); left <= index_of(last); ++left) {
                std::swap(shape.joints[left],
                          shape.joints[index_of(mirrored(static_cast<Bone>(left)))]);
            }
        };
        if (arms_beside_legs(body_, shape.mapping()) < 0.0) {
            swap(Bone::left_shoulder, Bone::left_hand);
        }
        const int agreement = agreement_with(shape);
        const double verdict = side_evidence(body_, shape.mapping()).verdict;
        const bool is_sure = agreement != 0 || std::abs(verdict) > kNoSide;
        bool is_turned = agreement != 0 ? agreement < 0 : verdict < 0.0;
        if (!is_sure) {
            const std::vector<glm::dvec3> rest = rest_positions(clip_);
            const auto x = [&](Bone bone) {
                return rest[static_cast<std::size_t>(shape.joint(bone))].x;
            };
            is_turned = x(Bone::left_upper_leg) < x(Bone::right_upper_leg);
            found_.notes.emplace_back(
                "which side is its left is not clear from feet and knees; +x of its rest pose is "
                "taken");
        }
        if (is_turned) {
            swap(Bone::left_upper_leg, Bone::left_little_distal);
        }
        return is_sure;
    }

    /// Joints that are found in limbs of the same side in a shape, less those of the other.
    int agreement_with(const BonesByShape& shape) const {
        int agreement = 0;
        for (const Bone bone : all_bones()) {
            for (const Bone limb : {Bone::left_upper_leg, Bone::left_upper_arm}) {
                for (const Side side : kSides) {
                    const int top = shape.joint(on_side(limb, side));
                    if (is_sided(bone) && has(bone) && is_in(bone, top) != 0) {
                        const bool is_left = bone < mirrored(bone);
                        agreement += is_left == (side == Side::left) ? 1 : -1;
                    }
                }
            }
        }
        return agreement;
    }

    const MotionClip& clip_;
    PosedSkeleton body_;
    const ParentTree& tree_;
    std::vector<BonesByShape> shapes_;  // the best first
    bool has_names_ = false;            // of any limb
    FoundJoints found_;
};

}  // namespace

Expected<JointSearch> search_joints(const MotionClip& clip) {
    Finder finder(clip);
    if (const Expected<void> taken = finder.take_labels(); !taken) {
        return fail(taken.error());
    }
    if (clip.known) {
        finder.take_known(*clip.known);
        return std::move(finder).result();
    }
    finder.take_names();
    finder.drop_upside_down();
    finder.take_shape();
    finder.drop_upside_down();
    finder.spread_spine();
    finder.find_fingers();
    finder.check_sides();
    return std::move(finder).result();
}

Expected<FoundJoints> find_joints(const MotionClip& clip) {
    Expected<JointSearch> search = search_joints(clip);
    if (!search) {
        return fail(search.error());
    }
    if (search->refusal) {
        return fail(*search->refusal);
    }
    return std::move(search->found);
}

void swap_sides(FoundJoints& found) {
    swap_bones(found, Bone::left_upper_leg, Bone::left_little_distal);
}

}  // namespace raks::motion
