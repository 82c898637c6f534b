#include "audio/song/song_pauses.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

constexpr float kUnder = 30.0F;          // dB under the loudest of late: quiet
constexpr float kLeastLevel = -72.0F;    // dBFS: quiet whatever is around
constexpr std::size_t kBlock = 100;      // hops of which the loudest is kept
constexpr std::size_t kBefore = 2;       // blocks before
constexpr float kFarUnder = 50.0F;       // dB under the loudest of the song: quiet in any case
constexpr std::size_t kShortestGap = 3;  // of a gap: shorter dips are the ripple of low notes
// A pause is a habit of the music, and no stop, where at least kHabit others of about its length or
// longer lie within kHabitHops before or after it.
constexpr std::size_t kHabitHops = 1600;
constexpr std::size_t kHabit = 6;
// The habits of a song are not known in its first seconds: only a long pause is a stop there.
constexpr std::size_t kUnknownHops = 500;
constexpr std::size_t kUnsureHops = 70;
// A sound that was damped: within so many hops it falls this far under what it was for half a
// second before, and it is a pause until it is louder again.
constexpr std::size_t kDampedHops = 10;
constexpr std::size_t kPlayedHops = 50;
constexpr float kDampedUnder = 24.0F;
constexpr float kDeepUnder = 28.0F;  // that it reaches
constexpr float kNearPlayed = 6.0F;

// By block: the level under which a hop is quiet.
std::vector<float> quiet_levels(std::span<const HopSound> sounds) {
    std::vector<float> loudest(sounds.size() / kBlock + 1, -120.0F);
    for (std::size_t i = 0; i < sounds.size(); ++i) {
        loudest[i / kBlock] = std::max(loudest[i / kBlock], sounds[i].level);
    }
    const float song = *std::max_element(loudest.begin(), loudest.end());
    std::vector<float> quiet(loudest.size());
    for (std::size_t i = 0; i < loudest.size(); ++i) {
        const std::size_t first = i - std::min(i, kBefore);
        const float around =
            *std::max_element(loudest.begin() + static_cast<std::ptrdiff_t>(first),
                              loudest.begin() + static_cast<std::ptrdiff_t>(i + 1));
        quiet[i] = std::max({around - kUnder, song - kFarUnder, kLeastLevel});
    }
    return quiet;
}

// By hop: whether it is quiet.
std::vector<char> quiet_hops(std::span<const HopSound> sounds) {
    const std::vector<float> levels = quiet_levels(sounds);
    std::vector<char> quiet(sounds.size());
    double played = -120.0;    // dBFS, mean of the half second before the newest hop that sounds
    std::size_t sounding = 0;  // hops in a row
    bool is_damped = false;
    std::size_t begin = 0;  // of the present quiet
    float deepest = 0.0F;   // dBFS in it
    for (std::size_t i = 0; i < sounds.size(); ++i) {
        const float level = sounds[i].level;
        const bool is_low = static_cast<double>(level) < played - static_cast<double>(kDampedUnder);
        if (!is_damped && is_low && sounding >= kPlayedHops) {
            for (std::size_t ago = 1; ago <= kDampedHops; ++ago) {
                is_damped = is_damped || static_cast<double>(sounds[i - ago].level) >
                                             played - static_cast<double>(kNearPlayed);
            }
        }
        is_damped = is_damped && is_low;
        quiet[i] = static_cast<char>(level < levels[i / kBlock] || is_damped);
        if (quiet[i] != 0) {
            begin = sounding > 0 ? i : begin;
            deepest = sounding > 0 ? level : std::min(deepest, level);
        } else if (sounding == 0 &&
                   static_cast<double>(deepest) > played - static_cast<double>(kDeepUnder)) {
            // It was a gap in softer music.
            for (std::size_t at = begin; at < i; ++at) {
                quiet[at] = static_cast<char>(sounds[at].level < levels[at / kBlock]);
            }
        }
        sounding = quiet[i] != 0 ? 0 : sounding + 1;
        if (quiet[i] == 0) {
            const double share = sounding == 1 ? 1.0 : 1.0 / static_cast<double>(kPlayedHops);
            played += share * (static_cast<double>(level) - played);
        }
    }
    return quiet;
}

// All gaps, short ones included.
std::vector<SongPause> find_gaps(std::span<const HopSound> sounds) {
    const std::vector<char> quiet = quiet_hops(sounds);
    std::vector<SongPause> gaps;
    for (std::size_t i = 0; i < sounds.size(); ++i) {
        if (quiet[i] == 0) {
            continue;
        }
        if (!gaps.empty() && gaps.back().end == i) {
            ++gaps.back().end;
        } else {
            gaps.push_back({i, i + 1});
        }
    }
    std::erase_if(gaps, [](const SongPause& gap) { return gap.hops() < kShortestGap; });
    return gaps;
}

// Whether enough others near it are about as long.
bool is_habit(const std::vector<SongPause>& gaps, const SongPause& gap) {
    const auto alike = std::count_if(gaps.begin(), gaps.end(), [&](const SongPause& other) {
        const std::size_t apart =
            other.first > gap.first ? other.first - gap.first : gap.first - other.first;
        return apart > 0 && apart <= kHabitHops && 4 * other.hops() >= 3 * gap.hops();
    });
    return static_cast<std::size_t>(alike) >= kHabit;
}

}  // namespace

std::vector<SongPause> find_pauses(std::span<const HopSound> sounds, std::size_t least_hops) {
    const std::vector<SongPause> gaps = find_gaps(sounds);
    std::vector<SongPause> pauses;
    const std::size_t begin = !gaps.empty() && gaps.front().first == 0 ? gaps.front().end : 0;
    for (const SongPause& gap : gaps) {
        const bool is_edge = gap.first == 0 || gap.end == sounds.size();
        const std::size_t least =
            gap.first < begin + kUnknownHops ? std::max(least_hops, kUnsureHops) : least_hops;
        if (is_edge || (gap.hops() >= least && !is_habit(gaps, gap))) {
            pauses.push_back(gap);
        }
    }
    return pauses;
}

}  // namespace raks::audio
