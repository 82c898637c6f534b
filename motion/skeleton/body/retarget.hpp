// Retargeting: recorded motion of any body on the humanoid.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/body/body_finder.hpp"
#include "motion/skeleton/motion_clip.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

/// What a person says of a clip; the rest is found (body_finder.hpp).
struct RetargetOptions {
    BodyOptions body;  ///< joints, up, unit
    /// Height of the source's floor in metres; none: the 5th percentile of both toe tips' height.
    std::optional<double> floor_height;
};

/// A foot of the source at one frame, metres, over the source's floor (y = 0), not scaled to the
/// target's size: contacts and landings are measured on it.
struct SourceFoot {
    glm::dvec3 ankle{};    ///< the ankle's joint
    glm::dvec3 toe_tip{};  ///< end site of foot or toes; the joint itself where there is none
};

/// A clip on the target skeleton, one pose a frame.
struct RetargetedClip {
    double frames_per_second = 0.0;  ///< of the clip
    std::vector<Pose> poses;  ///< hips scaled by hips_scale and over a floor at y = 0; no contacts
    std::vector<std::array<SourceFoot, 2>> source_feet;  ///< by frame and Side
    double metres_per_unit = 1.0;                        ///< that was used
    double floor_height = 0.0;        ///< of the source, metres; subtracted from all heights
    double source_hips_height = 0.0;  ///< hips over the toe tips in the source's rest pose, metres
    double hips_scale = 1.0;          ///< target's hips height / source's
};

/// Retargets a clip to `target`. Both rest poses are T-poses, so local rotations are copied; those
/// of helper joints are composed into the bone below. `floor_height`: see RetargetOptions. Errors:
/// hips that are not above the toes in the T-pose. Threads: workers. Real-time: no.
[[nodiscard]] Expected<RetargetedClip> retarget(const StandingClip& standing,
                                                const Skeleton& target,
                                                std::optional<double> floor_height = std::nullopt);

/// The same of a clip with any rest pose, axes and unit. Errors: those of stand(), too.
[[nodiscard]] Expected<RetargetedClip> retarget(const MotionClip& clip,
                                                const Skeleton& target,
                                                const RetargetOptions& options = {});

}  // namespace raks::motion
