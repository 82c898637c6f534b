#include "motion/skeleton/formats/mmd/mmd_bones.hpp"

#include <functional>
#include <unordered_map>
#include <utility>

#include "motion/skeleton/formats/mmd/mmd_text.hpp"

namespace raks::motion {
namespace {

// By bone; those of limbs without their side.
constexpr std::array<std::string_view, kMmdTrunkBones + kMmdSideBones> kMmdNames = {
    "全ての親",   "センター",     "グルーブ", "腰",     "上半身", "上半身2", "上半身3", "首",
    "頭",         "下半身",       "肩P",      "肩",     "肩C",    "腕",      "腕捩",    "ひじ",
    "手捩",       "手首",         "親指０",   "親指１", "親指２", "人指１",  "人指２",  "人指３",
    "中指１",     "中指２",       "中指３",   "薬指１", "薬指２", "薬指３",  "小指１",  "小指２",
    "小指３",     "腰キャンセル", "足",       "ひざ",   "足首",   "つま先",  "足IK親",  "足ＩＫ",
    "つま先ＩＫ", "足D",          "ひざD",    "足首D",  "足先EX",
};

// Other spellings that files have, without their side.
constexpr std::array<std::pair<std::string_view, MmdBone>, 7> kMmdOtherNames = {{
    {"腕捩れ", MmdBone::left_arm_twist},
    {"手捩れ", MmdBone::left_wrist_twist},
    {"人差指１", MmdBone::left_index1},
    {"人差指２", MmdBone::left_index2},
    {"人差指３", MmdBone::left_index3},
    {"ヒジ", MmdBone::left_elbow},
    {"ヒザ", MmdBone::left_knee},
}};

// Of the waist's helper the side stands behind the name.
std::string sided(std::string_view name, MmdBone left, Side side) {
    const std::string word = side == Side::left ? "左" : "右";
    return left == MmdBone::left_waist_cancel ? std::string(name) + word : word + std::string(name);
}

struct BytesHash {
    using is_transparent = void;
    std::size_t operator()(std::string_view bytes) const {
        return std::hash<std::string_view>()(bytes);
    }
};
using BonesByBytes = std::unordered_map<std::string, MmdBone, BytesHash, std::equal_to<>>;

void add_spellings(const std::string& name, MmdBone bone, std::size_t field, BonesByBytes& bones) {
    for (const std::string& spelling : {name, narrow(name), wide(name)}) {
        for (const MmdCode code : kMmdCodes) {
            const auto bytes = mmd_bytes(spelling, code);
            // A name that is cut must not lose its side.
            const bool is_sideless =
                bytes && bytes->size() > field && left_of(bone) == MmdBone::left_waist_cancel;
            if (bytes && !is_sideless) {
                bones.emplace(bytes->substr(0, field), bone);
            }
        }
    }
}

BonesByBytes bones_by_bytes(std::size_t field) {
    BonesByBytes bones;
    for (std::size_t i = 0; i < kMmdBones; ++i) {
        const auto bone = static_cast<MmdBone>(i);
        add_spellings(mmd_name(bone), bone, field, bones);
    }
    for (const auto& [name, left] : kMmdOtherNames) {
        for (const Side side : kSides) {
            add_spellings(sided(name, left, side), on_side(left, side), field, bones);
        }
    }
    return bones;
}

}  // namespace

std::string mmd_name(MmdBone bone) {
    const MmdBone left = left_of(bone);
    const auto side = side_of(bone);
    const std::string_view name = kMmdNames[index_of(left)];
    return side ? sided(name, left, *side) : std::string(name);
}

std::optional<MmdBone> mmd_bone_named(std::string_view bytes, std::size_t field) {
    static const BonesByBytes kOfKeys = bones_by_bytes(kMmdNameBytes);
    static const BonesByBytes kOfSwitches = bones_by_bytes(kMmdSwitchBytes);
    const BonesByBytes& bones = field == kMmdNameBytes ? kOfKeys : kOfSwitches;
    const auto found = bones.find(bytes.substr(0, bytes.find('\0')).substr(0, field));
    return found == bones.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace raks::motion
