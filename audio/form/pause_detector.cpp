#include "audio/form/pause_detector.hpp"

#include <algorithm>

namespace raks::audio {
namespace {

constexpr float kUnheard = -200.0F;
constexpr float kUnder = 30.0F;          // dB under the loudest of late: quiet
constexpr float kOver = 6.0F;            // dB over that: sounds again
constexpr float kLeastLevel = -72.0F;    // dBFS: quiet whatever was heard
constexpr float kFirstLevel = -58.0F;    // dBFS: music that begins is louder
constexpr float kOverRest = 8.0F;        // dB over the noise of a stop: sounds again
constexpr float kForget = 0.06F;         // dB a hop that the loudest falls while music sounds
constexpr int kKeptAfter = 20;           // hops of a gap after which it is kept
constexpr float kForgetLong = 0.01F;     // and the loudest of the song
constexpr float kFarUnder = 50.0F;       // dB under that: quiet, however soft the music was
constexpr float kForgetStopped = 0.10F;  // and while it is stopped: the next song may be softer
constexpr float kRestRate = 0.05F;       // a hop, of the smoothed level of a stop
constexpr int kEntryHops = 2;            // that must sound in a row
constexpr float kCut = 40.0F;            // dB within 30 ms: no instrument falls so fast
constexpr int kStopHops = 8;             // least pause that is a stop where the sound was cut
constexpr int kFadedHops = 26;           // and where it faded, as between two notes,
constexpr float kFadedBeats = 0.9F;      // at least; and so much of a beat
constexpr int kUnsureHops = 70;          // while the song's habits are not known
constexpr int kMostHops = 150;           // beyond any gap between notes
constexpr int kHabitHops = 500;          // heard before habits are known
constexpr HopIndex kRemembered = 1200;   // hops: older gaps are no habit
constexpr std::size_t kHabit = 3;        // gaps that make one
constexpr int kShortGap = 40;            // hops: one such gap is a habit already
constexpr int kShortestGap = 3;          // hops: shorter dips are the ripple of low notes
constexpr int kEndHops = 300;            // a stop of 3 s is the end

}  // namespace

float PauseDetector::quiet_level() const noexcept { return std::max(loud_ - kUnder, kLeastLevel); }

void PauseDetector::follow_level(float level) noexcept {
    loud_ = std::max(level, loud_ - (is_stopped_ ? kForgetStopped : kForget));
    song_ = std::max(level, song_ - (is_stopped_ ? kForgetStopped : kForgetLong));
}

// A pause must be longer than the third longest gap of the last 12 s: what the song did once or
// twice is a stop of its own, what it did more often is how it is played. A short gap needs no
// others.
int PauseDetector::hops_to_stop(HopIndex hop, int beat) const noexcept {
    std::array<int, kHabit> longest{};  // descending
    int habit = 0;
    const std::size_t count = std::min(gap_count_, kGaps);
    for (std::size_t i = 0; i < count; ++i) {
        int length = gaps_[i].ended > hop - kRemembered ? gaps_[i].hops : 0;
        habit = length <= kShortGap ? std::max(habit, length) : habit;
        for (int& other : longest) {
            if (length > other) {
                std::swap(length, other);
            }
        }
    }
    habit = std::max(habit, longest.back());
    const int faded =
        std::max(kFadedHops, static_cast<int>(kFadedBeats * static_cast<float>(beat)));
    const int least = heard_hops_ < kHabitHops ? kUnsureHops : is_cut_ ? kStopHops : faded;
    return std::clamp(habit + habit / 4 + 2, least, kMostHops);
}

void PauseDetector::remember(HopIndex hop) noexcept {
    if (quiet_hops_ >= kShortestGap && quiet_hops_ <= kMostHops) {
        gaps_[gap_count_ % kGaps] = {hop, quiet_hops_};
        ++gap_count_;
    }
    quiet_hops_ = 0;
}

// While music plays.
MusicEvent PauseDetector::listen(HopIndex hop, float level, int beat) noexcept {
    if (level >= quiet_level()) {
        remember(hop);
        heard_hops_ = std::min(heard_hops_ + 1, kHabitHops);
        std::shift_left(before_.begin(), before_.end(), 1);
        before_.back() = level;
        return {};
    }
    if (quiet_hops_ < 2) {
        // The hop in which it was cut is half full.
        is_cut_ = *std::max_element(before_.begin(), before_.end()) - level >= kCut;
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

// While nothing plays: the level must rise over the threshold and over the noise of the pause.
MusicEvent PauseDetector::wait(HopIndex hop, float level) noexcept {
    const float threshold = loud_ == kUnheard ? kFirstLevel : quiet_level() + kOver;
    if (level >= std::max(threshold, resting_ + kOverRest)) {
        if (++loud_hops_ >= kEntryHops) {
            is_stopped_ = false;
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
        resting_ += kRestRate * (level - resting_);
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
    // The noise before the music is not heard yet. In a gap the loudest is kept: it must not fall
    // to the noise in it.
    const bool is_in_gap = !is_stopped_ && quiet_hops_ > kKeptAfter;
    if ((!is_stopped_ || loud_ != kUnheard) && !is_in_gap) {
        follow_level(level);
    }
    return event;
}

}  // namespace raks::audio
