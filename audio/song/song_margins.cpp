#include "audio/song/song_margins.hpp"

#include <algorithm>

namespace raks::audio {

SongMargins::SongMargins(const SongRecording& song, const std::vector<PathBeat>& path)
    : path_(path) {
    sums_.resize(song.hops.size() + 1);
    std::size_t beat = 0;
    for (std::size_t hop = 0; hop < song.hops.size(); ++hop) {
        sums_[hop + 1] = sums_[hop];
        const auto at = static_cast<double>(hop);
        while (beat + 2 < path.size() && path[beat + 1].hop <= at) {
            ++beat;
        }
        if (path.size() < 2 || song.hops[hop].is_blind || !song.hops[hop].has_evidence) {
            continue;
        }
        const double length = path[beat + 1].hop - path[beat].hop;
        const double position = static_cast<double>(beat) + (at - path[beat].hop) / length;
        const PulseFits fits = fit_pulses(position, length, likelihood_of(song.hops[hop].evidence));
        for (std::size_t i = 0; i < fits.size(); ++i) {
            sums_[hop + 1][i].in_two += fits[i].in_two;
            sums_[hop + 1][i].in_three += fits[i].in_three;
        }
    }
}

PulseMargins SongMargins::around(std::size_t beat) const {
    const auto hop = static_cast<std::int64_t>(path_[beat].hop);
    const auto last = static_cast<std::int64_t>(sums_.size()) - 1;
    const auto first = std::clamp<std::int64_t>(hop - kAround, 0, last);
    const auto end = std::clamp<std::int64_t>(hop + kAround, 0, last);
    const PulseFits& from = sums_[static_cast<std::size_t>(first)];
    const PulseFits& to = sums_[static_cast<std::size_t>(end)];
    // As much as the running sums of the tracker hold.
    const float share =
        static_cast<float>(kAround) / static_cast<float>(std::max<std::int64_t>(1, end - first));
    PulseFits fits{};
    for (std::size_t i = 0; i < fits.size(); ++i) {
        fits[i].in_two = share * (to[i].in_two - from[i].in_two);
        fits[i].in_three = share * (to[i].in_three - from[i].in_three);
    }
    return PulseMargins(fits);
}

double SongMargins::bpm(std::size_t beat) const {
    const std::size_t first = std::min(beat, path_.size() - 2);
    return 60.0 * kHopsPerSecond / (path_[first + 1].hop - path_[first].hop);
}

}  // namespace raks::audio
