#include "render/import/humanoid_labels.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/toml_reader.hpp"

#include <fmt/format.h>

namespace raks::render {
namespace {

constexpr std::string_view kLabelFormat = "raks-avatar-labels";
constexpr std::int64_t kLabelVersion = 1;

constexpr std::array<std::string_view, 6> kAxes = {"x", "y", "z", "-x", "-y", "-z"};

void read_label_head(const toml::table& root, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 3> kKeys = {"format", "version", "bones"};
    complaints.check_head(root, kLabelFormat, kLabelVersion);
    complaints.check_keys(root, kKeys);
}

/// An axis by its name; 0 and a complaint where it is none.
glm::vec3 read_bone_axis(const toml::node& node, TomlComplaints& complaints) {
    const std::size_t word = complaints.word(node, "axis", kAxes);
    glm::vec3 axis(0.0F);
    if (complaints.is_sound()) {
        axis[static_cast<int>(word % 3)] = word < 3 ? 1.0F : -1.0F;
    }
    return axis;
}

BoneLabel read_bone_label(const toml::table& bones,
                          std::string_view name,
                          motion::Bone bone,
                          TomlComplaints& complaints) {
    const toml::table* const parts = bones[name].as_table();
    if (parts == nullptr) {
        return {.bone = bone, .node = complaints.text(bones, name)};
    }
    constexpr std::array<std::string_view, 2> kKeys = {"node", "axis"};
    complaints.check_keys(*parts, kKeys);
    static_cast<void>(complaints.needed(*parts, "node", "node = \"...\""));
    BoneLabel label{.bone = bone, .node = complaints.text(*parts, "node")};
    if (const toml::node* const axis = parts->get("axis")) {
        label.axis = read_bone_axis(*axis, complaints);
    }
    return label;
}

}  // namespace

Expected<BoneLabels> read_bone_labels(std::string_view text, const std::string& file) {
    const Expected<toml::table> root = parse_toml(text, file);
    if (!root) {
        return fail(root.error());
    }
    TomlComplaints complaints(file);
    read_label_head(*root, complaints);
    BoneLabels labels{.file = file, .bones = {}};
    const toml::table* const bones = (*root)["bones"].as_table();
    if (bones == nullptr || bones->empty()) {
        complaints.complain("needs a table [bones] with lines like hips = \"Pelvis\"");
        return fail(complaints.fault());
    }
    complaints.check_keys(*bones, motion::kBoneNames);
    for (const auto& [key, value] : *bones) {
        const auto* const found =
            std::find(motion::kBoneNames.begin(), motion::kBoneNames.end(), key.str());
        if (found != motion::kBoneNames.end()) {
            const auto bone = static_cast<motion::Bone>(found - motion::kBoneNames.begin());
            labels.bones.push_back(read_bone_label(*bones, key.str(), bone, complaints));
        }
    }
    if (!complaints.is_sound()) {
        return fail(complaints.fault());
    }
    return labels;
}

std::string name_of_axis(const glm::vec3& axis) {
    for (std::size_t i = 0; i < kAxes.size(); ++i) {
        if (axis[static_cast<int>(i % 3)] == (i < 3 ? 1.0F : -1.0F)) {
            return std::string(kAxes[i]);
        }
    }
    return {};
}

std::string bone_labels_text(std::span<const BoneLabel> labels) {
    std::string text =
        fmt::format("format = \"{}\"\nversion = {}\n\n[bones]\n", kLabelFormat, kLabelVersion);
    for (const BoneLabel& label : labels) {
        const std::string node = toml_quoted(label.node);
        const std::string axis = name_of_axis(label.axis);
        text += fmt::format(
            "{} = {}\n",
            motion::kBoneNames[motion::index_of(label.bone)],
            axis.empty() ? node : fmt::format("{{node = {}, axis = \"{}\"}}", node, axis));
    }
    return text;
}

}  // namespace raks::render
