// Track errors: how far tracks are from the truth, where it is known.
#pragma once

#include <cstddef>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/markers/tracks.hpp"

namespace raks::capture {

/// Errors of tracks, over all frames of all markers.
struct TrackErrors {
    double mean = 0.0;          ///< of the places that are at most 100 mm off; metres
    double aligned_mean = 0.0;  ///< of the same, after the turn and the move of them all that fit
                                ///< best: a board on the floor says only about where the world lies
    std::size_t places = 0;     ///< frames times markers
    std::size_t wrong = 0;      ///< places that are more than 100 mm off, or lost
    std::size_t unflagged = 0;  ///< wrong places of the others that no flag names

    /// Share of the places that are wrong.
    [[nodiscard]] double wrong_share() const noexcept {
        return places > 0 ? static_cast<double>(wrong) / static_cast<double>(places) : 0.0;
    }
    /// Share of the wrong places that a flag names; 1 where none is wrong.
    [[nodiscard]] double flagged_share() const noexcept {
        return wrong > 0 ? 1.0 - static_cast<double>(unflagged) / static_cast<double>(wrong) : 1.0;
    }
};

/// How far each place is from the truth, at the moments of the tracks: the truth is interpolated.
/// Result: frames x markers, row-major, metres; infinite where the marker is lost, NaN at moments
/// that the truth has not. Errors: a marker that the truth has not.
[[nodiscard]] Expected<std::vector<double>> distances_from(const Tracks& tracks,
                                                           const Tracks& truth);

/// Compares tracks with the truth, at the moments of the tracks, as distances_from; what lies
/// outside of the truth is passed over. Errors: a marker that the truth has not.
[[nodiscard]] Expected<TrackErrors> track_errors(const Tracks& tracks, const Tracks& truth);

}  // namespace raks::capture
