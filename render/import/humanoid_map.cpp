#include "render/import/humanoid_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "motion/skeleton/body/joint_finder.hpp"
#include "render/import/bind_places.hpp"
#include "render/import/humanoid_names.hpp"
#include "render/import/humanoid_shape.hpp"
#include "render/import/joint_shape.hpp"
#include "render/import/limb_faults.hpp"
#include "render/import/model_motion.hpp"
#include "render/import/model_warnings.hpp"
#include "render/import/node_tree.hpp"

namespace raks::render {
namespace {

using motion::Bone;

constexpr float kMostLean = 1.0F;  // radians, 57 degrees: a stoop, no animal

// Confidence of a bone.
constexpr float kSaid = 1.0F;       // by the file or a person
constexpr float kBoth = 0.97F;      // name and shape say the same
constexpr float kOneOfTwo = 0.75F;  // the name says so, the shape something else
constexpr float kDoubtful = 0.5F;   // the picture speaks against it

/// The node that a label names: joints before other nodes, whose names are often those of joints.
Expected<int> labelled_node(const Model& model,
                            const std::vector<bool>& is_joint,
                            const BoneLabels& labels,
                            const BoneLabel& label) {
    const std::string_view bone = motion::kBoneNames[motion::index_of(label.bone)];
    int found = -1;
    for (const bool wants_joint : {true, false}) {
        for (std::size_t i = 0; i < model.nodes.size(); ++i) {
            if (model.nodes[i].name != label.node || is_joint[i] != wants_joint) {
                continue;
            }
            if (found >= 0) {
                return fail(fmt::format(
                    "{}: {}: two nodes are named \"{}\"", labels.file, bone, label.node));
            }
            found = static_cast<int>(i);
        }
        if (found >= 0) {
            return found;
        }
    }
    return fail(fmt::format("{}: {}: the model has no node \"{}\"", labels.file, bone, label.node));
}

/// What labels say that can be: a line that cannot is said, and the rest is kept.
HumanoidMap map_by_labels(Model& model, const BoneLabels& labels) {
    std::vector<bool> is_joint(model.nodes.size(), false);
    for (const ModelSkin& skin : model.skins) {
        for (const int joint : skin.joints) {
            is_joint[static_cast<std::size_t>(joint)] = true;
        }
    }
    for (const std::string& line : labels.left_out) {
        warn(model, line);
    }
    HumanoidMap map;
    for (const BoneLabel& label : labels.bones) {
        const std::size_t bone = motion::index_of(label.bone);
        const Expected<int> node = labelled_node(model, is_joint, labels, label);
        if (!node) {
            warn(model, node.error().message + "; left out");
            continue;
        }
        const auto* const same = std::find(map.nodes.begin(), map.nodes.end(), *node);
        if (same != map.nodes.end()) {
            warn(model,
                 fmt::format("{}: {} and {} are the same node; the second is left out",
                             labels.file,
                             motion::kBoneNames[static_cast<std::size_t>(same - map.nodes.begin())],
                             motion::kBoneNames[bone]));
            continue;
        }
        map.nodes[bone] = *node;
        map.axes[bone] = label.axis;
        map.reasons[bone] = BoneReason::label;
        map.confidence[bone] = kSaid;
    }
    return map;
}

/// Takes from `more` the bones that `map` lacks, where their nodes are free.
void fill(HumanoidMap& map, const HumanoidMap& more, std::span<const Bone> bones) {
    for (const Bone bone : bones) {
        const std::size_t at = motion::index_of(bone);
        const int node = more.nodes[at];
        const bool is_free = std::find(map.nodes.begin(), map.nodes.end(), node) == map.nodes.end();
        if (map.nodes[at] < 0 && node >= 0 && is_free) {
            map.nodes[at] = node;
            map.reasons[at] = more.reasons[at];
            map.confidence[at] = more.confidence[at];
        }
    }
}

/// All bones, in their order.
std::vector<Bone> all_bones() {
    std::vector<Bone> bones;
    for (int bone = 0; bone < motion::kBoneCount; ++bone) {
        bones.push_back(static_cast<Bone>(bone));
    }
    return bones;
}

/// Leaves out bones that lie above what they are a part of: a tree cannot be so.
void drop_upside_down(Model& model, HumanoidMap& map) {
    for (int bone = 0; bone < motion::kBoneCount; ++bone) {
        const int parent = mapped_parent(map, bone);
        int& node = map.nodes[static_cast<std::size_t>(bone)];
        if (node < 0 || parent < 0) {
            continue;
        }
        // Hips may hang under the trunk: the tree is turned over where the figure stands up.
        const bool is_trunk = parent == 0 && bone <= static_cast<int>(motion::index_of(Bone::head));
        if (!is_trunk && is_below(model, map.nodes[static_cast<std::size_t>(parent)], node)) {
            warn(model,
                 fmt::format("\"{}\" cannot be the {}: it carries the {}; left out",
                             node_of(model, node).name,
                             motion::kBoneNames[static_cast<std::size_t>(bone)],
                             motion::kBoneNames[static_cast<std::size_t>(parent)]));
            node = -1;
            map.reasons[static_cast<std::size_t>(bone)] = BoneReason::none;
            map.confidence[static_cast<std::size_t>(bone)] = 0.0F;
        }
    }
}

void swap_sides(HumanoidMap& map) {
    for (const Bone bone : all_bones()) {
        const std::size_t left = motion::index_of(bone);
        const std::size_t right = motion::index_of(mirrored(bone));
        if (left < right) {
            std::swap(map.nodes[left], map.nodes[right]);
            std::swap(map.axes[left], map.axes[right]);
            std::swap(map.confidence[left], map.confidence[right]);
            for (const std::size_t at : {left, right}) {
                map.reasons[at] = map.nodes[at] < 0 ? BoneReason::none : BoneReason::swapped;
            }
        }
    }
    std::swap(map.left_eye, map.right_eye);
}

/// The feet say where a figure faces; its left must be on its left.
void check_sides(Model& model, HumanoidMap& map, std::span<const glm::mat4> world) {
    const auto feet = feet_direction(model, map, world);
    if (feet && glm::dot(*feet, facing_of(map, places_of(world))) < -0.5F) {
        swap_sides(map);
        warn(model,
             "by its feet it looks the other way: its left and right were named the wrong way "
             "round and are swapped");
    }
}

bool is_labelled(const HumanoidMap& map, Bone bone) {
    return map.reasons[motion::index_of(bone)] == BoneReason::label;
}

/// Takes a bone from another map, or takes it away where that has none; what had its node before
/// loses it.
void take(HumanoidMap& map, const HumanoidMap& from, Bone bone) {
    const std::size_t at = motion::index_of(bone);
    for (std::size_t other = 0; other < map.nodes.size() && from.nodes[at] >= 0; ++other) {
        if (map.nodes[other] == from.nodes[at]) {
            map.nodes[other] = -1;
            map.reasons[other] = BoneReason::none;
            map.confidence[other] = 0.0F;
        }
    }
    map.nodes[at] = from.nodes[at];
    map.reasons[at] = from.reasons[at];
    map.confidence[at] = from.confidence[at];
}

/// Turns the sides of a shape to those of the names: where both have a limb, their left is one.
void align_sides(HumanoidMap& shape, const HumanoidMap& named, std::span<const glm::vec3> places) {
    const auto across = [&places](const HumanoidMap& map, Bone left) {
        const int one = map.nodes[motion::index_of(left)];
        const int other = map.nodes[motion::index_of(mirrored(left))];
        return one < 0 || other < 0 ? glm::vec3(0.0F)
                                    : places[static_cast<std::size_t>(one)] -
                                          places[static_cast<std::size_t>(other)];
    };
    float agreement = 0.0F;
    for (const Bone left : {Bone::left_upper_leg,
                            Bone::left_lower_leg,
                            Bone::left_foot,
                            Bone::left_upper_arm,
                            Bone::left_lower_arm,
                            Bone::left_hand}) {
        agreement += glm::dot(across(shape, left), across(named, left));
    }
    if (agreement < 0.0F) {
        for (const Bone bone : all_bones()) {
            if (motion::index_of(bone) < motion::index_of(mirrored(bone))) {
                std::swap(shape.nodes[motion::index_of(bone)],
                          shape.nodes[motion::index_of(mirrored(bone))]);
            }
        }
    }
}

/// How sure bones are that have a name, by what the shape says of them.
void weigh_names(HumanoidMap& map, const HumanoidMap& shape) {
    for (const Bone bone : all_bones()) {
        const std::size_t at = motion::index_of(bone);
        if (map.nodes[at] >= 0 && map.reasons[at] == BoneReason::name && shape.nodes[at] >= 0) {
            const float sure = map.nodes[at] == shape.nodes[at] ? kBoth : kOneOfTwo;
            map.confidence[at] = map.confidence[at] == kDoubtful ? kDoubtful : sure;
        }
    }
}

/// What tree and flesh say against the limbs that names give: a limb that the shape knows better is
/// taken by shape, another becomes doubtful. Lines say so.
void weigh_limbs(Model& model,
                 HumanoidMap& map,
                 const HumanoidMap& shape,
                 std::span<const glm::mat4> world,
                 const NodeFlesh& flesh) {
    for (const CheckedLimb& limb : kCheckedLimbs) {
        const std::array<Bone, 3> bones = {limb.upper, limb.lower, limb.last};
        const std::string fault = limb_fault(model, map, limb, world, flesh);
        const bool is_said = std::any_of(
            bones.begin(), bones.end(), [&map](Bone bone) { return is_labelled(map, bone); });
        if (fault.empty() || is_said) {
            continue;
        }
        const bool is_known = shape.nodes[motion::index_of(limb.upper)] >= 0 &&
                              limb_fault(model, shape, limb, world, flesh).empty();
        if (!is_known) {
            for (const Bone bone : bones) {
                const std::size_t at = motion::index_of(bone);
                map.confidence[at] = map.nodes[at] < 0 ? 0.0F : kDoubtful;
            }
            warn(model,
                 fmt::format("its {} is doubtful: {}; a label file says better", limb.name, fault));
            continue;
        }
        warn(model,
             fmt::format("its {} is found by its place in the skeleton, not by its names: {}",
                         limb.name,
                         fault));
        const bool is_arm =
            limb.upper == Bone::left_upper_arm || limb.upper == Bone::right_upper_arm;
        for (const Bone bone : bones) {
            take(map, shape, bone);
        }
        if (is_arm) {
            take(map,
                 shape,
                 mirrored(limb.upper) == Bone::right_upper_arm ? Bone::left_shoulder
                                                               : Bone::right_shoulder);
        }
    }
}

/// A foot or a hand that does not hang on its limb is doubtful, as a rig's goals look like that.
void weigh_ends(const Model& model, HumanoidMap& map) {
    for (const CheckedLimb& limb : kCheckedLimbs) {
        const int lower = map.nodes[motion::index_of(limb.lower)];
        const int last = map.nodes[motion::index_of(limb.last)];
        if (lower >= 0 && last >= 0 && !is_labelled(map, limb.last) &&
            !is_below(model, last, lower)) {
            map.confidence[motion::index_of(limb.last)] = kDoubtful;
        }
    }
}

/// Hips that hang under the trunk carry both legs; names know only what carries all.
void take_low_hips(const Model& model, HumanoidMap& map, const HumanoidMap& shape) {
    const bool is_low = map.nodes[0] >= 0 && map.reasons[0] == BoneReason::shape &&
                        shape.nodes[0] >= 0 && is_below(model, shape.nodes[0], map.nodes[0]);
    if (is_low) {
        for (const Bone bone : {Bone::hips, Bone::spine, Bone::chest, Bone::upper_chest}) {
            take(map, shape, bone);
        }
    }
}

/// The bones by how the model's first clip moves; empty where it tells no body.
HumanoidMap map_by_motion(const Model& model) {
    HumanoidMap map;
    if (model.animations.empty()) {
        return map;
    }
    const auto moved = model_clip(model, 0, std::nullopt);
    if (!moved) {
        return map;
    }
    const auto search = motion::search_joints(moved->clip);
    if (!search || search->refusal) {
        return map;
    }
    for (const Bone bone : all_bones()) {
        const std::size_t at = motion::index_of(bone);
        if (const auto joint = search->found.mapping.joint(bone)) {
            map.nodes[at] = static_cast<int>(moved->nodes[*joint]);
            map.reasons[at] = BoneReason::motion;
            map.confidence[at] = static_cast<float>(search->found.confidence[at]);
        }
    }
    return map;
}

Expected<void> refuse_without(const HumanoidMap& map) {
    const std::string missing = missing_bones(map);
    return fail(
        fmt::format("no humanoid is found in it: no {}; name its bones in a label file", missing));
}

// Hips may hang under the trunk, but not on a limb.
Expected<void> check_hips(const Model& model, const HumanoidMap& map) {
    const int hips = map.nodes[0];
    for (const CheckedLimb& limb : kCheckedLimbs) {
        for (const motion::Bone bone : {limb.upper, limb.lower, limb.last}) {
            const int node = map.nodes[static_cast<std::size_t>(bone)];
            if (node >= 0 && (node == hips || is_below(model, hips, node))) {
                return fail(fmt::format(
                    "\"{}\", its hips, hangs on its {}", node_of(model, hips).name, limb.name));
            }
        }
    }
    return {};
}

}  // namespace

std::span<const Bone> required_bones(const HumanoidMap& humanoid) noexcept {
    return humanoid.is_of_parts ? std::span<const Bone>(kRequiredParts)
                                : std::span<const Bone>(kRequiredJoints);
}

std::string missing_bones(const HumanoidMap& humanoid) {
    return missing_bones(humanoid, required_bones(humanoid));
}

std::string missing_bones(const HumanoidMap& humanoid, std::span<const Bone> needed) {
    std::string missing;
    for (const Bone bone : needed) {
        if (humanoid.nodes[motion::index_of(bone)] < 0) {
            missing += missing.empty() ? "" : ", ";
            missing += motion::kBoneNames[motion::index_of(bone)];
        }
    }
    return missing;
}

std::string_view words_of(BoneReason reason) noexcept {
    constexpr std::array<std::string_view, 7> kWords = {
        "not found",
        "named in the file",
        "named in the label file",
        "by its name",
        "by its place in the skeleton",
        "by how it moves",
        "by its name, sides swapped",
    };
    return kWords[static_cast<std::size_t>(reason)];
}

HumanoidMap look_for_bones(Model& model, const BoneLabels* labels) {
    if (model.character.humanoid.nodes[0] >= 0) {
        return model.character.humanoid;
    }
    const std::vector<glm::mat4> world = bind_world(model);
    HumanoidMap map;
    if (labels != nullptr) {
        map = map_by_labels(model, *labels);
    }
    map.is_of_parts = model.skins.empty() && !model.meshes.empty();
    const NodeFlesh flesh = flesh_of(model, world);
    const HumanoidMap named = map_by_names(model, flesh);
    const std::vector<Bone> all = all_bones();
    fill(map, named, std::span<const Bone>(all));
    map.left_eye = named.left_eye;
    map.right_eye = named.right_eye;
    map.jaw = named.jaw;
    // Rigid parts have their flesh about their joints: it says nothing of a tree.
    HumanoidMap shape;
    if (!map.is_of_parts) {
        shape = map_by_shape(model, places_of(world), flesh);
    }
    if (shape.nodes[0] < 0) {
        shape = map_by_shape(model, places_of(world));
    }
    align_sides(shape, map, places_of(world));
    if (!map.is_of_parts) {
        take_low_hips(model, map, shape);
    }
    const auto fill_in = [&] {
        if (!missing_bones(map, kRequiredBones).empty()) {
            const bool is_same = map.nodes[0] < 0 || map.nodes[0] == shape.nodes[0];
            fill(map, shape, is_same ? std::span<const Bone>(all) : kRequiredBones);
        }
    };
    fill_in();
    if (!map.is_of_parts) {
        weigh_limbs(model, map, shape, world, flesh);
        fill_in();
        weigh_ends(model, map);
    }
    weigh_names(map, shape);
    drop_upside_down(model, map);
    return map;
}

Expected<void> map_humanoid(Model& model, const BoneLabels* labels) {
    HumanoidMap& humanoid = model.character.humanoid;
    if (humanoid.nodes[0] >= 0) {
        return {};
    }
    HumanoidMap map = look_for_bones(model, labels);
    if (!missing_bones(map).empty()) {
        HumanoidMap moved = map_by_motion(model);
        if (labels != nullptr || !missing_bones(moved).empty()) {
            return refuse_without(map);
        }
        map = std::move(moved);
    }
    if (auto checked = check_hips(model, map); !checked) {
        return checked;
    }
    const std::vector<glm::mat4> world = bind_world(model);
    if (trunk_lean(map, places_of(world)) > kMostLean) {
        return fail("it does not stand upright on two legs");
    }
    check_sides(model, map, world);
    humanoid = map;
    return {};
}

}  // namespace raks::render
