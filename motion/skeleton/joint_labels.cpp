#include "motion/skeleton/joint_labels.hpp"

#include "base/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"

namespace raks::motion {
namespace {

constexpr std::string_view kMapFormat = "raks-joint-map";
constexpr std::int64_t kMapVersion = 1;
constexpr std::size_t kLongestShown = 60;  // bytes of a name in a message

std::optional<Bone> bone_called(std::string_view name) {
    const auto* const found = std::find(kBoneNames.begin(), kBoneNames.end(), name);
    return found != kBoneNames.end() ? std::optional(static_cast<Bone>(found - kBoneNames.begin()))
                                     : std::nullopt;
}

void read_map_head(const toml::table& root, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 3> kKeys = {"format", "version", "joints"};
    complaints.check_head(root, kMapFormat, kMapVersion);
    complaints.check_keys(root, kKeys);
}

/// The bone that a joint already has; none: it is free.
std::optional<Bone> bone_of(const JointLabels& labels, std::string_view joint) {
    const auto found = std::find_if(labels.joints.begin(),
                                    labels.joints.end(),
                                    [&](const JointLabel& label) { return label.joint == joint; });
    return found != labels.joints.end() ? std::optional(found->bone) : std::nullopt;
}

std::string said_twice(std::string_view joint, Bone first, Bone second) {
    return fmt::format("joint \"{}\" is said to be {} and {}; one joint is one bone",
                       printable(joint, kLongestShown),
                       kBoneNames[index_of(first)],
                       kBoneNames[index_of(second)]);
}

}  // namespace

Expected<JointLabels> read_joint_map(std::string_view text, const std::string& file) {
    const Expected<toml::table> root = parse_toml(text, file);
    if (!root) {
        return fail(root.error());
    }
    TomlComplaints complaints(file);
    read_map_head(*root, complaints);
    JointLabels labels{.joints = {}, .source = file};
    const toml::table* const joints = (*root)["joints"].as_table();
    if (joints == nullptr) {
        complaints.complain("needs a table [joints] with lines like hips = \"Pelvis\"");
        return fail(complaints.fault());
    }
    complaints.check_keys(*joints, kBoneNames);
    for (const auto& [key, value] : *joints) {
        const std::optional<Bone> bone = bone_called(key.str());
        const std::string joint = complaints.text(*joints, key.str());
        if (!bone || joint.empty()) {
            continue;
        }
        if (const std::optional<Bone> other = bone_of(labels, joint)) {
            complaints.complain(value, said_twice(joint, *other, *bone));
        }
        labels.joints.push_back({*bone, joint});
    }
    if (!complaints.is_sound()) {
        return fail(complaints.fault());
    }
    return labels;
}

Expected<void> add_joint_label(std::string_view text, JointLabels& labels) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos || equals == 0 || equals + 1 == text.size()) {
        return fail(fmt::format("\"{}\" must be BONE=JOINT, as leftUpperArm=bip_l_arm",
                                printable(text, kLongestShown)));
    }
    const std::optional<Bone> bone = bone_called(text.substr(0, equals));
    if (!bone) {
        return fail(unknown_name("bone", text.substr(0, equals), kBoneNames));
    }
    const std::string joint(text.substr(equals + 1));
    std::erase_if(labels.joints, [&](const JointLabel& label) { return label.bone == *bone; });
    if (const std::optional<Bone> other = bone_of(labels, joint)) {
        return fail(said_twice(joint, *other, *bone));
    }
    labels.joints.push_back({*bone, joint});
    return {};
}

Expected<JointLabels> joint_labels(const std::filesystem::path& map,
                                   std::span<const std::string> lines) {
    JointLabels labels;
    if (!map.empty()) {
        const Expected<std::string> text = read_text_file(map, kLongestToml);
        if (!text) {
            return fail(text.error());
        }
        Expected<JointLabels> read = read_joint_map(*text, map.string());
        if (!read) {
            return read;
        }
        labels = std::move(*read);
    }
    std::vector<std::string_view> bones;
    for (const std::string& line : lines) {
        const std::string_view bone = std::string_view(line).substr(0, line.find('='));
        if (std::find(bones.begin(), bones.end(), bone) != bones.end()) {
            return fail(fmt::format("--joint: bone \"{}\" is given twice; one bone is one joint",
                                    printable(bone, kLongestShown)));
        }
        bones.push_back(bone);
        if (const Expected<void> added = add_joint_label(line, labels); !added) {
            return fail(Error(added.error()).in("--joint"));
        }
    }
    if (!lines.empty()) {
        labels.source += labels.source.empty() ? "--joint" : ", --joint";
    }
    return labels;
}

}  // namespace raks::motion
