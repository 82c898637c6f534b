#include "render/import/humanoid_labels.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/file.hpp"
#include "base/printable.hpp"
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

/// The bone that a line of the table gives a node, bare or in quotes; empty: none.
std::string_view bone_of_line(std::string_view line) {
    constexpr std::string_view kBlanks = " \t";
    const std::size_t equals = std::min(line.find('='), line.size());
    std::string_view key = line.substr(0, equals);
    key.remove_prefix(std::min(key.find_first_not_of(kBlanks), key.size()));
    key = key.substr(0, key.find_last_not_of(kBlanks) + 1);
    const bool is_quoted =
        key.size() > 1 && (key.front() == '"' || key.front() == '\'') && key.front() == key.back();
    key = is_quoted ? key.substr(1, key.size() - 2) : key;
    const auto found = std::find(motion::kBoneNames.begin(), motion::kBoneNames.end(), key);
    return equals < line.size() && found != motion::kBoneNames.end() ? *found : std::string_view();
}

/// A label file whose lines of a bone that has one already are empty, with what is to be said.
struct UniqueLines {
    std::string text;
    std::vector<std::string> left_out;
};

UniqueLines with_first_lines(std::string_view text, const std::string& file) {
    UniqueLines unique;
    std::map<std::string_view, std::size_t> lines;  // of the bones, from 1
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::string_view line = text.substr(0, text.find('\n'));
        const std::string_view bone = bone_of_line(line);
        const auto [first, is_new] = lines.try_emplace(bone, number);
        if (bone.empty() || is_new) {
            unique.text += line;
        } else {
            unique.left_out.push_back(
                fmt::format("{}: line {}: {} is on line {} already; this line is left out",
                            file,
                            number,
                            bone,
                            first->second));
        }
        unique.text += '\n';
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    return unique;
}

/// What a TOML text says; where it is none, since bones stand in it twice, what it says without.
Expected<toml::table> parse_labels(std::string_view text,
                                   const std::string& file,
                                   std::vector<std::string>& left_out) {
    Expected<toml::table> root = parse_toml(text, file);
    if (root || text.size() > kLongestToml) {
        return root;
    }
    UniqueLines unique = with_first_lines(text, file);
    if (unique.left_out.empty()) {
        return root;
    }
    left_out = std::move(unique.left_out);
    return parse_toml(unique.text, file);
}

}  // namespace

Expected<BoneLabels> read_bone_labels(std::string_view text, const std::string& file) {
    BoneLabels labels{.file = file, .bones = {}};
    const Expected<toml::table> root = parse_labels(text, file, labels.left_out);
    if (!root) {
        return fail(root.error());
    }
    TomlComplaints complaints(file);
    read_label_head(*root, complaints);
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

Expected<BoneLabels> load_labels(const std::filesystem::path& file) {
    constexpr std::size_t kLargestLabels = std::size_t{1} << 20U;  // bytes
    const auto text = read_text_file(file, kLargestLabels);
    if (!text) {
        return fail(text.error());
    }
    return read_bone_labels(*text, printable(file.string()));
}

std::filesystem::path labels_beside(const std::filesystem::path& model) {
    std::filesystem::path beside = model;
    beside.replace_extension(".labels.toml");
    std::error_code ignored;
    return std::filesystem::is_regular_file(beside, ignored) ? beside : std::filesystem::path();
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
