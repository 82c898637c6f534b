#include "apps/grid/grid_edits.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace raks::apps {
namespace {

using motion::GridBeat;

double to_millisecond(double seconds) { return std::round(1000.0 * seconds) / 1000.0; }

int other_half(int half) { return 3 - half; }

bool follows(const GridBeats& beats, std::size_t beat) {
    return beat > 0 && beats[beat].time - beats[beat - 1].time <= kLongestBeat;
}

// Halves in turn from `beat` on, up to the next gap; that of the beat before `beat` stays.
void alternate_from(std::size_t beat, GridBeats& beats) {
    for (std::size_t i = beat; i < beats.size() && follows(beats, i); ++i) {
        beats[i].half = other_half(beats[i - 1].half);
    }
}

GridBeats::difference_type at(std::size_t index) {
    return static_cast<GridBeats::difference_type>(index);
}

// The index of the first beat that is not before a moment.
std::size_t index_of(const GridBeats& beats, double time) {
    const auto found =
        std::lower_bound(beats.begin(), beats.end(), time, [](const GridBeat& beat, double moment) {
            return beat.time < moment;
        });
    return static_cast<std::size_t>(found - beats.begin());
}

bool is_near(const GridBeats& beats, std::size_t beat, double time) {
    return beat < beats.size() && std::abs(beats[beat].time - time) < kClosestBeats;
}

// Beats in place of those within a reach.
void replace(BeatReach reach, const GridBeats& with, GridBeats& beats) {
    beats.erase(beats.begin() + at(reach.first), beats.begin() + at(reach.last));
    beats.insert(beats.begin() + at(reach.first), with.begin(), with.end());
}

}  // namespace

BeatReach all_of(const GridBeats& beats) noexcept { return {0, beats.size()}; }

BeatReach between(const GridBeats& beats, double from, double to) noexcept {
    BeatReach reach;
    while (reach.first < beats.size() && beats[reach.first].time < from) {
        ++reach.first;
    }
    reach.last = reach.first;
    while (reach.last < beats.size() && beats[reach.last].time <= to) {
        ++reach.last;
    }
    return reach;
}

GridBeats with_moved(GridBeats beats, std::size_t beat, double time, double seconds) {
    const double lowest = beat > 0 ? beats[beat - 1].time + kClosestBeats : 0.0;
    const double highest = beat + 1 < beats.size() ? beats[beat + 1].time - kClosestBeats : seconds;
    if (lowest <= highest) {
        beats[beat].time = to_millisecond(std::clamp(time, lowest, highest));
    }
    return beats;
}

GridBeats with_inserted(GridBeats beats, double time) {
    const std::size_t index = index_of(beats, time);
    if (is_near(beats, index, time) || (index > 0 && is_near(beats, index - 1, time))) {
        return beats;
    }
    GridBeat beat{to_millisecond(time), 1, true};
    if (index > 0) {
        beat.is_used = beats[index - 1].is_used;
    } else if (!beats.empty()) {
        beat.is_used = beats.front().is_used;
        beat.half = other_half(beats.front().half);
    }
    beats.insert(beats.begin() + at(index), beat);
    if (index > 0) {
        alternate_from(index, beats);
    }
    return beats;
}

GridBeats with_removed(GridBeats beats, std::size_t beat) {
    const bool is_first = !follows(beats, beat);
    beats.erase(beats.begin() + at(beat));
    if (!is_first) {
        alternate_from(beat, beats);
    }
    return beats;
}

GridBeats with_shifted(GridBeats beats, BeatReach reach, double by, double seconds) {
    if (reach.first >= reach.last) {
        return beats;
    }
    const double before = reach.first > 0 ? beats[reach.first - 1].time + kClosestBeats : 0.0;
    const double behind =
        reach.last < beats.size() ? beats[reach.last].time - kClosestBeats : seconds;
    const double least = std::min(before - beats[reach.first].time, 0.0);
    const double most = std::max(behind - beats[reach.last - 1].time, 0.0);
    const double step = to_millisecond(std::clamp(by, least, most));
    for (std::size_t i = reach.first; i < reach.last; ++i) {
        beats[i].time = to_millisecond(beats[i].time + step);
    }
    return beats;
}

GridBeats with_half(GridBeats beats, BeatReach reach) {
    GridBeats kept;
    for (std::size_t i = reach.first; i < reach.last; ++i) {
        const GridBeat& beat = beats[i];
        if (beat.half == 1) {
            kept.push_back(beat);
            kept.back().half = kept.size() % 2 == 1 ? 1 : 2;
        } else if (!kept.empty() && i > reach.first && beats[i - 1].half == 1) {
            kept.back().is_used = kept.back().is_used && beat.is_used;
        }
    }
    if (kept.size() >= 2) {
        replace(reach, kept, beats);
    }
    return beats;
}

GridBeats with_double(GridBeats beats, BeatReach reach) {
    GridBeats doubled;
    for (std::size_t i = reach.first; i < reach.last; ++i) {
        doubled.push_back(beats[i]);
        doubled.back().half = 1;
        const bool has_room = i + 1 < beats.size() && follows(beats, i + 1) &&
                              beats[i + 1].time - beats[i].time >= 2.0 * kClosestBeats + 0.001;
        if (has_room) {
            doubled.push_back(
                {to_millisecond(0.5 * (beats[i].time + beats[i + 1].time)), 2, beats[i].is_used});
        }
    }
    replace(reach, doubled, beats);
    return beats;
}

GridBeats with_even(GridBeats beats, BeatReach reach) {
    if (reach.last < reach.first + 3) {
        return beats;
    }
    const double from = beats[reach.first].time;
    const double step =
        (beats[reach.last - 1].time - from) / static_cast<double>(reach.last - reach.first - 1);
    for (std::size_t i = reach.first + 1; i + 1 < reach.last; ++i) {
        beats[i].time = to_millisecond(from + step * static_cast<double>(i - reach.first));
    }
    return beats;
}

GridBeats with_one_at(GridBeats beats, std::size_t beat) {
    beats[beat].half = 1;
    alternate_from(beat + 1, beats);
    for (std::size_t i = beat; i > 0 && follows(beats, i); --i) {
        beats[i - 1].half = other_half(beats[i].half);
    }
    return beats;
}

GridBeats with_use(GridBeats beats, BeatReach reach, bool is_used) {
    for (std::size_t i = reach.first; i < reach.last; ++i) {
        beats[i].is_used = is_used;
    }
    return beats;
}

GridBeats with_taps(GridBeats beats, std::span<const double> taps) {
    constexpr double kAlone = 0.4;  // seconds, for one tap
    GridBeats tapped;
    for (const double tap : taps) {
        const double time = to_millisecond(tap);
        if (tapped.empty() || time - tapped.back().time >= kClosestBeats) {
            tapped.push_back({time, 1, true});
        }
    }
    if (tapped.empty()) {
        return beats;
    }
    const double interval = tapped.size() > 1 ? (tapped.back().time - tapped.front().time) /
                                                    static_cast<double>(tapped.size() - 1)
                                              : kAlone;
    const double beside = std::max(0.5 * interval, kClosestBeats);
    const BeatReach reach =
        between(beats, tapped.front().time - beside, tapped.back().time + beside);
    replace(reach, tapped, beats);
    alternate_from(reach.first > 0 && follows(beats, reach.first) ? reach.first : reach.first + 1,
                   beats);
    return beats;
}

}  // namespace raks::apps
