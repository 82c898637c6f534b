// Body finder: everything that retargeting must know about a clip, found from its motion.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/body/joint_finder.hpp"
#include "motion/skeleton/body/rest_pose.hpp"
#include "motion/skeleton/body/size_finder.hpp"
#include "motion/skeleton/body/stance_finder.hpp"
#include "motion/skeleton/body/up_finder.hpp"
#include "motion/skeleton/humanoid_mapping.hpp"
#include "motion/skeleton/motion_clip.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {

/// What a person says about a clip (beside its MotionClip::labels); then what the clip's format
/// knows for certain counts, and the rest is found.
struct BodyOptions {
    std::optional<glm::dvec3> up{};           ///< axis of the file that points up; unit
    std::optional<double> metres_per_unit{};  ///< > 0. (CMU takes 60_xx: 1.267, 61_xx: 1.17.)
    std::optional<double> height{};           ///< of the standing body, metres
};

/// A body in a clip: its joints, how it lies in their frames, and how the clip lies in the world.
struct FoundBody {
    FoundJoints joints;
    FoundUp up;
    RestPose rest;
    FoundSize size;
    FoundStance stance;

    /// Which joint of the clip is which bone.
    [[nodiscard]] const HumanoidMapping& mapping() const noexcept { return joints.mapping; }
    /// Lines to say: what was taken in doubt, and the option that sets it; those of `joints` apart.
    [[nodiscard]] std::vector<std::string> notes() const;
    /// Whether the unit is one of what they say.
    [[nodiscard]] bool is_unit_doubtful() const noexcept;
};

/// One line that says which unit was taken, and the options that set it. `reason`: why it.
[[nodiscard]] std::string unit_note(double metres_per_unit, const std::string& reason);

/// Finds the body of a clip: joints, then up from where its head and feet are (up_finder.hpp), the
/// rest pose from its bones (rest_pose.hpp) and the unit from its size (size_finder.hpp). Errors:
/// no frames, and those of find_joints. Cost: linear in joints; 300 frames, all of them only where
/// jumps must tell the unit. Threads: workers. Real-time: no.
[[nodiscard]] Expected<FoundBody> find_body(const MotionClip& clip,
                                            const BodyOptions& options = {});

/// A clip with y up and a rest pose that is our T-pose, in the file's unit.
struct StandingClip {
    MotionClip clip;
    FoundBody body;  ///< as it was found in the clip that was given
};

/// Finds the body of a clip and turns both, joints' frames and world: the same joints are at the
/// same places in a world with y up. A clip that is like that already keeps its bits. Errors: those
/// of find_body. Threads: workers. Real-time: no.
[[nodiscard]] Expected<StandingClip> stand(MotionClip clip, const BodyOptions& options = {});

/// The same of a body that was found before.
[[nodiscard]] MotionClip stood_up(MotionClip clip, const FoundBody& body);

}  // namespace raks::motion
