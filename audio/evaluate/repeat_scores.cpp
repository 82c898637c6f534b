#include "audio/evaluate/repeat_scores.hpp"

#include <algorithm>

namespace raks::audio {
namespace {

// A bar as the states have it.
struct ToldBar {
    StreamTime time{};
    int repeats = -1;
};

// By number.
std::vector<ToldBar> told_bars(std::span<const MusicState> states) {
    std::vector<ToldBar> bars;
    for (const MusicState& state : states) {
        if (state.ahead.bar >= static_cast<int>(bars.size())) {
            bars.push_back({state.time, state.ahead.repeats[0]});
        }
    }
    return bars;
}

// The true bar in which the middle of a told one lies; the last one has no end.
std::size_t true_bar(const TrueBars& truth, std::span<const ToldBar> bars, std::size_t bar) {
    const StreamTime from = bars[bar].time;
    const Nanos length = bar + 1 < bars.size() ? bars[bar + 1].time - from : Nanos{};
    const auto after = std::upper_bound(truth.times.begin(), truth.times.end(), from + length / 2);
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, after - truth.times.begin())) - 1;
}

double share(std::size_t part, std::size_t of) {
    return of == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(of);
}

}  // namespace

TrueBars true_bars(const MusicTruth& music) {
    TrueBars bars;
    MusicPart before = MusicPart::stopped;
    for (const PlayedBar& bar : music.bars) {
        bars.times.push_back(bar.time);
        bars.begins_part.push_back(part_of(bar.kind) != before ? 1 : 0);
        before = part_of(bar.kind);
    }
    bars.distance = [played = music.bars](std::size_t a, std::size_t b) {
        return distance_of(played[a], played[b]);
    };
    return bars;
}

double RepeatScore::recall() const noexcept { return share(found, wanted); }
double RepeatScore::precision() const noexcept { return share(right, told); }

RepeatScore& RepeatScore::operator+=(const RepeatScore& other) noexcept {
    wanted += other.wanted;
    found += other.found;
    told += other.told;
    right += other.right;
    return *this;
}

RepeatScore score_repeats(const TrueBars& truth, std::span<const MusicState> states) {
    RepeatScore score;
    const std::vector<ToldBar> bars = told_bars(states);
    std::vector<char> is_right(truth.times.size(), 0);
    for (std::size_t bar = 0; bar < bars.size() && !truth.times.empty(); ++bar) {
        if (bars[bar].repeats < 0) {
            continue;
        }
        ++score.told;
        const std::size_t here = true_bar(truth, bars, bar);
        const std::size_t first =
            true_bar(truth, bars, static_cast<std::size_t>(bars[bar].repeats));
        if (first < here && truth.distance(first, here) <= 1.0F) {
            ++score.right;
            is_right[here] = 1;
        }
    }
    const std::vector<int> wanted = find_repeats(truth.begins_part, truth.distance);
    for (std::size_t bar = 0; bar < wanted.size(); ++bar) {
        score.wanted += wanted[bar] >= 0 ? 1U : 0U;
        score.found += wanted[bar] >= 0 && is_right[bar] != 0 ? 1U : 0U;
    }
    return score;
}

}  // namespace raks::audio
