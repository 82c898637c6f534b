#include "audio/song/song_bars.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "audio/song/song_repeats.hpp"
#include "base/random.hpp"
#include "base/statistics.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kBands = SongRecording::kMelBands;
constexpr double kEarly = 0.2;         // of a half beat
constexpr float kFaint = 0.3F;         // of a band's mean: -10 dB
constexpr float kAlikeLevel = 1.5F;    // dB
constexpr float kOfUsualShape = 0.6F;  // of the median of all pairs of bars
constexpr float kLeastShape = 1.2F;    // dB
constexpr float kMostShape = 3.0F;     // dB
constexpr std::uint64_t kPairs = 2000;
// More bars have no numbers in Foresight::repeats.
constexpr std::size_t kMostBars = std::numeric_limits<std::int16_t>::max();

using BandMeans = std::array<float, kBands>;

// Mean magnitude of each band over hops [first, end).
BandMeans mean_of(const SongRecording& song, std::size_t first, std::size_t end) {
    std::array<double, kBands> sums{};
    for (std::size_t hop = first; hop < end; ++hop) {
        const auto mel = song.mel_of(hop);
        for (std::size_t band = 0; band < kBands; ++band) {
            sums[band] += static_cast<double>(mel[band]);
        }
    }
    BandMeans means{};
    const double hops = static_cast<double>(std::max<std::size_t>(1, end - first));
    for (std::size_t band = 0; band < kBands; ++band) {
        means[band] = static_cast<float>(sums[band] / hops);
    }
    return means;
}

// The hop in which a moment lies, in the song.
std::size_t hop_of_moment(double seconds, std::size_t hops) {
    const double hop = std::clamp(seconds * kHopsPerSecond, 0.0, static_cast<double>(hops));
    return static_cast<std::size_t>(hop);
}

// The sound of [from, to) seconds, appended.
void add_sound(const SongRecording& song,
               const BandMeans& usual,
               double from,
               double to,
               std::vector<float>& sound) {
    const std::size_t hops = song.sounds.size();
    const std::size_t first = std::min(hop_of_moment(from, hops), hops - 1);
    const BandMeans now = mean_of(song, first, std::max(first + 1, hop_of_moment(to, hops)));
    for (std::size_t band = 0; band < kBands; ++band) {
        const float share = usual[band] > 0.0F ? now[band] / usual[band] : 0.0F;
        sound.push_back(20.0F * std::log10(share + kFaint));
    }
}

// What the music does in most hops of a bar.
MusicPart part_between(std::span<const MusicState> states, double from, double to) {
    std::array<std::size_t, kMusicPartNames.size()> counts{};
    for (std::size_t hop = hop_of_moment(from, states.size());
         hop < hop_of_moment(to, states.size());
         ++hop) {
        ++counts[static_cast<std::size_t>(states[hop].part)];
    }
    return static_cast<MusicPart>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

// Beats [first, end) of a song as a bar; its end is the next beat, or a beat after the last.
SongBar bar_of(const SongRecording& song,
               const BandMeans& usual,
               std::span<const SongBeat> beats,
               std::size_t first,
               std::size_t end,
               std::span<const MusicState> states) {
    const auto time_of = [&](std::size_t beat) {
        return beat < beats.size()
                   ? to_seconds(beats[beat].time)
                   : 2.0 * to_seconds(beats[beat - 1].time) - to_seconds(beats[beat - 2].time);
    };
    SongBar bar;
    bar.time = beats[first].time;
    bar.beats = static_cast<int>(end - first);
    bar.part = part_between(states, time_of(first), time_of(end));
    for (std::size_t beat = first; beat < end; ++beat) {
        const double half = 0.5 * (time_of(beat + 1) - time_of(beat));
        const double from = time_of(beat) - kEarly * half;
        add_sound(song, usual, from, from + half, bar.sound);
        add_sound(song, usual, from + half, from + 2.0 * half, bar.sound);
    }
    return bar;
}

}  // namespace

std::vector<SongBar> bars_of(const SongRecording& song,
                             const std::vector<SongBeat>& beats,
                             std::span<const MusicState> states) {
    std::vector<SongBar> bars;
    if (states.empty() || beats.size() < 2) {
        return bars;
    }
    const BandMeans usual = mean_of(song, 0, song.sounds.size());
    const Foresight& ahead = states.front().ahead;
    for (std::size_t first = 0; first < beats.size() && bars.size() < kMostBars;) {
        std::size_t end = first + 1;
        while (end < beats.size() && beats[end].place.position != 0) {
            ++end;
        }
        if (beats[first].place.position == 0 && beats[first].time >= ahead.begins &&
            beats[first].time <= ahead.ends) {
            bars.push_back(bar_of(song, usual, beats, first, end, states));
        }
        first = end;
    }
    return bars;
}

BarDifference difference_of(const SongBar& a, const SongBar& b) noexcept {
    BarDifference difference;
    if (a.beats != b.beats || a.part != b.part) {
        return difference;
    }
    float sum = 0.0F;
    float squares = 0.0F;
    for (std::size_t i = 0; i < a.sound.size(); ++i) {
        const float apart = a.sound[i] - b.sound[i];
        sum += apart;
        squares += apart * apart;
    }
    const auto count = static_cast<float>(a.sound.size());
    const float mean = sum / count;
    difference.is_known = true;
    difference.level = std::abs(mean);
    difference.shape = std::sqrt(std::max(0.0F, squares / count - mean * mean));
    return difference;
}

float alike_shape(std::span<const SongBar> bars) {
    const CounterRandom random(1);
    std::vector<float> shapes;
    for (std::uint64_t i = 0; i < kPairs && bars.size() > 1; ++i) {
        const std::size_t a = random.below(2 * i, bars.size());
        const std::size_t b = random.below(2 * i + 1, bars.size());
        const BarDifference difference = difference_of(bars[a], bars[b]);
        if (a != b && difference.is_known) {
            shapes.push_back(difference.shape);
        }
    }
    const float usual = shapes.empty() ? 0.0F : upper_median(std::move(shapes));
    return std::clamp(kOfUsualShape * usual, kLeastShape, kMostShape);
}

float distance_of(const SongBar& a, const SongBar& b, float alike_shape) noexcept {
    const BarDifference difference = difference_of(a, b);
    return difference.is_known
               ? std::max(difference.shape / alike_shape, difference.level / kAlikeLevel)
               : std::numeric_limits<float>::infinity();
}

void write_bars(const SongRecording& song,
                const std::vector<SongBeat>& beats,
                std::vector<MusicState>& states) {
    const std::vector<SongBar> bars = bars_of(song, beats, states);
    std::vector<char> begins_part(bars.size(), 1);
    for (std::size_t bar = 1; bar < bars.size(); ++bar) {
        begins_part[bar] = bars[bar].part != bars[bar - 1].part ? 1 : 0;
    }
    const float alike = alike_shape(bars);
    const std::vector<int> repeats = find_repeats(begins_part, [&](std::size_t a, std::size_t b) {
        return distance_of(bars[a], bars[b], alike);
    });
    std::size_t begun = 0;  // bars so far
    for (MusicState& state : states) {
        while (begun < bars.size() && bars[begun].time < state.time + kHop) {
            ++begun;
        }
        state.ahead.bar = static_cast<int>(begun) - 1;
        for (std::size_t i = 0; i < state.ahead.repeats.size(); ++i) {
            // Bar `begun` + i - 1, which before the first bar may not exist.
            const std::size_t after = begun + i;
            const bool is_known = after >= 1 && after <= repeats.size();
            state.ahead.repeats[i] = static_cast<std::int16_t>(is_known ? repeats[after - 1] : -1);
        }
    }
}

}  // namespace raks::audio
