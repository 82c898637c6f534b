// Pose tracker: the joints of the dancer in one picture after the other.
#pragma once

#include <cstddef>
#include <optional>

#include "motion/capture/keypoints/keypoints.hpp"
#include "motion/capture/keypoints/pose_network.hpp"
#include "motion/capture/pictures/chroma.hpp"

namespace raks::capture {

/// Follows one person through the pictures of a camera: the joints of one picture say where to look
/// in the next; where nobody is found there, in the whole picture. From time to time the whole
/// picture is looked at all the same, for other people, and for the dancer where something else was
/// followed. Threads: one. Real-time: no.
class PoseTracker {
 public:
    /// Takes over the networks.
    explicit PoseTracker(PoseNetwork network) : network_(std::move(network)) {}

    /// The dancer in the next picture; number and time are the caller's.
    [[nodiscard]] KeypointPicture follow(const PictureView& picture);

 private:
    [[nodiscard]] std::optional<FoundJoints> start_anew(const PictureView& picture,
                                                        KeypointPicture& seen);

    PoseNetwork network_;
    std::optional<PoseSquare> square_;  // where to look
    std::optional<PoseSquare> last_;    // where somebody was last
    std::size_t pictures_ = 0;          // since the whole picture was looked at
};

}  // namespace raks::capture
