#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "apps/reports/genre_track.hpp"

namespace raks::apps {

/// One SVG of a file over time: for each who was asked the probabilities of the dances, a line each
/// in its colour and "unknown" in grey, and below them the dance that would be shown by it. Dances
/// that nobody ever took for likely are left out. `truth`: class of the file; its line is thicker.
/// The same track gives the same bytes. Threads: any. Real-time: no.
[[nodiscard]] std::string draw_genre_plot(const GenreTrack& track,
                                          std::string_view name,
                                          std::size_t truth);

}  // namespace raks::apps
