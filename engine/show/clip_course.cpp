#include "engine/show/clip_course.hpp"

#include <algorithm>
#include <cmath>

namespace raks::engine {
namespace {

constexpr double kPatience = 4.0;        // seconds that are waited for music with a beat
constexpr long long kPhraseBars = 8;     // as others are told of phrases (/trigger/phrase)
constexpr double kGain = 1.5;            // of the error in seconds, a second
constexpr double kMostCorrection = 0.1;  // of the rate
constexpr double kAstray = 1.0;          // beats of error that are not caught up with

bool is_danceable(const MusicState& music) noexcept {
    return music.is_tempo_held || music.grid.confidence >= BeatGrid::kDanceable;
}

// Numbered from the start of the beats, so that a grid that names another of its downbeats as its
// origin keeps the numbers.
long long bar_at(const BeatGrid& grid, StreamTime moment) noexcept {
    const double bar = grid.beats_per_bar;
    const double origin = std::fmod(grid.bar_origin.count(), bar);
    return std::llround(std::floor((grid.beats_at(moment).count() - origin) / bar + 1e-6));
}

}  // namespace

void ClipCourse::begin_anew() noexcept {
    stage_ = Stage::waiting;
    waits_since_.reset();
    last_.reset();
    bar_.reset();
    first_bar_.reset();
    rate_ = 1.0;
}

bool ClipCourse::loops() const noexcept {
    return timing_.loop == ClipLoop::always ||
           (timing_.loop == ClipLoop::where_ends_meet && span_.do_ends_meet);
}

std::optional<double> ClipCourse::in_song(StreamTime moment) const noexcept {
    const double seconds = song_start_ + to_seconds(moment) - timing_.offset;
    if (seconds < 0.0) {
        return std::nullopt;
    }
    if (seconds <= span_.seconds) {
        return seconds;
    }
    return loops() ? std::optional(std::fmod(seconds, span_.seconds)) : std::nullopt;
}

bool ClipCourse::may_begin(StreamTime moment, const MusicState& music) noexcept {
    waits_since_ = waits_since_.value_or(moment);
    if (!is_danceable(music)) {
        bar_.reset();
        return to_seconds(moment - *waits_since_) >= kPatience;
    }
    const long long bar = bar_at(music.grid, moment);
    const bool is_at_line = bar_ && bar != *bar_;
    bar_ = bar;
    return is_at_line && (!first_bar_ || (bar - *first_bar_) % kPhraseBars == 0);
}

void ClipCourse::begin(StreamTime moment, const MusicState& music) noexcept {
    stage_ = Stage::running;
    place_ = 0.0;
    rate_ = 1.0;
    octave_ = 1.0;
    began_.reset();
    waits_since_.reset();
    if (!is_danceable(music)) {
        return;
    }
    first_bar_ = first_bar_.value_or(bar_at(music.grid, moment));
    if (!(span_.bpm > 0.0)) {
        return;
    }
    const double ratio = music.grid.tempo.bpm() / span_.bpm;
    for (const double octave : {0.5, 2.0}) {
        if (std::abs(std::log(octave * ratio)) < std::abs(std::log(octave_ * ratio))) {
            octave_ = octave;
        }
    }
    // On the 1 itself, which lies up to a hop back.
    began_ = Beats(std::round(music.grid.beats_at(moment).count()));
}

// Runs on by `seconds` of the stream.
void ClipCourse::run(double seconds, StreamTime moment, const MusicState& music) noexcept {
    rate_ = 1.0;
    const double rate = began_ ? octave_ * music.grid.tempo.bpm() / span_.bpm : 0.0;
    if (began_ && rate >= kLeastRate && rate <= kMostRate) {
        const double beat = 60.0 / span_.bpm;  // of the clip, its own seconds
        const double wanted = octave_ * (music.grid.beats_at(moment) - *began_).count() * beat;
        const double error = wanted - (place_ + rate * seconds);
        if (std::abs(error) > kAstray * beat) {
            *began_ = *began_ + Beats(error / (octave_ * beat));
            rate_ = rate;
        } else {
            rate_ =
                rate + std::clamp(kGain * error, -kMostCorrection * rate, kMostCorrection * rate);
        }
    }
    place_ += rate_ * seconds;
    if (place_ <= span_.seconds) {
        return;
    }
    if (!loops()) {
        end();
        return;
    }
    const double rounds = std::floor(place_ / span_.seconds);
    place_ -= rounds * span_.seconds;
    if (began_) {
        *began_ = *began_ + Beats(rounds * span_.seconds * span_.bpm / (60.0 * octave_));
    }
}

void ClipCourse::end() noexcept {
    stage_ = timing_.loop == ClipLoop::never ? Stage::over : Stage::waiting;
    rate_ = 1.0;
    bar_.reset();
}

std::optional<double> ClipCourse::advance(StreamTime moment, const MusicState& music) noexcept {
    if (timing_.sync == ClipSync::song) {
        return in_song(moment);
    }
    const double passed = last_ ? std::max(0.0, to_seconds(moment - *last_)) : 0.0;
    last_ = moment;
    if (stage_ == Stage::running) {
        run(passed, moment, music);
    } else if (stage_ == Stage::waiting && may_begin(moment, music)) {
        begin(moment, music);
    }
    return stage_ == Stage::running ? std::optional(place_) : std::nullopt;
}

}  // namespace raks::engine
