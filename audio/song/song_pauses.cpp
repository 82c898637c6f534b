#include "audio/song/song_pauses.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raks::audio {
namespace {

constexpr float kUnder = 30.0F;          // dB under the loudest of late: quiet
constexpr float kLeastLevel = -72.0F;    // dBFS: quiet whatever is around
constexpr std::size_t kLoudestOf = 100;  // hops of which the loudest is kept
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
    std::vector<float> loudest(sounds.size() / kLoudestOf + 1, -120.0F);
    for (std::size_t i = 0; i < sounds.size(); ++i) {
        loudest[i / kLoudestOf] = std::max(loudest[i / kLoudestOf], sounds[i].level);
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

// Whether one of the hops before `hop` was about as loud as what was played.
bool was_near(std::span<const HopSound> sounds, std::size_t hop, double played) {
    const auto before = sounds.subspan(hop - kDampedHops, kDampedHops);
    return std::any_of(before.begin(), before.end(), [played](const HopSound& sound) {
        return static_cast<double>(sound.level) > played - static_cast<double>(kNearPlayed);
    });
}

// Finds the hops that are quiet, hop by hop.
class QuietHops {
 public:
    explicit QuietHops(std::span<const HopSound> sounds)
        : sounds_(sounds), levels_(quiet_levels(sounds)), quiet_(sounds.size()) {
        for (std::size_t hop = 0; hop < sounds.size(); ++hop) {
            add(hop);
        }
    }
    // By hop: whether it is quiet.
    [[nodiscard]] std::vector<char> take() { return std::move(quiet_); }

 private:
    [[nodiscard]] bool is_under_level(std::size_t hop) const {
        return sounds_[hop].level < levels_[hop / kLoudestOf];
    }

    void add(std::size_t hop) {
        const float level = sounds_[hop].level;
        const bool is_low =
            static_cast<double>(level) < played_ - static_cast<double>(kDampedUnder);
        if (!is_damped_ && is_low && sounding_ >= kPlayedHops) {
            is_damped_ = was_near(sounds_, hop, played_);
        }
        is_damped_ = is_damped_ && is_low;
        quiet_[hop] = static_cast<char>(is_under_level(hop) || is_damped_);
        if (quiet_[hop] != 0) {
            begin_ = sounding_ > 0 ? hop : begin_;
            deepest_ = sounding_ > 0 ? level : std::min(deepest_, level);
            sounding_ = 0;
        } else {
            end_quiet(hop);
            ++sounding_;
            const double share = sounding_ == 1 ? 1.0 : 1.0 / static_cast<double>(kPlayedHops);
            played_ += share * (static_cast<double>(level) - played_);
        }
    }

    // The hop sounds. Where what was quiet before it was not deep, it was a gap in softer music.
    void end_quiet(std::size_t hop) {
        if (sounding_ > 0 ||
            static_cast<double>(deepest_) <= played_ - static_cast<double>(kDeepUnder)) {
            return;
        }
        for (std::size_t at = begin_; at < hop; ++at) {
            quiet_[at] = static_cast<char>(is_under_level(at));
        }
    }

    std::span<const HopSound> sounds_;
    std::vector<float> levels_;
    std::vector<char> quiet_;
    double played_ = -120.0;    // dBFS, mean of the half second before the newest hop that sounds
    std::size_t sounding_ = 0;  // hops in a row
    bool is_damped_ = false;
    std::size_t begin_ = 0;  // of the present quiet
    float deepest_ = 0.0F;   // dBFS in it
};

// All gaps, short ones included.
std::vector<SongPause> find_gaps(std::span<const HopSound> sounds) {
    const std::vector<char> quiet = QuietHops(sounds).take();
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
