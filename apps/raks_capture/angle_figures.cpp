#include "apps/raks_capture/angle_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "apps/terminal/say.hpp"
#include "motion/capture/angles/angle_errors.hpp"
#include "motion/capture/angles/unsure_joints.hpp"
#include "motion/skeleton/formats/motion_file.hpp"

namespace raks::apps {
namespace {

constexpr double kMillimetresAMetre = 1000.0;

// The poses of a dance of the mannequin, as they are: no floor is looked for, nothing is scaled.
Expected<std::vector<motion::Pose>> poses_of(const motion::MotionClip& clip) {
    std::vector<motion::Pose> poses(clip.frame_count);
    for (std::size_t bone = 0; bone < motion::kBoneCount; ++bone) {
        const auto joint = std::find_if(
            clip.joints.begin(), clip.joints.end(), [bone](const motion::ClipJoint& one) {
                return one.name == motion::kBoneNames[bone];
            });
        if (joint == clip.joints.end()) {
            return fail(fmt::format("has no joint {}; is it a dance that raks wrote?",
                                    motion::kBoneNames[bone]));
        }
        const auto index = static_cast<std::size_t>(joint - clip.joints.begin());
        for (std::size_t frame = 0; frame < poses.size(); ++frame) {
            poses[frame].local_rotations[bone] = glm::quat(clip.rotation(frame, index));
            if (bone == 0) {
                poses[frame].hips_position = glm::vec3(clip.position(frame, index));
            }
        }
    }
    return poses;
}

}  // namespace

std::vector<std::string> angle_lines(const FollowedMarkers& followed,
                                     const capture::BodyModel& model) {
    constexpr double kDegrees = 180.0 / M_PI;
    const capture::AngleTrack& track = *followed.angles;
    const auto sureness = capture::joint_sureness(track, model);
    std::vector<double> medians;
    for (const capture::JointSureness& joint : sureness) {
        medians.push_back(joint.median);
    }
    const auto least =
        std::max_element(sureness.begin(), sureness.end(), [](const auto& one, const auto& other) {
            return one.median < other.median;
        });
    std::sort(medians.begin(), medians.end());
    std::vector<std::string> lines = {
        fmt::format("a body of {:.2f} m; joints are known to {:.1f} degrees (median), {} to {:.1f}",
                    capture::kMannequinHeight * followed.size.whole,
                    kDegrees * medians[medians.size() / 2],
                    least->joint,
                    kDegrees * least->median)};
    std::size_t first = 0;
    for (std::size_t frame = 0; frame <= track.is_lost.size(); ++frame) {
        if (frame < track.is_lost.size() && track.is_lost[frame]) {
            continue;
        }
        if (frame > first) {
            lines.push_back(fmt::format("the body is lost from {:.2f} to {:.2f} s",
                                        track.time_of(first),
                                        track.time_of(frame - 1)));
        }
        first = frame + 1;
    }
    constexpr std::size_t kMostLines = 8;
    if (lines.size() > kMostLines) {
        const std::size_t more = lines.size() - kMostLines;
        lines.resize(kMostLines);
        lines.push_back(fmt::format("and in {} stretches more", more));
    }
    return lines;
}

Expected<void> print_angle_errors(const FollowedMarkers& followed,
                                  const capture::BodyModel& model,
                                  const std::filesystem::path& truth) {
    const auto clip = motion::read_skeleton_motion(truth / "dance.bvh", {});
    if (!clip) {
        return fail(clip.error());
    }
    const auto poses = poses_of(*clip);
    if (!poses) {
        return fail(Error(poses.error()).in((truth / "dance.bvh").string()));
    }
    const capture::AngleErrors errors = capture::angle_errors(
        *followed.angles, model, followed.shape, *poses, clip->frames_per_second);
    std::string text = fmt::format(
        "joints       mean {:5.2f} mm, {:.2f} degrees (root {:.2f}, balls {:.2f}, hinges {:.2f}), "
        "{} of {} frames lost\n",
        kMillimetresAMetre * errors.mean,
        errors.angle(),
        errors.root,
        errors.balls,
        errors.hinges,
        errors.lost,
        errors.frames);
    for (std::size_t i = 0; i < errors.limbs.size(); ++i) {
        text += fmt::format("{:12} mean {:5.2f} mm, at worst {:.0f}\n",
                            capture::kLimbNames[i],
                            kMillimetresAMetre * errors.limbs[i],
                            kMillimetresAMetre * errors.worst_limbs[i]);
    }
    text += "by joint     ";
    for (std::size_t i = 0; i < errors.joints.size(); ++i) {
        text += fmt::format("{}{} {:.1f}",
                            i > 0 ? ", " : "",
                            motion::kBoneNames[index_of(capture::kComparedJoints[i])],
                            kMillimetresAMetre * errors.joints[i]);
    }
    print_text(text + " mm\n");
    return {};
}

}  // namespace raks::apps
