// Clip variants: one motion as programs write it, with other names, rest poses, axes and units.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "motion/skeleton/motion_clip.hpp"
#include "tests/motion/skeleton/body/naming_schemes.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {

/// What a body does when no joint is rotated.
enum class RestVariant {
    t_pose,
    a_pose_30,  ///< arms 30 degrees down
    a_pose_45,
    n_pose,       ///< arms straight down
    sitting,      ///< thighs ahead, arms down
    along_x,      ///< every bone along +x, as LAFAN1 and Rokoko write
    first_frame,  ///< as in the first frame of the motion
};
inline constexpr std::array<RestVariant, 7> kRestVariants = {RestVariant::t_pose,
                                                             RestVariant::a_pose_30,
                                                             RestVariant::a_pose_45,
                                                             RestVariant::n_pose,
                                                             RestVariant::sitting,
                                                             RestVariant::along_x,
                                                             RestVariant::first_frame};

/// Axes that point up in files.
inline constexpr std::array<glm::dvec3, 4> kUpVariants = {
    {{0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, 0}}};

/// Metres of the units that files are written in: metre, decimetre, centimetre, millimetre, inch,
/// foot.
inline constexpr std::array<double, 6> kUnitVariants = {1.0, 0.1, 0.01, 0.001, 0.0254, 0.3048};

/// Its name for messages.
[[nodiscard]] std::string_view name_of(RestVariant rest);

/// Our own dance of tests/data/bvh: 22 joints in CMU's names and order, T-pose, y up, centimetres,
/// 60 frames of 30 Hz.
[[nodiscard]] MotionClip own_dance();

/// The same motion of own_dance(), written otherwise: every joint is at the same place.
[[nodiscard]] MotionClip renamed(MotionClip clip, const body_test::NamingScheme& scheme);
[[nodiscard]] MotionClip with_rest(MotionClip clip, RestVariant rest);
/// How a file comes by another axis that points up.
enum class UpStyle {
    root_only,  ///< the root's rotation is turned, the offsets are not
    whole_file  ///< the offsets, too, as programs that work with such axes write
};
[[nodiscard]] MotionClip with_up(MotionClip clip, const glm::dvec3& up, UpStyle style);
[[nodiscard]] MotionClip in_unit(MotionClip clip, double metres);

/// The clip as a BVH file: root with places, rotations in degrees, all numbers with full precision.
[[nodiscard]] std::string bvh_text(const MotionClip& clip);

/// The same motion with joint j's frame turned by `frames[j]`: world rotations get it as a factor
/// on their right.
[[nodiscard]] MotionClip with_frames(MotionClip clip, const std::vector<glm::dquat>& frames);

}  // namespace raks::motion
