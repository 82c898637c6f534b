// Joint finder: which joint of a clip is which bone, from names, tree and motion.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/humanoid_mapping.hpp"
#include "motion/skeleton/motion_clip.hpp"

namespace raks::motion {

/// The joints of a body, each with the reason why.
struct FoundJoints {
    HumanoidMapping mapping;
    std::array<std::string, kBoneCount> reasons;  ///< by bone, a few words; empty: not found
    std::array<double, kBoneCount>
        confidence{};                ///< by bone, 0 (not found) to 1 (said by a person)
    std::vector<std::string> notes;  ///< what was guessed or changed; one line each, printable
};

/// What a search ended with: what was found, also where it is not enough for a body.
struct JointSearch {
    FoundJoints found;
    std::optional<Error> refusal;  ///< why this is no body; none: it is one
};

/// Looks for the joints of a body. Three kinds of evidence are weighed:
/// - the labels of the clip (MotionClip::labels), where a person said so: always right;
/// - the body that the reader of a model knows (MotionClip::known), instead of all that follows;
/// - names (bones_by_name.hpp), checked against the tree;
/// - tree and motion (bones_by_shape.hpp), for what names leave open or where there are none.
/// Whatever it is called, the trunk is counted in its chain from hips to arms: its first joint that
/// bends is the spine, the last the upper chest (the chest of two), the middle one the chest. A
/// left that lies on the right, as feet point and knees bend, is swapped, and a note says so.
/// No axis, unit or rest pose is taken for granted. A body needs hips, and upper, lower and last
/// bone of each limb; refused are also two people in one clip and what goes on four legs.
/// Errors: labels that name no joint of the clip, two joints of one name, or a child above its
/// parent. Threads: workers. Real-time: no.
[[nodiscard]] Expected<JointSearch> search_joints(const MotionClip& clip);

/// The same for who needs a body. Errors: those of search_joints, and its refusal: one line with
/// what was found, what is missing and the joints of the clip.
[[nodiscard]] Expected<FoundJoints> find_joints(const MotionClip& clip);

/// Exchanges left and right: mapping, reasons and confidence.
void swap_sides(FoundJoints& found);

}  // namespace raks::motion
