// Keypoint tracks: the places of a dancer's joints, from what all cameras saw of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markerless/keypoint_take.hpp"
#include "motion/capture/markers/tracks.hpp"

namespace raks::capture {

/// A less sure view of a joint does not count. A network guesses hidden joints well: on rendered
/// dancers elbows and wrists of a visibility of 0.05 to 0.3 are off by 10 to 23 px (median) where
/// sure ones are by 5 to 8, much less than a hand that nobody places; their weight in a place is
/// their visibility.
inline constexpr double kLeastVisibility = 0.05;

/// What became of one joint at one frame.
/// Away: the whole body is where the dancer cannot be.
enum class KeypointOutcome : std::uint8_t { placed, unseen, contradicts, away };

/// Where its views have it.
struct PlacedKeypoint {
    KeypointOutcome outcome = KeypointOutcome::unseen;
    MarkerPlace place{};             ///< where it is placed
    std::vector<std::size_t> odd{};  ///< cameras that are beyond what a network's error can be from
                                     ///< where the others have it
};

/// Places one joint at a frame. `errors`: by camera, usual_error().
[[nodiscard]] PlacedKeypoint place_keypoint(const Rig& rig,
                                            const KeypointTake& take,
                                            std::size_t frame,
                                            BodyPoint point,
                                            const std::vector<double>& errors);

/// Places of all followed points (keypoint_markers.hpp) at the frames of a take: the views of each
/// weighted by their visibility. A view whose distance from the others is beyond what a network's
/// error can be does not count; with two cameras the place is then lost. Where the whole body jumps
/// farther than anybody can, as when a network takes another person for the dancer, all its places
/// are lost until it is back, or 3 s later, when it is believed. Flags: lost for 0.2 s or more;
/// residual, where views contradict one another for 0.1 s or more; person, at the nose, where the
/// body had jumped.
/// `errors`: by camera, usual_error(). Threads: any. Real-time: no.
[[nodiscard]] Tracks keypoint_tracks(const Rig& rig,
                                     const KeypointTake& take,
                                     const std::vector<double>& errors);

/// The same tracks after a Gaussian in time of that standard deviation, seconds; places that are
/// lost stay so.
[[nodiscard]] Tracks smoothed_tracks(const Tracks& tracks, double deviation);

}  // namespace raks::capture
