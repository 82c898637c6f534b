#include "render/import/humanoid_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "render/import/bind_places.hpp"
#include "render/import/humanoid_names.hpp"
#include "render/import/humanoid_shape.hpp"
#include "render/import/model_warnings.hpp"
#include "render/import/node_tree.hpp"

namespace raks::render {
namespace {

using motion::Bone;

constexpr float kMostLean = 1.0F;  // radians, 57 degrees: a stoop, no animal

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
        if (is_below(model, map.nodes[static_cast<std::size_t>(parent)], node)) {
            warn(model,
                 fmt::format("\"{}\" cannot be the {}: it carries the {}; left out",
                             node_of(model, node).name,
                             motion::kBoneNames[static_cast<std::size_t>(bone)],
                             motion::kBoneNames[static_cast<std::size_t>(parent)]));
            node = -1;
            map.reasons[static_cast<std::size_t>(bone)] = BoneReason::none;
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

bool has_all_bones(const HumanoidMap& map) {
    return std::all_of(kRequiredBones.begin(), kRequiredBones.end(), [&map](Bone bone) {
        return map.nodes[motion::index_of(bone)] >= 0;
    });
}

Expected<void> refuse_without(const HumanoidMap& map) {
    const std::string missing = missing_bones(map);
    return fail(
        fmt::format("no humanoid is found in it: no {}; name its bones in a label file", missing));
}

}  // namespace

std::string missing_bones(const HumanoidMap& humanoid) {
    std::string missing;
    const auto needed = humanoid.is_of_parts ? std::span<const Bone>(kRequiredParts)
                                             : std::span<const Bone>(kRequiredBones);
    for (const Bone bone : needed) {
        if (humanoid.nodes[motion::index_of(bone)] < 0) {
            missing += missing.empty() ? "" : ", ";
            missing += motion::kBoneNames[motion::index_of(bone)];
        }
    }
    return missing;
}

std::string_view words_of(BoneReason reason) noexcept {
    constexpr std::array<std::string_view, 6> kWords = {
        "not found",
        "named in the file",
        "named in the label file",
        "by its name",
        "by its place in the skeleton",
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
    const HumanoidMap named = map_by_names(model);
    const std::vector<Bone> all = all_bones();
    fill(map, named, std::span<const Bone>(all));
    map.left_eye = named.left_eye;
    map.right_eye = named.right_eye;
    map.jaw = named.jaw;
    if (!has_all_bones(map)) {
        const HumanoidMap shaped = map_by_shape(model, places_of(world));
        const bool is_same = map.nodes[0] < 0 || map.nodes[0] == shaped.nodes[0];
        fill(map, shaped, is_same ? std::span<const Bone>(all) : kRequiredBones);
    }
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
        return refuse_without(map);
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
