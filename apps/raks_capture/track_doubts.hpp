// Track doubts: what of a whole take looks wrong once its markers were followed.
#pragma once

#include <string>
#include <vector>

#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/tracks.hpp"

namespace raks::apps {

/// One line each, with what to do: markers that are lost most of the time (never labelled in two
/// cameras, a colour that does not show), and a world that is upside down or on its side, by the
/// dancer's head and feet.
[[nodiscard]] std::vector<std::string> track_doubts(const capture::Tracks& tracks,
                                                    const capture::MarkerSet& markers);

/// What markers of one colour, or of two, do to a body that is followed by angles, in one line;
/// empty: they have more.
[[nodiscard]] std::string colour_doubt(const capture::MarkerSet& markers);

}  // namespace raks::apps
