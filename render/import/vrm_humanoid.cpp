#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/import/humanoid_map.hpp"
#include "render/import/lenient.hpp"
#include "render/import/node_tree.hpp"
#include "render/import/vrm_parts.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kMostBones = 200;  // names in a file; VRM knows 55

/// Where the map keeps the node of a bone by its VRM 1.0 name; null: no such bone.
int* place_of_bone(HumanoidMap& humanoid, std::string_view name) {
    if (name == "leftEye") {
        return &humanoid.left_eye;
    }
    if (name == "rightEye") {
        return &humanoid.right_eye;
    }
    if (name == "jaw") {
        return &humanoid.jaw;
    }
    const auto* const found = std::find(motion::kBoneNames.begin(), motion::kBoneNames.end(), name);
    if (found == motion::kBoneNames.end()) {
        return nullptr;
    }
    const auto bone = static_cast<std::size_t>(found - motion::kBoneNames.begin());
    humanoid.reasons[bone] = BoneReason::stated;
    humanoid.confidence[bone] = 1.0F;
    return &humanoid.nodes[bone];
}

/// The VRM 1.0 name of a bone of VRM 0.x: the same three joints of the thumb are named one on.
std::string_view name_in_vrm1(std::string_view name) {
    struct Renamed {
        std::string_view vrm0;
        std::string_view vrm1;
    };
    static constexpr std::array<Renamed, 4> kThumbs = {{
        {"leftThumbProximal", "leftThumbMetacarpal"},
        {"leftThumbIntermediate", "leftThumbProximal"},
        {"rightThumbProximal", "rightThumbMetacarpal"},
        {"rightThumbIntermediate", "rightThumbProximal"},
    }};
    for (const Renamed& thumb : kThumbs) {
        if (thumb.vrm0 == name) {
            return thumb.vrm1;
        }
    }
    return name;
}

void add_bone(const JsonField& at, std::string_view name, int node, Model& model) {
    int* const place = place_of_bone(model.character.humanoid, name);
    if (place == nullptr) {
        warn(model, at.line(fmt::format("there is no bone \"{}\"; left out", name)));
    } else if (*place >= 0) {
        warn(model, at.line(fmt::format("{} is named twice; the first is taken", name)));
    } else {
        *place = node;
    }
}

/// Complains of a node that stands for two bones, and of bones against the tree of nodes.
void check_tree(const JsonField& bones, Model& model) {
    const HumanoidMap& humanoid = model.character.humanoid;
    std::vector<int> owner(model.nodes.size(), -1);
    for (int bone = 0; bone < motion::kBoneCount; ++bone) {
        const auto at = static_cast<std::size_t>(bone);
        const int node = humanoid.nodes[at];
        if (node < 0) {
            continue;
        }
        int& owned = owner[static_cast<std::size_t>(node)];
        if (owned >= 0) {
            bones.complain(fmt::format("{} and {} are the same node",
                                       motion::kBoneNames[static_cast<std::size_t>(owned)],
                                       motion::kBoneNames[at]));
            return;
        }
        owned = bone;
        const int parent = mapped_parent(humanoid, bone);
        if (parent < 0) {
            continue;
        }
        const auto above = static_cast<std::size_t>(parent);
        if (is_below(model, humanoid.nodes[above], node)) {
            bones.complain(fmt::format("{} lies above {}, of which it is a part",
                                       motion::kBoneNames[at],
                                       motion::kBoneNames[above]));
        } else if (!is_below(model, node, humanoid.nodes[above])) {
            warn(model,
                 bones.line(fmt::format("{} does not lie below {}; it is moved there",
                                        motion::kBoneNames[at],
                                        motion::kBoneNames[above])));
        }
    }
}

}  // namespace

void read_human_bones1(const JsonField& bones, Model& model) {
    if (model.nodes.empty()) {
        return;  // no bone can be there
    }
    for (const auto& [name, bone] : bones.entries()) {
        add_bone(bone, name, bone["node"].index(model.nodes.size()), model);
    }
    check_tree(bones, model);
}

void read_human_bones0(const JsonField& bones, Model& model) {
    if (model.nodes.empty()) {
        return;  // no bone can be there
    }
    for (const JsonField& bone : bones.items(kMostBones)) {
        const std::string_view name = bone["bone"].text();
        const std::int64_t node =
            bone["node"].whole(-1, static_cast<std::int64_t>(model.nodes.size()) - 1);
        if (node < 0) {
            warn(model, bone.line(fmt::format("{} has no node; left out", name)));
        } else {
            add_bone(bone, name_in_vrm1(name), static_cast<int>(node), model);
        }
    }
    check_tree(bones, model);
}

Expected<void> check_required_bones(const HumanoidMap& humanoid) {
    const std::string missing = missing_bones(humanoid, kRequiredBones);
    if (!missing.empty()) {
        return fail(fmt::format("its skeleton has no {}", missing));
    }
    return {};
}

}  // namespace raks::render
