#include "render/export/tds_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string_view>

#include "motion/skeleton/humanoid.hpp"

namespace raks::render {
namespace {

/// In the order of motion::Bone, without the side.
constexpr std::array<std::string_view, 29> kShortNames = {
    "Hips",   "Spine",  "Chest",    "UpChest", "Neck",    "Head",    "UpLeg",   "LowLeg",
    "Foot",   "Toes",   "Shoulder", "UpArm",   "LowArm",  "Hand",    "Thumb1",  "Thumb2",
    "Thumb3", "Index1", "Index2",   "Index3",  "Middle1", "Middle2", "Middle3", "Ring1",
    "Ring2",  "Ring3",  "Little1",  "Little2", "Little3"};
constexpr std::size_t kInTheMiddle = 6;  // bones without a side
constexpr std::size_t kOnASide = kShortNames.size() - kInTheMiddle;
static_assert(kInTheMiddle + 2 * kOnASide == motion::kBoneCount);

std::string bone_name(std::size_t bone) {
    if (bone < kInTheMiddle) {
        return std::string(kShortNames[bone]);
    }
    const bool is_left = bone < kShortNames.size();
    return std::string(kShortNames[is_left ? bone : bone - kOnASide]) + (is_left ? "L" : "R");
}

/// Hands out names that are not taken.
class Names {
 public:
    explicit Names(std::size_t longest) : longest_(longest) {}

    std::string unique(std::string_view wanted) {
        std::string plain;
        for (const char c : wanted) {
            const auto letter = static_cast<unsigned char>(c);
            plain += letter > ' ' && letter < 127 ? c : '_';
        }
        plain = plain.empty() ? "part" : plain.substr(0, longest_);
        std::string name = plain;
        for (int number = 1; !taken_.insert(in_small_letters(name)).second; ++number) {
            const std::string tail = fmt::format("{}", number);
            name = plain.substr(0, longest_ - tail.size()) + tail;
        }
        return name;
    }

 private:
    static std::string in_small_letters(std::string name) {
        std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) {
            return static_cast<char>(std::tolower(c));
        });
        return name;
    }

    std::size_t longest_;
    std::set<std::string> taken_;
};

}  // namespace

std::vector<std::string> tds_node_names(const Model& model) {
    constexpr std::size_t kLongest = 10;
    Names names(kLongest);
    std::vector<std::string> of_node(model.nodes.size());
    const auto& bones = model.character.humanoid.nodes;
    for (std::size_t bone = 0; bone < bones.size(); ++bone) {
        if (bones[bone] >= 0) {
            of_node[static_cast<std::size_t>(bones[bone])] = names.unique(bone_name(bone));
        }
    }
    for (std::size_t i = 0; i < of_node.size(); ++i) {
        if (of_node[i].empty()) {
            of_node[i] = names.unique(model.nodes[i].name);
        }
    }
    return of_node;
}

std::vector<std::string> tds_material_names(const Model& model) {
    constexpr std::size_t kLongest = 16;
    Names names(kLongest);
    std::vector<std::string> all;
    for (const ModelMaterial& material : model.materials) {
        all.push_back(names.unique(material.name));
    }
    return all;
}

}  // namespace raks::render
