#include "training/cells/grid_music.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace raks::motion {
namespace {

// What the beats of the music meet of the cues at an offset: the more of them lie over the clip,
// the more. None where hardly any does.
double met_at(const GridCues& cues, const DancedMusic& music, double offset) {
    constexpr double kFewest = 4.0;
    double sum = 0.0;
    double count = 0.0;
    auto beat = std::lower_bound(
        music.beats.begin(), music.beats.end(), offset, [](const MusicBeat& one, double seconds) {
            return one.seconds < seconds;
        });
    for (; beat != music.beats.end() && beat->seconds - offset <= cues.seconds(); ++beat) {
        sum += cues.impulse[cues.row_at(beat->seconds - offset)];
        count += 1.0;
    }
    return count < kFewest ? -HUGE_VAL : sum;
}

}  // namespace

MusicOffset find_offset(const GridCues& cues, const DancedMusic& music) {
    constexpr double kStep = 0.01;   // seconds
    constexpr double kBefore = 2.0;  // that the clip may begin before the music
    constexpr double kAsGood = 0.9;  // of the best
    if (music.beats.empty()) {
        return {};
    }
    std::vector<double> met;
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    const double last = std::max(music.beats.back().seconds - 0.5 * cues.seconds(), 0.0);
    for (double offset = -kBefore; offset <= last; offset += kStep) {
        const double value = met.emplace_back(met_at(cues, music, offset));
        if (std::isfinite(value)) {
            sum += value;
            squares += value * value;
            count += 1.0;
        }
    }
    if (count < 2.0) {
        return {};
    }
    const double mean = sum / count;
    const double deviation = std::sqrt(std::max(squares / count - mean * mean, 1e-12));
    const double most = *std::max_element(met.begin(), met.end());
    MusicOffset best{HUGE_VAL, (most - mean) / deviation};
    for (std::size_t i = 0; i < met.size(); ++i) {
        // A place that is better than those beside it.
        const bool is_top =
            (i == 0 || met[i] >= met[i - 1]) && (i + 1 == met.size() || met[i] > met[i + 1]);
        const double offset = -kBefore + kStep * static_cast<double>(i);
        if (is_top && met[i] - mean >= kAsGood * (most - mean) &&
            std::abs(offset) < std::abs(best.seconds)) {
            best.seconds = std::round(offset / kStep) * kStep;
        }
    }
    return best;
}

TakeGrid grid_of_music(const std::string& take, const GridCues& cues, const DancedMusic& music) {
    TakeGrid grid{take, {}};
    const std::vector<ActiveRows> stretches = active_rows(cues);
    for (std::size_t i = 0; i < music.beats.size(); ++i) {
        const double time = std::round(1000.0 * (music.beats[i].seconds - music.offset)) / 1000.0;
        const bool is_later = grid.beats.empty() || time > grid.beats.back().time;
        if (time < 0.0 || time > cues.seconds() || !is_later) {
            continue;
        }
        const int place = music.beats[i].bar_position;
        const int before = grid.beats.empty() ? 2 : grid.beats.back().half;
        const double end = i + 1 < music.beats.size() ? music.beats[i + 1].seconds - music.offset
                                                      : cues.seconds() + 1.0;
        const bool is_used =
            end <= cues.seconds() &&
            std::any_of(stretches.begin(), stretches.end(), [&](const ActiveRows& rows) {
                return rows.first <= cues.row_at(time) && cues.row_at(end) <= rows.last;
            });
        grid.beats.push_back({time, place > 0 ? 2 - place % 2 : 3 - before, is_used});
    }
    return grid;
}

}  // namespace raks::motion
