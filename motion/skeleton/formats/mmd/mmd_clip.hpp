// MMD clip: a dance of MikuMikuDance as a clip of the humanoid.
#pragma once

#include <string_view>

#include "base/expected.hpp"
#include "motion/skeleton/formats/mmd/mmd_body.hpp"
#include "motion/skeleton/formats/mmd/mmd_motion.hpp"
#include "motion/skeleton/motion_clip.hpp"

namespace raks::motion {

/// A motion on the standard body, frame by frame, as a clip that rests in our T-pose: 52 joints in
/// VRM's names, metres, 30 frames a second, and the expressions that its morphs stand for. The
/// hips are where the legs hang, and turn as `下半身`; the spine's joints share what lies between
/// that and `上半身2`. Errors: no bone of a body has a key. Memory: 2.9 kB a frame, whatever the
/// number of keys, at most 315 MB for the hour that read_vmd allows. Threads: workers. Real-time:
/// no.
[[nodiscard]] Expected<MotionClip> mmd_clip(const MmdMotion& motion,
                                            double arm_angle = kMmdArmAngle);

/// Reads the body's part of a VMD as a clip; `name` stands for the file in errors. Errors: those of
/// read_vmd and mmd_clip.
[[nodiscard]] Expected<MotionClip> parse_vmd(std::string_view bytes,
                                             std::string_view name,
                                             double arm_angle = kMmdArmAngle);

/// Turns of the humanoid's bones in the world, in the T-pose's frames: what a clip is made of, and
/// what a writer starts from.
struct MmdHumanoid {
    glm::dvec3 hips{};  ///< place, metres
    std::array<glm::dquat, kBoneCount> turns{};
};
/// The humanoid that the standard body stands for in a pose. `has_third`: whether `上半身3` has
/// keys, so that the spine's three joints are its three.
[[nodiscard]] MmdHumanoid humanoid_of(const MmdBody& body, const MmdPose& pose, bool has_third);

/// From the middle of the legs' roots up to the hips' joint; metres.
inline constexpr double kMmdHipsOverLegs = 0.0383;

}  // namespace raks::motion
