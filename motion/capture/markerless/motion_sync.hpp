// Motion sync: the clocks of cameras from what moves before them, where nothing is heard.
#pragma once

#include <cstddef>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/keypoints/keypoints.hpp"
#include "motion/capture/markers/observations.hpp"

namespace raks::capture {

/// Something that one camera sees move.
struct MovingPoint {
    std::size_t kind = 0;    ///< a joint, or the colour of a marker: others of its kind may be it
    glm::dvec2 direction{};  ///< direction_of() its pixel
    glm::dvec2 velocity{};   ///< of the direction, a second
};

/// What one camera sees move, at any moment of its own clock: between two pictures, what lies
/// between them.
class MovingSights {
 public:
    /// The joints of a dancer.
    MovingSights(const KeypointFilm& film, const Lens& lens);
    /// Spots of markers: those of one colour in two pictures that lie nearest to each other, within
    /// `reach` pixels and each other's nearest, are taken to be one.
    MovingSights(const SeenFilm& film, const Lens& lens, double reach = 40.0);

    /// What moves at a moment of the camera's clock.
    [[nodiscard]] std::vector<MovingPoint> at(double camera_time) const;
    /// Its first and last moment; seconds.
    [[nodiscard]] double first_time() const noexcept { return first_; }
    [[nodiscard]] double last_time() const noexcept { return last_; }

 private:
    struct Step {
        double time = 0.0;
        double seconds = 0.0;  // until the next picture
        std::vector<MovingPoint> points;
    };
    std::vector<Step> steps_;
    double first_ = 0.0;
    double last_ = 0.0;
};

/// How clocks are refined.
struct MotionSyncOptions {
    double error = 3.0;         ///< distance from an epipolar line that counts half; pixels
    double reach = 0.1;         ///< how far a clock may be off; seconds. Ten take some seconds
    bool fits_drift = true;     ///< else the drift of the start stays
    std::size_t moments = 900;  ///< that are looked at, evenly over the take
};

/// Two offsets of a clock, at least 0.3 s apart, that fit nearly alike.
struct ClockRival {
    std::size_t camera = 0;
    double taken = 0.0;  ///< seconds; before it was refined
    double other = 0.0;  ///< likewise
};

/// What was found.
struct MotionSync {
    std::vector<Clock> clocks;       ///< by camera; that of the first stays as it was
    std::vector<double> deviation;   ///< by camera: standard deviation of its offset; seconds
    double distance = 0.0;           ///< median distance from epipolar lines; pixels
    std::size_t points = 0;          ///< pairs of sights that were used
    std::vector<ClockRival> rivals;  ///< of a dance that repeats itself within the reach
};

/// Moves clocks until what all cameras see lies on one another's epipolar lines, over all pairs of
/// cameras jointly: at first each camera by trying times within `reach`, then all together by
/// Gauss' and Newton's steps with Cauchy weights. The middle of the take is what an offset is told
/// best at; drift only counts where the take is long enough. Errors, one line: fewer than two
/// cameras; nothing moves in two of them at once. The same input gives the same bits. Threads: any.
/// Real-time: no (seconds).
[[nodiscard]] Expected<MotionSync> sync_by_motion(const Rig& rig,
                                                  const std::vector<MovingSights>& sights,
                                                  const std::vector<Clock>& start,
                                                  const MotionSyncOptions& options = {});

}  // namespace raks::capture
