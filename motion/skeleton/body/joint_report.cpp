#include "motion/skeleton/body/joint_report.hpp"

#include "base/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "base/printable.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kLongestName = 40;  // bytes of a joint's name in a message
constexpr std::size_t kMostNamesShown = 12;

/// Whether all joints hang on one another.
bool is_one_chain(const MotionClip& clip) {
    std::vector<int> children(clip.joints.size(), 0);
    for (std::size_t joint = 1; joint < clip.joints.size(); ++joint) {
        ++children[clip.joints[joint].parent];
    }
    return std::all_of(children.begin(), children.end(), [](int count) { return count < 2; });
}

/// Fingers that nobody needs would hide in a map what is missing.
bool is_finger(Bone bone) {
    const std::size_t left = std::min(index_of(bone), index_of(mirrored(bone)));
    return mirrored(bone) != bone && left > index_of(Bone::left_hand);
}

/// Whether a map can name a joint: no other has its name, and it is printable.
bool is_sayable(const MotionClip& clip, std::size_t joint) {
    const std::string& name = clip.joints[joint].name;
    const auto is_alike = [&](const ClipJoint& other) { return other.name == name; };
    return !name.empty() && printable(name, name.size()) == name &&
           std::count_if(clip.joints.begin(), clip.joints.end(), is_alike) == 1;
}

}  // namespace

std::string shown_joint(const MotionClip& clip, std::size_t joint) {
    const std::string& name = clip.joints[joint].name;
    return name.empty() ? fmt::format("(joint {})", joint) : printable(name, kLongestName);
}

std::string shown_joints(const MotionClip& clip) {
    std::string text;
    for (std::size_t joint = 0; joint < clip.joints.size() && joint < kMostNamesShown; ++joint) {
        text += (joint == 0 ? "" : ", ") + shown_joint(clip, joint);
    }
    return clip.joints.size() > kMostNamesShown
               ? text + fmt::format(", ... ({} in all)", clip.joints.size())
               : text;
}

std::optional<Error> missing_joints(const MotionClip& clip, const HumanoidMapping& mapping) {
    std::string here;
    std::string missing;
    const auto need = [&](std::initializer_list<Bone> bones, std::string_view what) {
        const bool has_all = std::all_of(bones.begin(), bones.end(), [&](Bone bone) {
            return mapping.joint(bone) && mapping.joint(mirrored(bone));
        });
        std::string& list = has_all ? here : missing;
        list += (list.empty() ? "" : ", ") + std::string(what);
        return has_all;
    };
    need({Bone::hips}, "hips");
    const bool has_legs =
        need({Bone::left_upper_leg, Bone::left_lower_leg, Bone::left_foot}, "legs");
    if (clip.known) {  // a model's arms may end without hands
        need({Bone::left_upper_arm, Bone::left_lower_arm}, "arms");
    } else {
        need({Bone::left_upper_arm, Bone::left_lower_arm, Bone::left_hand}, "arms");
    }
    if (missing.empty()) {
        return std::nullopt;
    }
    if (clip.joints.size() > 2 && is_one_chain(clip)) {
        return Error{fmt::format("no humanoid: its {} joints are all one chain: {}",
                                 clip.joints.size(),
                                 shown_joints(clip))};
    }
    return Error{fmt::format(
        "no humanoid: {} not found{} among {} joint{}: {}; {}",
        missing,
        here.empty() ? "" : fmt::format(" (found: {})", here),
        clip.joints.size(),
        clip.joints.size() == 1 ? "" : "s",
        shown_joints(clip),
        has_legs ? "half a body teaches no dance; if it has arms, say so with --joint or --joints"
                 : "--joint or --joints says which joint is which bone, and raks stick CLIP "
                   "--write-joints X.toml writes a map to start from")};
}

std::string joint_map_text(const MotionClip& clip, const HumanoidMapping& mapping) {
    std::string text =
        "# Which joint of the clip is which bone. An empty name is left to be found.\n"
        "format = \"raks-joint-map\"\nversion = 1\n\n[joints]\n";
    for (int i = 0; i < kBoneCount; ++i) {
        const Bone bone = static_cast<Bone>(i);
        const auto joint = mapping.joint(bone);
        if (joint || !is_finger(bone)) {
            const bool can_be_said = joint && is_sayable(clip, *joint);
            text += fmt::format("{} = {}{}\n",
                                kBoneNames[index_of(bone)],
                                toml_quoted(can_be_said ? clip.joints[*joint].name : std::string()),
                                joint && !can_be_said
                                    ? fmt::format("  # found; its name is not its own: {}",
                                                  shown_joint(clip, *joint))
                                    : "");
        }
    }
    text += "\n# Joints of the clip, parents first:\n";
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        text += fmt::format("# {}\n", shown_joint(clip, joint));
    }
    return text;
}

}  // namespace raks::motion
