// Rough clocks: the clocks of a dancer's films from nothing but what moves in them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/keypoints/keypoints.hpp"
#include "motion/capture/markers/observations.hpp"

namespace raks::capture {

/// What is known of the films beforehand.
struct RoughClockHints {
    double within = 86400.0;  ///< seconds within which all cameras were started
    /// By film: the date of its recording, its begin or its end, seconds of a clock that all share
    /// (good to a second or two); nothing: not known. May be empty.
    std::vector<std::optional<double>> recorded{};
};

/// Clocks, and what is doubtful about them.
struct RoughClocks {
    std::vector<Clock> clocks;        ///< by film; the first is the capture's
    std::vector<std::string> doubts;  ///< one line each
    std::vector<std::string> notes;   ///< what the films' dates told; likewise
};

/// Clocks of a dancer's films without knowing anything of the cameras: what goes up in one upright
/// picture goes up in every other, so the vertical speeds of the joints are compared at all shifts.
/// Good to a picture or so; the confidence is the correlation, less that of the next best shift.
///
/// A dance that repeats itself fits at several shifts nearly alike. Then that one is taken which is
/// nearest to what the films say of when they were recorded, where that tells them apart; else the
/// best, with a doubt that names the others.
///
/// Errors, one line: films too short (5 s); one that mirrors another; one in slow motion; one in
/// which nothing moves as in the first. Threads: any. Real-time: no.
[[nodiscard]] Expected<RoughClocks> rough_clocks(const std::vector<KeypointFilm>& films,
                                                 const RoughClockHints& hints = {});

/// Whether one of two films mirrors what the other shows, by their clocks: the joints of the left
/// go up and down in one as those of the right do in the other. One line, which says what to do;
/// empty: none does, or it cannot be told. Two films that both mirror are not found.
[[nodiscard]] std::string why_mirrored(const std::vector<KeypointFilm>& films,
                                       const std::vector<Clock>& clocks);

}  // namespace raks::capture
