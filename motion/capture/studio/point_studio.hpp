// Point studio: what cameras would see of a dancer's markers, with everything known.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/labels.hpp"
#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/observations.hpp"
#include "motion/capture/markers/tracks.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::capture {

/// Motion to be filmed. It is held before its first pose and behind its last.
struct StudioMotion {
    motion::Skeleton skeleton;            ///< of the dancer
    std::span<const motion::Pose> poses;  ///< at least one
    double frames_per_second = 60.0;      ///< > 0; pose 0 is at capture time 0
};

/// How well the cameras film. The values here are those of a clean scene.
struct StudioOptions {
    double frames_per_second = 30.0;  ///< of the cameras, > 0
    double noise = 1.0;               ///< standard deviation of a detection's coordinates, pixels
    double drop = 0.0;                ///< share of the visible markers that are not found, [0, 1]
    int clutter = 0;                  ///< false detections in each picture, around the dancer
    double merge = 3.0;               ///< detections of a colour nearer than this are one; pixels
    double clock_error = 0.0;         ///< each clock's offset is drawn within +- this; seconds
    double drift_ppm = 0.0;           ///< each clock's drift is drawn within +- this
    /// The capture's clock is that of the first camera, as a synchronisation by sound has it.
    bool first_clock_is_true = false;
    std::uint64_t seed = 1;  ///< of everything that is drawn
};

/// What was filmed, and the truth about it.
struct StudioTake {
    Observations seen;
    std::vector<MarkerLabel> labels;  ///< each marker where two cameras see it first
    std::vector<Clock> clocks;        ///< the true ones
    Tracks truth;  ///< every marker at the cameras' rate from capture time 0; views: that see it
};

/// Where the markers of a pose are; world, metres; by marker.
[[nodiscard]] std::vector<glm::dvec3> marker_places(const MarkerSet& markers,
                                                    const motion::Skeleton& skeleton,
                                                    const motion::WorldPose& world);

/// Films the motion: markers are projected, hidden by the body, blurred by noise, dropped, merged
/// and strewn with clutter. The same input gives the same bits. Threads: any. Real-time: no.
[[nodiscard]] StudioTake film_points(const StudioMotion& motion,
                                     const Rig& rig,
                                     const MarkerSet& markers,
                                     const StudioOptions& options);

/// Six cameras on a circle of 4 m around the dancer, in turn 1.55 and 2.25 m high, that look at
/// 0.95 m: f 600 pixels at 640 x 480, and in proportion at other widths.
/// `apart`: degrees between neighbours, at hand-held height (1.35 and 1.5 m), the middle of them
/// before the dancer; 0: evenly around. `cameras` * `apart` <= 360.
[[nodiscard]] Rig studio_rig(int cameras = 6,
                             int width = 640,
                             int height = 480,
                             double apart = 0.0);

/// The same circle with cameras as one has them, no two alike: f 950 pixels at 1280 wide, give or
/// take 4 %, principal points some pixels off the middle, lenses that bend by some per cent.
[[nodiscard]] Rig unlike_cameras_rig(int cameras = 6,
                                     int width = 1280,
                                     int height = 720,
                                     double apart = 0.0);

}  // namespace raks::capture
