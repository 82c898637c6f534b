// Joint finder: which joint of a clip is which bone, from names, tree and motion.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/body/joint_labels.hpp"
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

/// Looks for the joints of a body. A body needs hips, and upper, lower and last bone of each limb.
/// Errors: labels that name no joint of the clip, two joints of one name, or a child above its
/// parent. Threads: workers. Real-time: no.
[[nodiscard]] Expected<JointSearch> search_joints(const MotionClip& clip,
                                                  const JointLabels& labels = {});

/// The same for who needs a body. Errors: those of search_joints, and its refusal: one line with
/// what was found, what is missing and the joints of the clip.
[[nodiscard]] Expected<FoundJoints> find_joints(const MotionClip& clip,
                                                const JointLabels& labels = {});

/// Exchanges left and right: mapping, reasons and confidence.
void swap_sides(FoundJoints& found);

/// A joint map of what was found, to be mended by hand: bones that are missing stand in it with an
/// empty name, the joints of the clip in comments below. TOML text that read_joint_map reads.
[[nodiscard]] std::string joint_map_text(const MotionClip& clip, const FoundJoints& found);

}  // namespace raks::motion
