// Readers of files that hold points: C3D, TRC, and tables (CSV).
#pragma once

#include <optional>
#include <string_view>

#include "base/expected.hpp"
#include "motion/skeleton/point_clip.hpp"

namespace raks::motion {

/// Reads a C3D (c3d.org, user guide 2008): of Intel's, DEC's or MIPS' byte order, places as whole
/// numbers or floats. Its unit, and which axis is up on its screen, are taken where it says them.
/// A negative residual is a point that was not seen. Forces, analogue channels and events are
/// passed over; so are "points" that are angles, forces, moments or powers (said in a warning),
/// names that lack are "point 12". Fewer frames than declared are read (warned). A given rate
/// overrides.
///
/// Errors, one line with the file's name: no C3D, cut off, no points or more than 1,000, no frame
/// rate. Memory follows the bytes that are there. Threads: workers. Real-time: no.
[[nodiscard]] Expected<PointClip> parse_c3d(std::string_view bytes,
                                            std::string_view name,
                                            std::optional<double> frames_per_second);

/// Reads a TRC (Motion Analysis, OpenSim): markers by name, with rate and unit. Blank cells, "nan"
/// and missing ends of rows are points that were not seen. Errors, one line with its number: no
/// TRC, no markers or more than 1,000, words that are no numbers, no frame rate. Threads: workers.
/// Real-time: no.
[[nodiscard]] Expected<PointClip> parse_trc(std::string_view text,
                                            std::string_view name,
                                            std::optional<double> frames_per_second);

/// Reads a table with a head: three columns a point, called NAME_x, NAME_y, NAME_z (or NAME.x,
/// NAME:x, "NAME x", in either case), in any order; separated by comma, semicolon or tab. A column
/// "time" (seconds) gives the rate, "frame" and others are passed over (said in a warning). Blank
/// cells and "nan" are points that were not seen. Errors, one line with its number: no such
/// columns, a point without all three, rows of another length, words that are no numbers, neither
/// time nor a given rate, times that do not go on. Threads: workers. Real-time: no.
[[nodiscard]] Expected<PointClip> parse_points_csv(std::string_view text,
                                                   std::string_view name,
                                                   std::optional<double> frames_per_second);

/// Metres of a unit by its name (m, cm, mm, in, ...), whatever its case. None: not known.
[[nodiscard]] std::optional<double> metres_of_unit(std::string_view name);

/// Checks what all of them must be: points and frames in bounds, a sane rate, places finite or NaN
/// in all three axes and within limits. Errors, without a file's name.
[[nodiscard]] Expected<void> check_points(PointClip& clip);

}  // namespace raks::motion
