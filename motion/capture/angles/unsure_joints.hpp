// Unsure joints: how well the angles of each joint are known, by the particles' spread.
#pragma once

#include <string>
#include <vector>

#include "motion/capture/angles/angle_track.hpp"
#include "motion/capture/markers/tracks.hpp"
#include "motion/capture/solving/body_model.hpp"

namespace raks::capture {

/// How well a joint is known over a take. Frames in which the body is lost do not count.
struct JointSureness {
    std::string joint;
    double median = 0.0;  ///< standard deviation of the variable that is least sure; radians
    double high = 0.0;    ///< that of one frame in twenty is larger; radians
    double unsure = 0.0;  ///< share of the frames in which it is over kUnsureDeviation
};

/// A joint is doubtful above this deviation, radians (20 degrees).
inline constexpr double kUnsureDeviation = 0.349;

/// That of all joints, in the order of the model.
[[nodiscard]] std::vector<JointSureness> joint_sureness(const AngleTrack& track,
                                                        const BodyModel& model);

/// Adds a flag where a joint is doubtful for 0.1 s or longer: of the first marker on its bones, or
/// else on what hangs on them. `marker_bones`: by marker of the tracks.
void flag_unsure_joints(const AngleTrack& track,
                        const BodyModel& model,
                        const std::vector<motion::Bone>& marker_bones,
                        Tracks& tracks);

}  // namespace raks::capture
