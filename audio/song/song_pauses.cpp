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
constexpr std::size_t kHabit = 3;

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

// All gaps, short ones included.
std::vector<SongPause> find_gaps(std::span<const HopSound> sounds) {
    const std::vector<float> quiet = quiet_levels(sounds);
    std::vector<SongPause> gaps;
    for (std::size_t i = 0; i < sounds.size(); ++i) {
        if (sounds[i].level >= quiet[i / kBlock]) {
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
    for (const SongPause& gap : gaps) {
        const bool is_edge = gap.first == 0 || gap.end == sounds.size();
        if (is_edge || (gap.hops() >= least_hops && !is_habit(gaps, gap))) {
            pauses.push_back(gap);
        }
    }
    return pauses;
}

}  // namespace raks::audio
