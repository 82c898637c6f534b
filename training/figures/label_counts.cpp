#include "training/figures/label_counts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "base/statistics.hpp"

namespace raks::motion {
namespace {

/// True when the count is of this take: the same name, or the name after the take's first '_' (both
/// takes of a pair share one table of counts).
bool is_of(const CountTime& time, const std::string& take) {
    const std::size_t underscore = take.find('_');
    return time.take == take ||
           (underscore != std::string::npos && time.take == take.substr(underscore + 1));
}

}  // namespace

std::vector<double> beat_frames_of(const FigureLabel& label, std::span<const CountTime> counts) {
    const double start = static_cast<double>(label.start);
    // Frames a beat if the counts were even: the estimate that matches counts to beats.
    const double beat = (static_cast<double>(label.end) - start) / label.beats;
    std::vector<double> frames(static_cast<std::size_t>(label.beats) + 1, std::nan(""));
    for (const CountTime& time : counts) {
        const double nearest = std::round((time.frame - start) / beat);
        // A count more than half a beat from its even place may belong to the beat before or after;
        // up to one and a half beats of deviation are accepted.
        for (int b = static_cast<int>(nearest) - 1; b <= static_cast<int>(nearest) + 1; ++b) {
            const int due = (label.start_count - 1 + b) % label.beats + 1;
            if (b >= 0 && b <= label.beats && due == time.count && is_of(time, label.take) &&
                std::abs(time.frame - (start + b * beat)) < 1.5 * beat) {
                frames[static_cast<std::size_t>(b)] = time.frame;
            }
        }
    }
    if (std::isnan(frames.front())) {
        frames.front() = start;
    }
    if (std::isnan(frames.back())) {
        frames.back() = static_cast<double>(label.end);
    }
    // Linear interpolation over each run of missing beats; first and last are known by here.
    for (std::size_t known = 0; known + 1 < frames.size();) {
        std::size_t next = known + 1;
        while (std::isnan(frames[next])) {
            ++next;
        }
        for (std::size_t b = known + 1; b < next; ++b) {
            const double t = static_cast<double>(b - known) / static_cast<double>(next - known);
            frames[b] = frames[known] + t * (frames[next] - frames[known]);
        }
        known = next;
    }
    return frames;
}

namespace {

constexpr double kSlack = 0.1;  // seconds that a label may begin before or end after the music
// Inter-beat intervals: a beat farther than this from the label's start or end is not its beat.
constexpr double kNearest = 0.6;
// Intervals: with both beats this far or farther from the start, the bar position decides.
constexpr double kAboutAsNear = 0.4;
constexpr double kMissed = 1.6;  // intervals: a longer gap lacks at least one beat

using Seconds = std::vector<double>;

// Seconds. A median, because a missed beat makes one interval twice as long.
double median_interval(std::span<const MusicBeat> beats) {
    Seconds intervals;
    for (std::size_t i = 1; i < beats.size(); ++i) {
        intervals.push_back(beats[i].seconds - beats[i - 1].seconds);
    }
    return upper_median(std::move(intervals));
}

/// The beats from one inter-beat interval before the label to one after it; missed beats are
/// interpolated, with unknown bar position.
std::vector<MusicBeat> beats_around(const DancedMusic& music, double from, double to) {
    std::vector<MusicBeat> found;
    double longest = 0.0;  // interval between two beats inside the label
    for (std::size_t i = 0; i + 1 < music.beats.size(); ++i) {
        if (music.beats[i].seconds >= from && music.beats[i + 1].seconds <= to) {
            longest = std::max(longest, music.beats[i + 1].seconds - music.beats[i].seconds);
        }
    }
    // A beat just outside may be the one nearest to the label's start or end.
    std::copy_if(music.beats.begin(),
                 music.beats.end(),
                 std::back_inserter(found),
                 [&](const MusicBeat& beat) {
                     return beat.seconds >= from - longest && beat.seconds <= to + longest;
                 });
    if (found.size() < 2) {
        return {};
    }
    // A gap of about n intervals gets n - 1 beats at equal distances.
    const double interval = median_interval(found);
    std::vector<MusicBeat> filled = {found.front()};
    for (std::size_t i = 1; i < found.size(); ++i) {
        const double gap = found[i].seconds - found[i - 1].seconds;
        const int beats =
            gap > kMissed * interval ? static_cast<int>(std::lround(gap / interval)) : 1;
        for (int k = 1; k < beats; ++k) {
            filled.push_back({found[i - 1].seconds + gap * k / beats, 0});
        }
        filled.push_back(found[i]);
    }
    return filled;
}

// Index of the beat nearest to the time; `beats` is not empty.
std::size_t nearest(const std::vector<MusicBeat>& beats, double seconds) {
    const auto found =
        std::min_element(beats.begin(), beats.end(), [&](const MusicBeat& a, const MusicBeat& b) {
            return std::abs(a.seconds - seconds) < std::abs(b.seconds - seconds);
        });
    return static_cast<std::size_t>(found - beats.begin());
}

/// The beat on which the label starts: the nearest one, unless its neighbour on the other side is
/// about as near and is the downbeat that a label starting on count 1 asks for.
std::size_t first_beat(const std::vector<MusicBeat>& beats,
                       const FigureLabel& label,
                       double seconds,
                       double interval) {
    const std::size_t best = nearest(beats, seconds);
    const bool is_later = beats[best].seconds > seconds;
    // The neighbour on the other side of the label's start.
    const std::size_t other = is_later ? (best > 0 ? best - 1 : best) : best + 1;
    const bool is_close = other < beats.size() && std::abs(beats[other].seconds - seconds) <=
                                                      (1.0 - kAboutAsNear) * interval;
    const auto is_downbeat = [&](std::size_t i) {
        return label.start_count == 1 && beats[i].bar_position == 1;
    };
    return is_close && is_downbeat(other) && !is_downbeat(best) ? other : best;
}

/// `heard` brought to `wanted` beats when it has as many, twice or half as many (an octave error of
/// the tracker); else empty.
Seconds at_octave(const Seconds& tracked, std::size_t wanted) {
    const std::size_t count = tracked.size() - 1;
    Seconds beats;
    if (count == wanted) {
        return tracked;
    }
    if (count == 2 * wanted) {
        // Twice as many: keeps every other beat, the first and last among them.
        for (std::size_t i = 0; i < tracked.size(); i += 2) {
            beats.push_back(tracked[i]);
        }
    } else if (2 * count == wanted) {
        // Half as many: adds the middle of every interval.
        for (std::size_t i = 0; i < count; ++i) {
            beats.push_back(tracked[i]);
            beats.push_back(0.5 * (tracked[i] + tracked[i + 1]));
        }
        beats.push_back(tracked.back());
    }
    return beats;
}

// A label outside the music points to a wrong offset, so the error asks for it.
Expected<void> check_inside(const DancedMusic& music, double from, double to) {
    if (from < -kSlack) {
        return fail(
            fmt::format("starts {:.1f} s before {} does; is --offset right?", -from, music.name));
    }
    if (to > music.duration + kSlack) {
        return fail(
            fmt::format("ends at {:.1f} s of {}, which is {:.1f} s long; is --offset right?",
                        to,
                        music.name,
                        music.duration));
    }
    return {};
}

}  // namespace

Expected<LabelCounts> counts_of(const FigureLabel& label,
                                const DancedMusic& music,
                                double frames_per_second) {
    // Frames of the clip to seconds of the music.
    const double from = static_cast<double>(label.start) / frames_per_second + music.offset;
    const double to = static_cast<double>(label.end) / frames_per_second + music.offset;
    if (auto ok = check_inside(music, from, to); !ok) {
        return fail(std::move(ok.error()));
    }
    const std::vector<MusicBeat> beats = beats_around(music, from, to);
    // Both ends need a beat within kNearest, or the tracker found none there.
    const double interval = beats.empty() ? 0.0 : median_interval(beats);
    const std::size_t first = beats.empty() ? 0 : first_beat(beats, label, from, interval);
    const std::size_t last = beats.empty() ? 0 : nearest(beats, to);
    if (last <= first || std::abs(beats[first].seconds - from) > kNearest * interval ||
        std::abs(beats[last].seconds - to) > kNearest * interval) {
        return fail(
            fmt::format("no beats were heard in {} from {:.1f} to {:.1f} s; is --offset "
                        "right? Else give --counts",
                        music.name,
                        from,
                        to));
    }
    // Seconds of the beats from the first to the last, both included.
    Seconds tracked;
    for (std::size_t i = first; i <= last; ++i) {
        tracked.push_back(beats[i].seconds);
    }
    LabelCounts counts;
    const std::size_t wanted =
        label.beats == 0 ? tracked.size() - 1 : static_cast<std::size_t>(label.beats);
    // Back to frames of the clip, with fractions.
    for (const double seconds : at_octave(tracked, wanted)) {
        counts.frames.push_back((seconds - music.offset) * frames_per_second);
    }
    if (counts.frames.empty()) {
        counts.left_out = fmt::format(
            "{} beats were heard in it, the label says {}", tracked.size() - 1, label.beats);
    }
    return counts;
}

}  // namespace raks::motion
