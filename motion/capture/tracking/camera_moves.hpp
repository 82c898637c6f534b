// Camera moves: a camera that was moved while it filmed no longer sees the markers where the others
// have them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/markers/tracks.hpp"
#include "motion/capture/tracking/frame_views.hpp"
#include "motion/capture/tracking/track_run.hpp"

namespace raks::capture {

/// A stretch in which a camera does not see the markers where the others have them: it was moved,
/// or its clock jumped.
struct CameraMove {
    std::string camera;     ///< its name
    std::size_t first = 0;  ///< frame of the tracks
    std::size_t last = 0;   ///< frame of the tracks, included
    /// Median distance of its spots from where the markers should be, of those that are near enough
    /// to be theirs; pixels. A camera that was moved far has hardly any.
    double offset = 0.0;

    friend bool operator==(const CameraMove&, const CameraMove&) = default;
};

/// The camera that disagrees most, with all its stretches of 1.5 s or longer, in order; none: all
/// agree. In windows of half a second its spots are compared with the markers of `tracked` (frames
/// x markers, by run_tracker): it disagrees where fewer than half as many of them lie at a marker
/// as in the other cameras, or where most are off in one direction by more than 3 sigma; a window
/// goes by the majority of the five around it. A clock that is a little off does not count, since
/// then spots are off in all directions. `views` with all of their spots, used or not.
[[nodiscard]] std::vector<CameraMove> find_moved_camera(const TrackRunInput& input,
                                                        FrameViews& views,
                                                        const std::vector<TrackedMarker>& tracked);

/// Moves as a table (`moved.tsv`): camera, first, last, offset. Numbers read back to the same bits.
[[nodiscard]] std::string moves_text(const std::vector<CameraMove>& moves);
/// Reads it. Errors, one line with its number: no such head, words that are no numbers, a stretch
/// that ends before it begins, more than 10,000 stretches.
[[nodiscard]] Expected<std::vector<CameraMove>> read_moves(std::string_view text,
                                                           const std::string& file);

/// What a person should know of a move, and do about it, in one line; times by the tracks.
[[nodiscard]] std::string words_of_move(const CameraMove& move, const Tracks& tracks);

}  // namespace raks::capture
