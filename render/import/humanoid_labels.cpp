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

void read_label_head(const toml::table& root, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 3> kKeys = {"format", "version", "bones"};
    complaints.check_head(root, kLabelFormat, kLabelVersion);
    complaints.check_keys(root, kKeys);
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
            labels.bones.push_back({static_cast<motion::Bone>(found - motion::kBoneNames.begin()),
                                    complaints.text(*bones, key.str())});
        }
    }
    if (!complaints.is_sound()) {
        return fail(complaints.fault());
    }
    return labels;
}

}  // namespace raks::render
