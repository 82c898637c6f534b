// Followed keypoints: from what a network saw in all cameras, and what a person corrected in it, to
// tracks of the dancer's joints.
#pragma once

#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markerless/keypoint_take.hpp"
#include "motion/capture/markers/edits.hpp"
#include "motion/capture/markers/tracks.hpp"

namespace raks::capture {

/// What became of a take.
struct FollowedKeypoints {
    KeypointTake shown;  ///< with the sides as views and time tell them; without the edits
    Tracks tracks;
    std::vector<std::string> lines;  ///< what was put right and passed over, one line each
};

/// Follows the joints of a take: other people are passed over, exchanged sides put right, then what
/// a person says is done in its order, joints that jump are passed over, and the rest is placed
/// (keypoint_tracks). Edits are about what it shows: `exchange` changes the sides that were found.
/// Whole views that a person hides are left out from the start. Errors, one line: as of
/// check_keypoint_edits. Threads: any. Real-time: no.
[[nodiscard]] Expected<FollowedKeypoints> follow_keypoints(const Rig& rig,
                                                           const KeypointTake& take,
                                                           const std::vector<Edit>& edits);

/// Does what edits say to a take whose cameras are those of the rig. Frames that it lacks are
/// passed over.
void apply_keypoint_edits(const std::vector<Edit>& edits, const Rig& rig, KeypointTake& take);

/// Errors, one line that names the edit by its number: a kind that is of markers alone, a joint or
/// camera that there is not, a pixel outside of the picture.
[[nodiscard]] Expected<void> check_keypoint_edits(const std::vector<Edit>& edits, const Rig& rig);

}  // namespace raks::capture
