#include "motion/skeleton/body/joint_finder.hpp"

#include "base/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "motion/skeleton/body/bone_words.hpp"
#include "motion/skeleton/body/bones_by_name.hpp"
#include "motion/skeleton/body/parent_tree.hpp"

namespace raks::motion {
namespace {

constexpr double kSaid = 1.0;  // by a person
constexpr double kNamed = 0.9;
constexpr double kBetween = 0.8;  // counted between joints that are sure

constexpr std::size_t kLongestName = 40;  // bytes of a joint's name in a message
constexpr std::size_t kMostNamesShown = 12;

std::vector<int> parents_of(const MotionClip& clip) {
    std::vector<int> parents;
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        const std::size_t parent = clip.joints[joint].parent;
        parents.push_back(parent == joint ? -1 : static_cast<int>(parent));
    }
    return parents;
}

/// A joint's name as a message shows it; a number where it has none.
std::string shown_name(const MotionClip& clip, std::size_t joint) {
    const std::string& name = clip.joints[joint].name;
    return name.empty() ? fmt::format("(joint {})", joint) : printable(name, kLongestName);
}

/// "a, b, c, ... (20 in all)".
std::string shown_joints(const MotionClip& clip) {
    std::string text;
    for (std::size_t joint = 0; joint < clip.joints.size() && joint < kMostNamesShown; ++joint) {
        text += (joint == 0 ? "" : ", ") + shown_name(clip, joint);
    }
    return clip.joints.size() > kMostNamesShown
               ? text + fmt::format(", ... ({} in all)", clip.joints.size())
               : text;
}

/// The search: each step adds to what the steps before it found.
class Finder {
 public:
    explicit Finder(const MotionClip& clip) : clip_(clip), tree_(parents_of(clip)) {}

    Expected<void> take_labels(const JointLabels& labels) {
        for (const JointLabel& label : labels.joints) {
            const Expected<std::size_t> joint = joint_called(label);
            if (!joint) {
                return fail(labels.source + ": " + joint.error().message);
            }
            set(label.bone, static_cast<int>(*joint), "said by " + labels.source, kSaid);
        }
        for (const JointLabel& label : labels.joints) {
            if (const std::optional<Bone> parent = nearest_above(label.bone);
                parent && !tree_.is_below(joint(label.bone), joint(*parent))) {
                return fail(fmt::format("{}: {} \"{}\" does not hang on {} \"{}\"",
                                        labels.source,
                                        kBoneNames[index_of(label.bone)],
                                        name_of(label.bone),
                                        kBoneNames[index_of(*parent)],
                                        name_of(*parent)));
            }
        }
        return {};
    }

    void take_names() {
        std::vector<NamedNode> nodes;
        for (const ClipJoint& joint : clip_.joints) {
            nodes.push_back({.name = joint.name});
        }
        const BonesByName named = bones_by_name(nodes, tree_);
        for (int i = 0; i < kBoneCount; ++i) {
            const Bone bone = static_cast<Bone>(i);
            const bool is_by_tree = bone == Bone::hips && named.are_hips_by_tree;
            add(bone,
                named.nodes[index_of(bone)],
                is_by_tree ? "it carries legs and arms" : "by its name",
                is_by_tree ? kBetween : kNamed);
        }
    }

    /// The trunk is counted in its chain, whatever its joints are called, so that one skeleton
    /// under two schemes of names bends alike: first, middle, last of what bends between hips and
    /// arms.
    void spread_spine() {
        const std::vector<int> chain = trunk_chain();
        if (chain.empty()) {
            return;
        }
        for (const Bone bone : {Bone::spine, Bone::chest, Bone::upper_chest}) {
            if (is_said(bone)) {
                return;
            }
        }
        for (const Bone bone : {Bone::spine, Bone::chest, Bone::upper_chest}) {
            drop(bone);
        }
        const auto place = [&](Bone bone, std::size_t at) {
            const auto count = chain.size();
            add(bone,
                chain[at],
                fmt::format("{} of {} between hips and arms", at + 1, count),
                kBetween);
        };
        place(Bone::spine, 0);
        if (chain.size() > 1) {
            place(Bone::chest, chain.size() < 4 ? 1 : chain.size() / 2);
        }
        if (chain.size() > 2) {
            place(Bone::upper_chest, chain.size() - 1);
        }
    }

    /// A bone cannot lie above what it is a part of.
    void drop_upside_down() {
        for (int i = 0; i < kBoneCount; ++i) {
            const Bone bone = static_cast<Bone>(i);
            const std::optional<Bone> parent = nearest_above(bone);
            if (has(bone) && parent && !tree_.is_below(joint(bone), joint(*parent))) {
                found_.notes.push_back(fmt::format("\"{}\" is no {}: it does not hang on the {}",
                                                   name_of(bone),
                                                   kBoneNames[index_of(bone)],
                                                   kBoneNames[index_of(*parent)]));
                drop(bone);
            }
        }
    }

    JointSearch result() && {
        JointSearch search{.found = std::move(found_), .refusal = {}};
        search.refusal = refusal_of(search.found);
        return search;
    }

 private:
    Expected<std::size_t> joint_called(const JointLabel& label) const {
        std::optional<std::size_t> found;
        std::vector<std::string_view> names;
        for (std::size_t joint = 0; joint < clip_.joints.size(); ++joint) {
            names.push_back(clip_.joints[joint].name);
            if (clip_.joints[joint].name != label.joint) {
                continue;
            }
            if (found) {
                return fail(fmt::format("{}: two joints are called \"{}\"",
                                        kBoneNames[index_of(label.bone)],
                                        printable(label.joint, kLongestName)));
            }
            found = joint;
        }
        if (!found) {
            const std::string_view nearest = nearest_name(label.joint, names);
            return fail(fmt::format(
                "{}: the clip has no joint \"{}\"{}",
                kBoneNames[index_of(label.bone)],
                printable(label.joint, kLongestName),
                nearest.empty()
                    ? ": it has " + shown_joints(clip_)
                    : fmt::format("; did you mean \"{}\"?", printable(nearest, kLongestName))));
        }
        return *found;
    }

    bool has(Bone bone) const { return found_.mapping.joint(bone).has_value(); }
    int joint(Bone bone) const { return static_cast<int>(*found_.mapping.joint(bone)); }
    bool is_said(Bone bone) const { return found_.confidence[index_of(bone)] == kSaid; }
    std::string name_of(Bone bone) const { return shown_name(clip_, *found_.mapping.joint(bone)); }

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

    /// The nearest bone above that is found.
    std::optional<Bone> nearest_above(Bone bone) const {
        while (bone != Bone::hips) {
            bone = static_cast<Bone>(kBoneParents[index_of(bone)]);
            if (has(bone)) {
                return bone;
            }
        }
        return std::nullopt;
    }

    /// The joints that bend between the hips and what carries both arms, from below: twist joints
    /// and those without a length of their own are passed over.
    std::vector<int> trunk_chain() const {
        if (!has(Bone::hips) || !has(Bone::left_upper_arm) || !has(Bone::right_upper_arm)) {
            return {};
        }
        int top = tree_.carrier_of(joint(Bone::left_upper_arm), joint(Bone::right_upper_arm));
        if (has(Bone::neck) && top == joint(Bone::neck)) {  // Biped hangs the arms on the neck
            top = tree_.parent(top);
        }
        std::vector<int> all;
        for (int at = top; at >= 0 && at != joint(Bone::hips); at = tree_.parent(at)) {
            all.insert(all.begin(), at);
        }
        double length = 0.0;
        for (const int at : all) {
            length += length_of(at);
        }
        constexpr double kNoLength = 1e-3;  // of the trunk
        std::vector<int> chain;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const bool is_last = i + 1 == all.size();
            const bool has_length = is_last || length_of(all[i + 1]) > kNoLength * length;
            const auto words = words_of_name(clip_.joints[static_cast<std::size_t>(all[i])].name);
            const bool is_twist = std::find(words.begin(), words.end(), "twist") != words.end();
            if (is_last || (has_length && !is_twist)) {
                chain.push_back(all[i]);
            }
        }
        return chain;
    }

    /// Distance of a joint from its parent's.
    double length_of(int joint) const {
        return glm::length(clip_.position(0, static_cast<std::size_t>(joint)));
    }

    std::optional<Error> refusal_of(const FoundJoints& found) const {
        const auto has_all = [&](std::initializer_list<Bone> bones) {
            return std::all_of(bones.begin(), bones.end(), [&](Bone bone) {
                return found.mapping.joint(bone) && found.mapping.joint(mirrored(bone));
            });
        };
        std::string here;
        std::string missing;
        const auto need = [&](std::initializer_list<Bone> bones, std::string_view what) {
            std::string& list = has_all(bones) ? here : missing;
            list += (list.empty() ? "" : ", ") + std::string(what);
        };
        need({Bone::hips}, "hips");
        need({Bone::left_upper_leg, Bone::left_lower_leg, Bone::left_foot}, "legs");
        need({Bone::left_upper_arm, Bone::left_lower_arm, Bone::left_hand}, "arms");
        if (missing.empty()) {
            return std::nullopt;
        }
        return Error{fmt::format(
            "no humanoid: {} not found{} among {} joint{}: {}; say which joint is which bone",
            missing,
            here.empty() ? "" : fmt::format(" (found: {})", here),
            clip_.joints.size(),
            clip_.joints.size() == 1 ? "" : "s",
            shown_joints(clip_))};
    }

    const MotionClip& clip_;
    ParentTree tree_;
    FoundJoints found_;
};

}  // namespace

Expected<JointSearch> search_joints(const MotionClip& clip, const JointLabels& labels) {
    Finder finder(clip);
    if (const Expected<void> taken = finder.take_labels(labels); !taken) {
        return fail(taken.error());
    }
    finder.take_names();
    finder.drop_upside_down();
    finder.spread_spine();
    return std::move(finder).result();
}

Expected<FoundJoints> find_joints(const MotionClip& clip, const JointLabels& labels) {
    Expected<JointSearch> search = search_joints(clip, labels);
    if (!search) {
        return fail(search.error());
    }
    if (search->refusal) {
        return fail(*search->refusal);
    }
    return std::move(search->found);
}

void swap_sides(FoundJoints& found) {
    for (int i = 0; i < kBoneCount; ++i) {
        const auto left = static_cast<std::size_t>(i);
        const std::size_t right = index_of(mirrored(static_cast<Bone>(i)));
        if (left < right) {
            std::swap(found.mapping.joints[left], found.mapping.joints[right]);
            std::swap(found.reasons[left], found.reasons[right]);
            std::swap(found.confidence[left], found.confidence[right]);
        }
    }
}

std::string joint_map_text(const MotionClip& clip, const FoundJoints& found) {
    std::string text =
        "# Which joint of the clip is which bone. An empty name is left to be found.\n"
        "format = \"raks-joint-map\"\nversion = 1\n\n[joints]\n";
    for (int i = 0; i < kBoneCount; ++i) {
        const Bone bone = static_cast<Bone>(i);
        const auto joint = found.mapping.joint(bone);
        if (!joint && i >= static_cast<int>(Bone::left_thumb_metacarpal) &&
            kBoneParents[index_of(bone)] >= static_cast<int>(Bone::left_hand)) {
            continue;  // fingers that nobody needs would hide what is missing
        }
        text += fmt::format("{} = {}\n",
                            kBoneNames[index_of(bone)],
                            toml_quoted(joint ? clip.joints[*joint].name : std::string()));
    }
    text += "\n# Joints of the clip, parents first:\n";
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        text += fmt::format("# {}\n", shown_name(clip, joint));
    }
    return text;
}

}  // namespace raks::motion
