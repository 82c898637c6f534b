// A dance of known points: somebody who turns, swings the arms and lifts the feet, filmed in the
// studio.
#pragma once

#include <cmath>
#include <vector>

#include "motion/capture/studio/point_studio.hpp"
#include "motion/capture/tracking/marker_tracker.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::test {

/// That dance at 60 frames a second.
inline std::vector<motion::Pose> swinging(double seconds) {
    std::vector<motion::Pose> poses;
    for (int i = 0; i < static_cast<int>(60.0 * seconds); ++i) {
        const float phase = 6.2831853F * static_cast<float>(i) / 60.0F;
        const auto about = [&](float angle, glm::vec3 axis) { return glm::angleAxis(angle, axis); };
        motion::Pose pose;
        pose.hips_position = {0.3F * std::sin(0.3F * phase), 0.9F, 0.2F * std::cos(0.3F * phase)};
        pose.rotation(motion::Bone::hips) = about(0.4F * phase, {0, 1, 0});
        pose.rotation(motion::Bone::left_upper_arm) =
            about(-1.1F + 0.4F * std::sin(phase), {0, 0, 1});
        pose.rotation(motion::Bone::right_upper_arm) =
            about(1.1F - 0.4F * std::sin(phase), {0, 0, 1});
        pose.rotation(motion::Bone::left_lower_arm) =
            about(-0.8F - 0.4F * std::sin(phase), {0, 1, 0});
        pose.rotation(motion::Bone::left_upper_leg) =
            about(-0.3F + 0.3F * std::sin(phase), {1, 0, 0});
        pose.rotation(motion::Bone::left_lower_leg) =
            about(0.4F - 0.3F * std::sin(phase), {1, 0, 0});
        poses.push_back(pose);
    }
    return poses;
}

/// The dance as cameras of a rig see it.
inline capture::StudioTake film_swing(const std::vector<motion::Pose>& poses,
                                      const capture::Rig& rig,
                                      const capture::MarkerSet& markers,
                                      const capture::StudioOptions& options) {
    return capture::film_points({motion::mannequin_skeleton(), poses, 60.0}, rig, markers, options);
}

/// A take of it and all that a tracker needs.
struct FilmedSwing {
    FilmedSwing(double seconds,
                const capture::StudioOptions& options,
                capture::MarkerColours colours = capture::MarkerColours::unique,
                int cameras = 6)
        : poses(swinging(seconds)),
          rig(capture::studio_rig(cameras)),
          markers(capture::default_markers(colours)),
          take(film_swing(poses, rig, markers, options)) {}

    [[nodiscard]] Expected<capture::TrackerStages> track(
        const std::vector<capture::Edit>& edits = {}) const {
        capture::TrackerOptions options;
        options.frames_per_second = take.truth.frames_per_second;
        options.first_time = 0.0;
        return capture::track_markers({rig, markers, take.seen, clocks, take.labels, edits},
                                      options);
    }

    std::vector<motion::Pose> poses;
    capture::Rig rig;
    capture::MarkerSet markers;
    capture::StudioTake take;
    std::vector<capture::Clock> clocks = take.clocks;
};

}  // namespace raks::test
