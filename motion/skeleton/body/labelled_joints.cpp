#include "motion/skeleton/body/labelled_joints.hpp"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <vector>

#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "motion/skeleton/body/joint_report.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kLongest = 40;  // bytes of a name in a message

Expected<std::size_t> joint_called(const MotionClip& clip, const JointLabel& label) {
    const std::string_view bone = kBoneNames[index_of(label.bone)];
    std::optional<std::size_t> found;
    std::vector<std::string_view> names;
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        names.push_back(clip.joints[joint].name);
        if (clip.joints[joint].name != label.joint) {
            continue;
        }
        if (found) {
            return fail(fmt::format(
                "{}: two joints are called \"{}\"", bone, printable(label.joint, kLongest)));
        }
        found = joint;
    }
    if (found) {
        return *found;
    }
    const std::string_view nearest = nearest_name(label.joint, names);
    return fail(fmt::format(
        "{}: the clip has no joint \"{}\"; {}",
        bone,
        printable(label.joint, kLongest),
        nearest.empty() ? "it has " + shown_joints(clip)
                        : fmt::format("did you mean \"{}\"?", printable(nearest, kLongest))));
}

}  // namespace

Expected<HumanoidMapping> labelled_joints(const MotionClip& clip, const ParentTree& tree) {
    HumanoidMapping mapping;
    for (const JointLabel& label : clip.labels.joints) {
        const Expected<std::size_t> joint = joint_called(clip, label);
        if (!joint) {
            return fail(Error(joint.error()).in(clip.labels.source));
        }
        mapping.joints[index_of(label.bone)] = *joint;
    }
    for (const JointLabel& label : clip.labels.joints) {
        const std::optional<Bone> above = mapped_parent(mapping, label.bone);
        if (!above) {
            continue;
        }
        const std::size_t joint = *mapping.joint(label.bone);
        const std::size_t carrier = *mapping.joint(*above);
        if (!tree.is_below(static_cast<int>(joint), static_cast<int>(carrier))) {
            return fail(fmt::format("{}: {} \"{}\" does not hang on {} \"{}\"",
                                    clip.labels.source,
                                    kBoneNames[index_of(label.bone)],
                                    shown_joint(clip, joint),
                                    kBoneNames[index_of(*above)],
                                    shown_joint(clip, carrier)));
        }
    }
    return mapping;
}

}  // namespace raks::motion
