// Track doubts: what of a whole take looks wrong once its markers were followed.
#pragma once

#include <string>
#include <vector>

#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/observations.hpp"
#include "motion/capture/markers/tracks.hpp"

namespace raks::apps {

/// One line each, with what to do: markers that are lost most of the time (never labelled in two
/// cameras, a colour that does not show), and a world that is upside down or on its side, by the
/// dancer's head and feet.
[[nodiscard]] std::vector<std::string> track_doubts(const capture::Tracks& tracks,
                                                    const capture::MarkerSet& markers);

/// What is doubtful about what the cameras saw, one line each: a film that ends long before the
/// others, and lenses that fold over where markers were seen.
[[nodiscard]] std::vector<std::string> film_doubts(const capture::Rig& rig,
                                                   const capture::Observations& seen,
                                                   const std::vector<capture::Clock>& clocks);

/// The share of places that are lost, [0, 1]; 0 where there are none.
[[nodiscard]] double lost_share(const capture::Tracks& tracks);

/// That so much is lost (over a fifth), or lost or filled in (over a half), that no dance can be
/// learnt from it; empty: it is not.
[[nodiscard]] std::string too_much_lost(const capture::Tracks& tracks);

/// What markers of one colour, or of two, do to a body that is followed by angles, in one line;
/// empty: they have more.
[[nodiscard]] std::string colour_doubt(const capture::MarkerSet& markers);

}  // namespace raks::apps
