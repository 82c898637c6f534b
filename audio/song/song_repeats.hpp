#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace raks::audio {

/// How unlike two bars of a song are: at most 1 where they sound alike; infinite where they cannot
/// be compared. Called with different bars, the earlier one first.
using BarDistance = std::function<float(std::size_t, std::size_t)>;

/// The parts of a song that come again: for each bar the earliest one that it repeats, or -1.
///
/// Bars are compared with bars (Foote 1999, self-similarity); a part that comes again is a run of
/// bars that are each alike the bar a fixed number of bars before, a diagonal of the matrix of all
/// distances (Goto 2006, RefraiD; Mueller 2015, 4.2). What counts is the mean distance of four bars
/// in a row, of which none may be further away than kFillDistance: a drum fill. Of runs that
/// overlap, the longer one is taken, of equal ones the one whose first time is earlier.
///
/// - A run has 8 bars at least, or 6 (4) where what the music does changes at one end of it (both):
///   a short part as a whole, such as a breakdown.
/// - What goes on is not a part that comes again. A stretch in which each bar is alike the bar 1 to
///   8 bars before is a loop, and no bar of a loop repeats a bar of the same loop. So a song that
///   is one loop has repeats only where the loop was left, for a breakdown or a stop of several
///   bars, and even then each bar is repeated once by each stretch: a loop that goes on for longer
///   than at its first time is new from there on.
/// - Within a part repeats go up by one with each bar. No bar repeats one that repeats another:
///   chains are followed to their first bar. What is left of a part shorter than 4 bars is new.
/// - Parts further apart than kMostLag bars are not found.
///
/// `begins_part`: for each bar whether what the music does differs from the bar before. Cost:
/// bars x min(bars, kMostLag) / 2 distances. Threads: any. Real-time: no.
[[nodiscard]] std::vector<int> find_repeats(std::span<const char> begins_part,
                                            const BarDistance& distance);

inline constexpr std::size_t kMostLag = 1024;  ///< bars from a part to its first time
inline constexpr float kFillDistance = 2.0F;   ///< of a bar that need not be alike

}  // namespace raks::audio
