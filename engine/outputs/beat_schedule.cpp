#include "engine/outputs/beat_schedule.hpp"

#include <algorithm>
#include <cmath>

namespace raks::engine {
namespace {

// From the last beat on, the next one is at least this far: what is nearer is the last one again.
constexpr double kNearestBeats = 0.5;
// A beat off by more than this, or a tempo that differs by more, is a jump.
constexpr double kJumpBeats = 0.25;
constexpr double kJumpTempo = 0.08;
// Rounding of times to nanoseconds must not hide the beat that stands at a moment itself.
constexpr double kSameBeat = 1e-6;

}  // namespace

void BeatSchedule::take(const MusicState& state) noexcept {
    grid_ = state.grid;
    const bool is_locked = grid_.confidence >= BeatGrid::kDanceable;
    if (is_locked && !is_locked_) {
        begins_ = state.time;
        told_at_.reset();
        bar_ = 0;
    }
    is_locked_ = is_locked;
    if (state.event.kind == MusicEvent::Kind::none) {
        return;
    }
    if (event_count_ == kMostEvents) {
        drop_first_event();
    }
    // Few, and nearly always in order.
    const auto end = events_.begin() + static_cast<std::ptrdiff_t>(event_count_);
    const auto place = std::upper_bound(
        events_.begin(), end, state.event.time, [](StreamTime time, const MusicEvent& event) {
            return time < event.time;
        });
    std::move_backward(place, end, end + 1);
    *place = state.event;
    ++event_count_;
}

void BeatSchedule::drop_first_event() noexcept {
    std::move(events_.begin() + 1,
              events_.begin() + static_cast<std::ptrdiff_t>(event_count_),
              events_.begin());
    --event_count_;
}

// The number in the grid of the beat that comes next; nothing while there are none.
std::optional<double> BeatSchedule::next_beat() const noexcept {
    if (!is_locked_) {
        return std::nullopt;
    }
    const double from = told_at_ ? grid_.beats_at(*told_at_).count() + kNearestBeats
                                 : grid_.beats_at(begins_).count();
    return std::ceil(from - kSameBeat);
}

std::optional<StreamTime> BeatSchedule::next_time() const noexcept {
    std::optional<StreamTime> time;
    if (event_count_ > 0) {
        time = events_[0].time;
    }
    if (const auto beat = next_beat()) {
        const StreamTime at = grid_.time_of(Beats(*beat));
        time = std::min(time.value_or(at), at);
    }
    return time;
}

std::optional<Notice> BeatSchedule::next(StreamTime heard) noexcept {
    const Nanos half = nanos_from_seconds(0.5 * grid_.tempo.seconds_per_beat());
    bool is_change = false;
    while (const auto due = next_time()) {
        if (*due > heard) {
            break;
        }
        if (event_count_ > 0 && events_[0].time == *due) {
            Notice notice{.kind = Notice::Kind::event, .time = *due, .tempo = grid_.tempo};
            notice.confidence = grid_.confidence;
            notice.event = events_[0].kind;
            drop_first_event();
            return notice;
        }
        Notice beat = tell_beat(*next_beat());
        is_change = beat.is_change = beat.is_change || is_change;
        if (heard - beat.time < half) {
            return beat;
        }
        ++missed_;
    }
    // A grid that moves makes no beat of what has been heard already.
    begins_ = std::max(begins_, heard);
    return std::nullopt;
}

Notice BeatSchedule::tell_beat(double beat) noexcept {
    Notice notice{.time = grid_.time_of(Beats(beat)), .tempo = grid_.tempo};
    notice.count = 1 + static_cast<int>(grid_.bar_position(Beats(beat)) + kJumpBeats);
    notice.confidence = grid_.confidence;
    if (told_at_) {
        const double way = to_seconds(notice.time - *told_at_) * told_tempo_.beats_per_second();
        notice.is_change = std::abs(way - 1.0) > kJumpBeats ||
                           std::abs(grid_.tempo.bpm() / told_tempo_.bpm() - 1.0) > kJumpTempo;
    } else {
        notice.is_change = true;
    }
    bar_ += notice.count == 1 || bar_ == 0 ? 1 : 0;
    notice.bar = bar_;
    told_at_ = notice.time;
    told_tempo_ = grid_.tempo;
    return notice;
}

}  // namespace raks::engine
