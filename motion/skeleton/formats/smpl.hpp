// SMPL: turns of the joints of the SMPL body, as research writes its motion.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "base/expected.hpp"
#include "motion/skeleton/formats/motion_file.hpp"
#include "motion/skeleton/formats/npz.hpp"
#include "motion/skeleton/motion_clip.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

/// A joint of the SMPL body, in the order of its parameters. SMPL's files name no joints; the names
/// are those of VRM's bones that they are.
struct SmplJoint {
    std::string_view name;
    std::size_t parent = 0;  ///< a root is its own
    glm::dvec3 offset{};     ///< from the parent at rest; metres, y up, facing +z
};

/// The mean body's 24 joints (Loper et al. 2015): those of the published joint regressor and mean
/// shape, as in Stanford-TML/EDGE, vis.py (MIT). No body model file is needed.
[[nodiscard]] const std::array<SmplJoint, 24>& smpl_joints() noexcept;
/// Height of that body from soles to crown; metres, estimated.
inline constexpr double kSmplHeight = 1.77;

/// The arrays that SMPL files hold motion in.
inline constexpr std::array<std::string_view, 17> kSmplArrays = {"poses",
                                                                 "smpl_poses",
                                                                 "pose",
                                                                 "body_pose",
                                                                 "pose_body",
                                                                 "global_orient",
                                                                 "root_orient",
                                                                 "trans",
                                                                 "smpl_trans",
                                                                 "transl",
                                                                 "translation",
                                                                 "smpl_scaling",
                                                                 "mocap_framerate",
                                                                 "mocap_frame_rate",
                                                                 "fps",
                                                                 "framerate",
                                                                 "frame_rate"};

/// The motion in such arrays, as AMASS (SMPL, SMPL-H, SMPL-X), AIST++ and EDGE name and shape them:
/// frames x joints x 3 (or frames x 3 joints), axis times angle in radians. 22 to 24 joints, or 52
/// or 55, of which the fingers' and the face's are left out (warned). Joints rest in the T-pose of
/// the mean body, which is `options.height` tall; the betas of a person are passed over, said in a
/// warning. The translation is put at the pelvis: a constant way of some centimetres from SMPL's
/// own origin is left out. It is divided by `smpl_scaling`, as AIST++ means it.
///
/// Without a frame rate 60 a second are taken of AIST++, else 30 (warned).
/// Errors, without the file's name: no poses (the arrays that are there), other shapes (with the
/// shape), numbers that are not finite or too large. Threads: workers. Real-time:
/// no.
[[nodiscard]] Expected<MotionClip> smpl_clip(const NpzContent& content,
                                             const MotionReadOptions& options);

}  // namespace raks::motion
