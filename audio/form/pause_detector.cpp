#include "audio/form/pause_detector.hpp"

#include <algorithm>

namespace raks::audio {
namespace {

// No music was heard yet, dB.
constexpr float kUnheard = -200.0F;

// Levels are in dB full scale. Music is quiet where it is so many dB under the loudest of late, or
// under this level whatever was heard.
constexpr float kQuietDecibels = 30.0F;
constexpr float kLeastLevel = -72.0F;
// After a stop music sounds again when it is so many dB over the quiet level and over the noise of
// the stop. The first music of all is louder than this level.
constexpr float kEntryDecibels = 6.0F;
constexpr float kOverNoiseDecibels = 8.0F;
constexpr float kFirstLevel = -58.0F;
// For so many hops in a row it must sound.
constexpr int kEntryHops = 2;
// The loudest of late falls by so many dB a hop while music sounds, and faster while it is stopped,
// as the next song may be softer.
constexpr float kLoudFallDecibels = 0.06F;
constexpr float kStoppedFallDecibels = 0.10F;
// In a gap of more than so many hops the loudest of late does not fall.
constexpr int kHeldAfterHops = 20;
// The noise of a stop follows the level by this share a hop.
constexpr float kNoiseShare = 0.05F;

// A sound that falls by so many dB within 30 ms was cut: no instrument falls so fast.
constexpr float kCutDecibels = 40.0F;
// Players who damp their strings and cymbals stop within 100 ms, though hiss and the room go on: so
// many dB under the usual level of the last second, which is followed by this share a hop.
constexpr float kDampedDecibels = 24.0F;
constexpr float kDeepDecibels = 28.0F;  // that it reaches, or it was a gap in softer music
constexpr float kPlayingShare = 0.02F;
constexpr float kNearPlaying = 6.0F;
// The shortest pause that is a stop, in hops: where the sound was cut; damped; where it faded, as
// between two notes, which also takes such a share of a beat; and while the habits of the song are
// not known.
constexpr int kAnnouncedStopHops = 2;  // it is known to come
constexpr int kCutStopHops = 8;
constexpr int kDampedStopHops = 26;
constexpr float kDampedStopBeats = 0.55F;
constexpr int kFadedStopHops = 26;
constexpr float kFadedStopBeats = 0.9F;
constexpr int kUnsureStopHops = 70;
// No gap between notes is longer than this: a longer pause is always a stop.
constexpr int kLongestGapHops = 150;
// Shorter dips are the ripple of low notes and no gaps.
constexpr int kShortestGapHops = 3;
// The habits of a song are known when it has sounded for so many hops. So many gaps make a habit;
// of a gap that is no longer than the last number of hops, one does. Gaps that are older than this
// do not count.
constexpr int kHabitHops = 500;
constexpr std::size_t kHabitGaps = 4;
constexpr int kShortGapHops = 40;
constexpr HopIndex kRememberedHops = 1200;
// A stop of 3 s is the end.
constexpr int kEndHops = 300;

}  // namespace

float PauseDetector::quiet_level() const noexcept {
    return std::max(loud_ - kQuietDecibels, kLeastLevel);
}

void PauseDetector::follow_level(float level) noexcept {
    loud_ = std::max(level, loud_ - (is_stopped_ ? kStoppedFallDecibels : kLoudFallDecibels));
}

// A pause must be longer than the fourth longest gap of the last 12 s: what the song did up to
// three times is a stop of its own, what it did more often is how it is played. A short gap needs
// no others.
int PauseDetector::hops_to_stop(HopIndex hop, int beat) const noexcept {
    if (announced_hops_ > 0) {
        return kAnnouncedStopHops;
    }
    std::array<int, kHabitGaps> longest{};  // descending
    int habit = 0;
    const std::size_t count = std::min(gap_count_, kGaps);
    for (std::size_t i = 0; i < count; ++i) {
        int length = gaps_[i].ended > hop - kRememberedHops ? gaps_[i].hops : 0;
        habit = length <= kShortGapHops ? std::max(habit, length) : habit;
        for (int& other : longest) {
            if (length > other) {
                std::swap(length, other);
            }
        }
    }
    habit = std::max(habit, longest.back());
    const int faded =
        std::max(kFadedStopHops, static_cast<int>(kFadedStopBeats * static_cast<float>(beat)));
    const int damped =
        std::max(kDampedStopHops, static_cast<int>(kDampedStopBeats * static_cast<float>(beat)));
    const bool is_deep = is_damped_ && playing_ - deepest_ > kDeepDecibels;
    const int least = heard_hops_ < kHabitHops ? kUnsureStopHops
                      : is_cut_                ? kCutStopHops
                      : is_deep                ? damped
                                               : faded;
    return std::clamp(habit + habit / 4 + 2, least, kLongestGapHops);
}

void PauseDetector::remember(HopIndex hop) noexcept {
    if (quiet_hops_ >= kShortestGapHops && quiet_hops_ <= kLongestGapHops) {
        gaps_[gap_count_ % kGaps] = {hop, quiet_hops_};
        ++gap_count_;
    }
    quiet_hops_ = 0;
}

// Whether this hop is quiet; a sound that was damped is at a higher level.
bool PauseDetector::is_below(float level) noexcept {
    deepest_ = quiet_hops_ == 0 ? level : std::min(deepest_, level);
    if (quiet_hops_ == 0) {
        is_damped_ = *std::max_element(before_.begin(), before_.end()) > playing_ - kNearPlaying &&
                     playing_ - level > kDampedDecibels;
    }
    return level < quiet_level() || (is_damped_ && playing_ - level > kDampedDecibels);
}

// One hop while music plays: has it stopped?
MusicEvent PauseDetector::listen(HopIndex hop, float level, int beat) noexcept {
    if (!is_below(level)) {
        playing_ += kPlayingShare * (level - playing_);
        remember(hop);
        heard_hops_ = std::min(heard_hops_ + 1, kHabitHops);
        std::shift_left(before_.begin(), before_.end(), 1);
        before_.back() = level;
        return {};
    }
    if (quiet_hops_ < 2) {
        // The hop in which it was cut is half full.
        is_cut_ = *std::max_element(before_.end() - 3, before_.end()) - level >= kCutDecibels;
    }
    if (++quiet_hops_ < hops_to_stop(hop, beat)) {
        return {};
    }
    is_stopped_ = true;
    has_ended_ = false;
    loud_hops_ = 0;
    resting_ = level;
    return {MusicEvent::Kind::stop, time_of_hop(hop - quiet_hops_ + 1)};
}

// One hop while nothing plays. For music to come in, the level must rise over the threshold and
// over the noise of the pause; a long pause is the end.
MusicEvent PauseDetector::wait(HopIndex hop, float level) noexcept {
    const float threshold = loud_ == kUnheard ? kFirstLevel : quiet_level() + kEntryDecibels;
    if (level >= std::max(threshold, resting_ + kOverNoiseDecibels)) {
        if (++loud_hops_ >= kEntryHops) {
            is_stopped_ = false;
            playing_ = level;
            if (has_ended_) {
                // Another song has its own habits.
                heard_hops_ = 0;
                gap_count_ = 0;
            }
            quiet_hops_ -= loud_hops_ - 1;
            remember(hop);
            return {MusicEvent::Kind::entry, time_of_hop(hop - loud_hops_ + 1)};
        }
    } else {
        loud_hops_ = 0;
        resting_ += kNoiseShare * (level - resting_);
    }
    ++quiet_hops_;
    if (quiet_hops_ >= kEndHops && !has_ended_) {
        has_ended_ = true;
        return {MusicEvent::Kind::end, time_of_hop(hop - quiet_hops_ + 1)};
    }
    quiet_hops_ = std::min(quiet_hops_, kEndHops);
    return {};
}

MusicEvent PauseDetector::advance(HopIndex hop, float level, int beat) noexcept RAKS_NONBLOCKING {
    const MusicEvent event = is_stopped_ ? wait(hop, level) : listen(hop, level, beat);
    announced_hops_ = std::max(announced_hops_ - 1, 0);
    // The noise before the music is not heard yet. In a gap the loudest is kept: it must not fall
    // to the noise in it.
    const bool is_in_gap = !is_stopped_ && quiet_hops_ > kHeldAfterHops;
    if ((!is_stopped_ || loud_ != kUnheard) && !is_in_gap) {
        follow_level(level);
    }
    return event;
}

}  // namespace raks::audio
