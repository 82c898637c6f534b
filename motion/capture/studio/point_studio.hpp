// Point studio: what cameras would see of a dancer's markers, with everything known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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
    std::vector<double> rates{};  ///< of each camera, where they differ; empty: frames_per_second
    /// When each camera is bumped, and looks elsewhere from then on; its own seconds; none: never.
    std::vector<std::optional<double>> bumps{};
    double rolling_shutter = 0.0;  ///< seconds between the first row of a picture and the last one
    int people = 1;                ///< 2: somebody without markers walks through behind the dancer
    /// The capture's clock is that of the first camera, as a synchronisation by sound has it.
    bool first_clock_is_true = false;
    std::uint64_t seed = 1;  ///< of everything that is drawn

    /// Pictures a second of a camera.
    [[nodiscard]] double rate_of(std::size_t camera) const noexcept {
        return camera < rates.size() ? rates[camera] : frames_per_second;
    }
    /// When a camera is bumped.
    [[nodiscard]] std::optional<double> bump_of(std::size_t camera) const noexcept {
        return camera < bumps.size() ? bumps[camera] : std::nullopt;
    }
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

/// A camera after somebody bumped into it: it looks two degrees aside, and one down.
[[nodiscard]] Camera bumped(const Camera& camera);

/// Who walks through behind the dancer at a moment of the capture, from one side to the other and
/// back in ten seconds, in the dancer's own steps of a while ago.
[[nodiscard]] motion::Pose passer_by(const StudioMotion& motion, double time);

/// Pictures that a camera takes of a motion.
[[nodiscard]] std::size_t picture_count(const StudioMotion& motion, double rate) noexcept;

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
