#include "training/discovery/danced_beats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/statistics.hpp"

namespace raks::motion {
namespace {

constexpr double kTolerance = 0.06;  // of a number of beats: how well a period is known

}  // namespace

Expected<DancedBeats> DancedBeats::within(const DancedMusic& music, double seconds) {
    DancedBeats danced;
    std::vector<double> intervals;
    for (std::size_t i = 0; i < music.beats.size(); ++i) {
        MusicBeat beat = music.beats[i];
        beat.seconds -= music.offset;
        if (!danced.beats_.empty() && beat.seconds >= 0.0 && beat.seconds <= seconds) {
            intervals.push_back(beat.seconds - danced.beats_.back().seconds);
        }
        danced.beats_.push_back(beat);
    }
    if (intervals.size() < 3) {
        return fail(
            fmt::format("no beats were heard in {} from {:.1f} to {:.1f} s; is --offset right?",
                        music.name,
                        music.offset,
                        music.offset + seconds));
    }
    danced.interval_ = upper_median(std::move(intervals));
    return danced;
}

int DancedBeats::whole_beats(double seconds, std::optional<int> wanted, int beats_per_bar) const {
    const double beats = seconds / interval_;
    const auto fits = [&](int count) { return std::abs(beats / count - 1.0) < kTolerance; };
    if (wanted) {
        return fits(*wanted) ? *wanted : 0;
    }
    for (const int half_bars : {1, 2, 4, 8}) {
        const int count = half_bars * beats_per_bar / 2;
        if (half_bars * beats_per_bar % 2 == 0 && fits(count)) {
            return count;
        }
    }
    return 0;
}

std::size_t DancedBeats::nearest(double seconds) const {
    const auto found =
        std::min_element(beats_.begin(), beats_.end(), [&](const MusicBeat& a, const MusicBeat& b) {
            return std::abs(a.seconds - seconds) < std::abs(b.seconds - seconds);
        });
    return static_cast<std::size_t>(found - beats_.begin());
}

double DancedBeats::beats_after_nearest(double seconds) const {
    return std::clamp((seconds - beats_[nearest(seconds)].seconds) / interval_, -0.5, 0.5);
}

std::optional<std::pair<double, double>> DancedBeats::beats_from(double seconds, int count) const {
    const std::size_t first = nearest(seconds);
    const std::size_t last = first + static_cast<std::size_t>(count);
    if (last >= beats_.size()) {
        return std::nullopt;
    }
    return std::pair{beats_[first].seconds, beats_[last].seconds};
}

std::vector<double> DancedBeats::between(double from, double to) const {
    std::vector<double> seconds;
    for (const MusicBeat& beat : beats_) {
        if (beat.seconds >= from && beat.seconds <= to) {
            seconds.push_back(beat.seconds);
        }
    }
    return seconds;
}

double DancedBeats::share_on_bar_lines(std::span<const double> seconds) const {
    double share = 0.0;
    for (const double moment : seconds) {
        share += beats_[nearest(moment)].bar_position == 1 ? 1.0 : 0.0;
    }
    return seconds.empty() ? 0.0 : share / static_cast<double>(seconds.size());
}

}  // namespace raks::motion
