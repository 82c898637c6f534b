// Keypoint doubts: whether the pictures of a camera show what a dance can be got from.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "motion/capture/keypoints/keypoints.hpp"

namespace raks::capture {

/// A joint whose visibility is at least this is seen.
inline constexpr double kSeenVisibility = 0.5;

/// What the pictures of a camera show.
struct KeypointShares {
    std::size_t pictures = 0;
    double somebody = 0.0;    ///< of the pictures; [0, 1]
    double whole_body = 0.0;  ///< likewise: a hip, a knee and an ankle are seen, and all lie in it
    std::size_t looked = 0;   ///< pictures that were searched for others
    std::size_t several = 0;  ///< those of them that show two people or more
};
/// Counts them.
[[nodiscard]] KeypointShares keypoint_shares(const KeypointFilm& film);

/// Whether a dance can be got from what a camera sees: somebody, and the whole of the body, most of
/// the time. Empty: yes. Else one line why not, without the camera's name.
[[nodiscard]] std::string why_no_dance(const KeypointShares& shares);

/// What is doubtful although a dance can be got: nobody or half a body for long, several people.
/// One line each, without the camera's name.
[[nodiscard]] std::vector<std::string> keypoint_doubts(const KeypointShares& shares);

}  // namespace raks::capture
