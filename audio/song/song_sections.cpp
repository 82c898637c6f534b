#include "audio/song/song_sections.hpp"

#include <algorithm>
#include <cmath>

#include "audio/form/section_rules.hpp"
#include "base/statistics.hpp"

namespace raks::audio {
namespace {

constexpr double kFull = 0.75;          // share of the bars that are less full than the full band
constexpr std::size_t kBar = 4;         // beats that are compared
constexpr std::size_t kLeastBeats = 4;  // of a breakdown
constexpr double kSteadyBeat = 0.5;     // seconds, where a song has no beats
constexpr float kBuildUpRise = 1.0F;    // rise_of() of a build-up

// The song's beats with the sound between any two of them, pauses left out.
class SongStretches {
 public:
    SongStretches(std::span<const HopSound> sounds,
                  const std::vector<SongPause>& pauses,
                  std::vector<std::size_t> hops)
        : hops_(std::move(hops)) {
        SoundSums sums;
        std::size_t count = 0;
        std::size_t next_beat = 0;
        auto pause = pauses.begin();
        for (std::size_t hop = 0; hop <= sounds.size(); ++hop) {
            for (; next_beat < hops_.size() && hops_[next_beat] == hop; ++next_beat) {
                sums_.push_back(sums);
                counts_.push_back(count);
            }
            while (pause != pauses.end() && pause->end <= hop) {
                ++pause;
            }
            if (hop < sounds.size() && (pause == pauses.end() || hop < pause->first)) {
                sums = sums.plus(sounds[hop]);
                ++count;
            }
        }
    }
    // Beats, the end of the song included.
    [[nodiscard]] std::size_t size() const { return sums_.size(); }
    [[nodiscard]] std::size_t hop_of(std::size_t beat) const { return hops_[beat]; }
    // Whether anything sounds between two beats.
    [[nodiscard]] bool has_sound(std::size_t from, std::size_t to) const {
        return counts_[to] > counts_[from];
    }
    [[nodiscard]] StretchSound mean(std::size_t from, std::size_t to) const {
        return sums_[to].since(sums_[from], std::max<std::size_t>(1, counts_[to] - counts_[from]));
    }
    // Of the bar that begins or ends at a beat, as much of it as there is.
    [[nodiscard]] StretchSound after(std::size_t beat) const {
        return mean(beat, std::min(size() - 1, beat + kBar));
    }
    [[nodiscard]] StretchSound before(std::size_t beat) const {
        return mean(beat - std::min(beat, kBar), beat);
    }

 private:
    std::vector<std::size_t> hops_;
    std::vector<SoundSums> sums_;
    std::vector<std::size_t> counts_;  // hops that sounded before the beat
};

// Hops of the beats, and of the end.
std::vector<std::size_t> beat_hops(const std::vector<SongBeat>& beats, std::size_t hops) {
    std::vector<std::size_t> result;
    for (const SongBeat& beat : beats) {
        const double hop = std::round(to_seconds(beat.time) * kHopsPerSecond);
        const auto at = static_cast<std::size_t>(std::max(0.0, hop));
        if (at < hops && (result.empty() || at > result.back())) {
            result.push_back(at);
        }
    }
    if (result.size() < 2) {
        result.clear();
        const auto step = static_cast<std::size_t>(kSteadyBeat * kHopsPerSecond);
        for (std::size_t hop = 0; hop < hops; hop += step) {
            result.push_back(hop);
        }
    }
    result.push_back(hops);
    return result;
}

// The full band: the higher values of all bars.
StretchSound full_band(const SongStretches& beats) {
    std::vector<double> low;
    std::vector<double> level;
    std::vector<double> low_onsets;
    std::vector<double> onsets;
    for (std::size_t beat = 0; beat + kBar < beats.size(); ++beat) {
        if (!beats.has_sound(beat, beat + kBar)) {
            continue;
        }
        const StretchSound bar = beats.after(beat);
        low.push_back(static_cast<double>(bar.low));
        level.push_back(static_cast<double>(bar.level));
        low_onsets.push_back(static_cast<double>(bar.low_onsets));
        onsets.push_back(static_cast<double>(bar.onsets));
    }
    const auto high = [](const std::vector<double>& values) {
        return static_cast<float>(percentile(values, kFull));
    };
    return {high(low), high(level), high(low_onsets), high(onsets), 0.0F};
}

// Moves a border to the beat within a bar at which the sound changes most. `sign`: 1 where it
// falls, -1 where it rises.
std::size_t refined(const SongStretches& beats,
                    std::size_t border,
                    const StretchSound& full,
                    float sign) {
    const std::size_t first = std::max<std::size_t>(1, border - std::min(border, kBar));
    const std::size_t last = std::min(beats.size() - 2, border + kBar);
    std::size_t best = border;
    float greatest = -1e9F;
    for (std::size_t beat = first; beat <= last; ++beat) {
        const float step = sign * step_down(beats.before(beat), beats.after(beat), full);
        if (step > greatest) {
            greatest = step;
            best = beat;
        }
    }
    return best;
}

// One number a beat for how far it has risen.
float height_of(const StretchSound& sound, const StretchSound& full) {
    return rise_of({-100.0F, -100.0F, 0.0F, 0.0F, -40.0F}, sound, full);
}

// The beat from which it rises: level before it, on a straight line after it, as well as can be.
std::size_t knee_of(const SongStretches& beats,
                    std::size_t first,
                    std::size_t end,
                    const StretchSound& full) {
    std::vector<double> heights;
    for (std::size_t beat = first; beat < end; ++beat) {
        heights.push_back(static_cast<double>(height_of(beats.mean(beat, beat + 1), full)));
    }
    std::size_t best = 0;
    double least = 1e300;
    for (std::size_t knee = 0; knee + kBar <= heights.size(); ++knee) {
        // Least squares of a + b max(0, i - knee).
        double n = 0.0;
        double x = 0.0;
        double xx = 0.0;
        double y = 0.0;
        double xy = 0.0;
        double yy = 0.0;
        for (std::size_t i = 0; i < heights.size(); ++i) {
            const double place = i > knee ? static_cast<double>(i - knee) : 0.0;
            n += 1.0;
            x += place;
            xx += place * place;
            y += heights[i];
            xy += place * heights[i];
            yy += heights[i] * heights[i];
        }
        const double slope = (n * xy - x * y) / std::max(1e-9, n * xx - x * x);
        const double base = (y - slope * x) / n;
        const double error = yy - base * y - slope * xy;
        if (error < least) {
            least = error;
            best = knee;
        }
    }
    return first + best;
}

}  // namespace

std::vector<SongBreakdown> find_breakdowns(std::span<const HopSound> sounds,
                                           const std::vector<SongPause>& pauses,
                                           const std::vector<SongBeat>& beats) {
    const SongStretches song(sounds, pauses, beat_hops(beats, sounds.size()));
    std::vector<SongBreakdown> breakdowns;
    if (song.size() < 2 * kBar) {
        return breakdowns;
    }
    const StretchSound full = full_band(song);
    const auto is_fallen = [&](std::size_t beat) {
        const std::size_t from = beat - std::min(beat, kBar / 2);
        const std::size_t to = std::min(song.size() - 1, beat + kBar / 2);
        return song.has_sound(from, to) && fall_of(song.mean(from, to), full).is_breakdown();
    };
    for (std::size_t beat = 0; beat + 1 < song.size();) {
        std::size_t end = beat;
        while (end + 1 < song.size() && is_fallen(end)) {
            ++end;
        }
        if (end - beat < kLeastBeats) {
            beat = end + 1;
            continue;
        }
        const std::size_t first = beat == 0 ? 0 : refined(song, beat, full, 1.0F);
        const bool has_more = end + 1 < song.size();
        const std::size_t back = has_more ? refined(song, end, full, -1.0F) : end;
        if (back > first + 1) {
            SongBreakdown found;
            found.first = song.hop_of(first);
            found.build_up = found.end = song.hop_of(back);
            found.drops = has_more && fall_of(song.after(back), full).is_full();
            if (found.drops && back > first + 2 * kBar) {
                const std::size_t knee = knee_of(song, first, back, full);
                const std::size_t calm = std::min(knee, back - kBar);
                if (rise_of(song.mean(std::min(first, calm), std::max(calm, first + 1)),
                            song.before(back),
                            full) > kBuildUpRise) {
                    found.build_up = song.hop_of(knee);
                }
            }
            breakdowns.push_back(found);
        }
        beat = end + 1;
    }
    return breakdowns;
}

}  // namespace raks::audio
