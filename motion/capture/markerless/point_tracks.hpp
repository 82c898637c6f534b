// Point tracks: anybody's points as tracks that a body can be solved from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/keypoints/point_names.hpp"
#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/tracks.hpp"
#include "motion/skeleton/point_clip.hpp"

namespace raks::capture {

/// What a file of points does not say, or says wrongly.
struct PointReading {
    std::optional<double> metres_per_unit{};  ///< instead of the file's
    std::optional<char> up{};                 ///< 'x', 'y' or 'z': instead of the file's
    PointNameMap names{};                     ///< what a person says of single names
    std::optional<MarkerSet> markers{};       ///< that the points are; none: joints by their names
};

/// Points, as tracks of a body over a floor at y = 0.
struct PointTracks {
    Tracks tracks;
    MarkerSet markers;
    std::vector<std::string> notes;  ///< one line each: what was taken for what, and passed over
};

/// Takes the points of a clip as markers: of `reading.markers` by name, else of the shipped set
/// where six or more have its names, else joints that their names mean ("LWrist", "right_knee",
/// "LBigToe"). Units: as told, else the file's, else whatever gives a dancer of 0.8 to 2.5 m. Up:
/// as told, else the file's, else the axis along which heads are over feet. The floor is where the
/// lowest points of the feet are. Errors, one line: names that say nothing (what is there, and what
/// to do); fewer than six points; a unit that gives a dancer of 1,700 m (with the one that would
/// do); points of one place. Threads: any. Real-time: no.
[[nodiscard]] Expected<PointTracks> point_tracks(const motion::PointClip& clip,
                                                 const PointReading& reading);

}  // namespace raks::capture
