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

Bpm paced(Bpm tempo, BeatSchedule::Pace pace) noexcept {
    constexpr std::array kFactors = {0.5, 1.0, 2.0};  // in the order of Pace
    return Bpm(tempo.bpm() * kFactors[static_cast<std::size_t>(pace)]);
}

}  // namespace

void BeatSchedule::take(const MusicState& state) noexcept {
    grid_ = state.grid;
    const bool is_locked = grid_.confidence >= BeatGrid::kDanceable || state.is_tempo_held;
    if (is_locked && !is_locked_) {
        begins_ = state.time;
        told_at_.reset();
        bar_ = 0;
    }
    is_locked_ = is_locked;
    Notice notice{.tempo = grid_.tempo, .paced_tempo = paced(grid_.tempo, pace_)};
    notice.confidence = grid_.confidence;
    if (state.event.kind != MusicEvent::Kind::none) {
        notice.kind = Notice::Kind::event;
        notice.time = state.event.time;
        notice.event = state.event.kind;
        keep(notice);
    }
    if (state.accent.strength > 0.0F) {
        notice.kind = Notice::Kind::accent;
        notice.time = state.accent.time;
        notice.event = MusicEvent::Kind::none;
        notice.accent = state.accent;
        keep(notice);
    }
}

// Few, and nearly always in order.
void BeatSchedule::keep(const Notice& notice) noexcept {
    if (waiting_count_ == kMostWaiting) {
        drop_first();
    }
    const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(waiting_count_);
    const auto place = std::upper_bound(
        waiting_.begin(), end, notice.time, [](StreamTime time, const Notice& other) {
            return time < other.time;
        });
    std::move_backward(place, end, end + 1);
    *place = notice;
    ++waiting_count_;
}

void BeatSchedule::drop_first() noexcept {
    std::move(waiting_.begin() + 1,
              waiting_.begin() + static_cast<std::ptrdiff_t>(waiting_count_),
              waiting_.begin());
    --waiting_count_;
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

std::optional<StreamTime> BeatSchedule::next_beat_time() const noexcept {
    const auto beat = next_beat();
    return beat ? std::optional(grid_.time_of(Beats(*beat))) : std::nullopt;
}

// By the tempo from the last beat on, so that a grid that moves makes none twice. One that the next
// beat has come near is left out.
std::optional<StreamTime> BeatSchedule::half_beat_time() const noexcept {
    if (!owes_half_ || !is_locked_ || !told_at_) {
        return std::nullopt;
    }
    const double beat = grid_.tempo.seconds_per_beat();
    const StreamTime half = *told_at_ + nanos_from_seconds(0.5 * beat);
    const auto next = next_beat_time();
    return next && *next - half >= nanos_from_seconds(kJumpBeats * beat) ? std::optional(half)
                                                                         : std::nullopt;
}

std::optional<StreamTime> BeatSchedule::next_time() const noexcept {
    std::optional<StreamTime> time;
    if (waiting_count_ > 0) {
        time = waiting_[0].time;
    }
    for (const auto& at : {half_beat_time(), next_beat_time()}) {
        time = at ? std::min(time.value_or(*at), *at) : time;
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
        if (waiting_count_ > 0 && waiting_[0].time == *due) {
            const Notice notice = waiting_[0];
            drop_first();
            return notice;
        }
        if (half_beat_time() == due) {
            const Notice notice = tell_half_beat();
            if (heard - notice.time < half) {
                return notice;
            }
            continue;
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

// Of two beats in a row one at most; in bars of an even length the odd counts.
bool BeatSchedule::is_next_paced(int count) noexcept {
    if (pace_ != Pace::half) {
        return true;
    }
    was_paced_ = grid_.beats_per_bar % 2 == 0 || !told_at_ ? count % 2 == 1 : !was_paced_;
    return was_paced_;
}

Notice BeatSchedule::tell_half_beat() noexcept {
    owes_half_ = false;
    Notice notice{.time = *told_at_ + nanos_from_seconds(0.5 * grid_.tempo.seconds_per_beat())};
    notice.count = count_;
    notice.bar = bar_;
    notice.tempo = grid_.tempo;
    notice.paced_tempo = paced(grid_.tempo, pace_);
    notice.confidence = grid_.confidence;
    notice.is_counted = false;
    return notice;
}

Notice BeatSchedule::tell_beat(double beat) noexcept {
    Notice notice{.time = grid_.time_of(Beats(beat)), .tempo = grid_.tempo};
    notice.count = 1 + static_cast<int>(grid_.bar_position(Beats(beat)) + kJumpBeats);
    notice.confidence = grid_.confidence;
    notice.paced_tempo = paced(grid_.tempo, pace_);
    notice.is_paced = is_next_paced(notice.count);
    if (told_at_) {
        const double way = to_seconds(notice.time - *told_at_) * told_tempo_.beats_per_second();
        notice.is_change = std::abs(way - 1.0) > kJumpBeats ||
                           std::abs(grid_.tempo.bpm() / told_tempo_.bpm() - 1.0) > kJumpTempo;
    } else {
        notice.is_change = true;
    }
    bar_ += notice.count == 1 || bar_ == 0 ? 1 : 0;
    notice.bar = bar_;
    count_ = notice.count;
    told_at_ = notice.time;
    told_tempo_ = grid_.tempo;
    owes_half_ = pace_ == Pace::twice;
    return notice;
}

}  // namespace raks::engine
