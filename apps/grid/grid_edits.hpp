// Grid edits: what can be done to the beats of a take. Pure: beats in, beats out; times stay rising
// and within the clip, to the millisecond, so that a grid is the same once it was saved and read.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "training/cells/take_grid.hpp"

namespace raks::apps {

using GridBeats = std::vector<motion::GridBeat>;

/// Beats lie at least so far apart, seconds.
inline constexpr double kClosestBeats = 0.05;
/// What is longer is a gap: beats on either side of it do not follow each other.
inline constexpr double kLongestBeat = 1.5;

/// Beats [first, last) that an edit is about.
struct BeatReach {
    std::size_t first = 0;
    std::size_t last = 0;

    friend bool operator==(const BeatReach&, const BeatReach&) = default;
};
/// All beats.
[[nodiscard]] BeatReach all_of(const GridBeats& beats) noexcept;
/// Those from one moment to another, both included.
[[nodiscard]] BeatReach between(const GridBeats& beats, double from, double to) noexcept;

/// One beat at another time, as near to it as its neighbours and the clip of so many seconds allow.
[[nodiscard]] GridBeats with_moved(GridBeats beats, std::size_t beat, double time, double seconds);
/// One beat more, used as the one before it is; none where another is too close. The halves of
/// those behind it follow.
[[nodiscard]] GridBeats with_inserted(GridBeats beats, double time);
/// One beat less. The halves of those behind it follow.
[[nodiscard]] GridBeats with_removed(GridBeats beats, std::size_t beat);
/// Beats later (or earlier, below 0) by so many seconds, as far as others and the clip allow.
[[nodiscard]] GridBeats with_shifted(GridBeats beats, BeatReach reach, double by, double seconds);
/// Half of the beats: those of the first half of the bar stay, which is used where both were, and
/// become first and second in turn. At least two stay of what has two.
[[nodiscard]] GridBeats with_half(GridBeats beats, BeatReach reach);
/// Twice the beats: one half way to the next, of the second half of the bar; the others become
/// those of the first. Nothing comes into gaps.
[[nodiscard]] GridBeats with_double(GridBeats beats, BeatReach reach);
/// Beats between the first and the last of them at even distances, as many as there are.
[[nodiscard]] GridBeats with_even(GridBeats beats, BeatReach reach);
/// The beat is of the first half of the bar, and those that follow and precede it without a gap,
/// in turn, too.
[[nodiscard]] GridBeats with_one_at(GridBeats beats, std::size_t beat);
/// These may be danced, or not.
[[nodiscard]] GridBeats with_use(GridBeats beats, BeatReach reach, bool is_used);
/// Beats where somebody tapped, in place of those that were there: between the first tap and the
/// last, and less than half an interval of theirs outside. Their halves go on from the beat before
/// the first tap, where it is near; those of the beats behind follow. Taps too close to one another
/// count once.
[[nodiscard]] GridBeats with_taps(GridBeats beats, std::span<const double> taps);

}  // namespace raks::apps
