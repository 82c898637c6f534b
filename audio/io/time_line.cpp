#include "audio/io/time_line.hpp"

#include <cmath>
#include <cstdlib>

extern "C" {
#include <libavutil/mathematics.h>
}

namespace raks::audio {

void TimeLine::prepare(const TimeLineRules& rules, std::int64_t origin) noexcept {
    rules_ = rules;
    origin_ = origin;
    first_grid_ = 0;
    grid_size_ = 0;
    rewind();
}

void TimeLine::rewind() noexcept {
    shift_ = 0;
    expected_ = 0;
    has_previous_ = false;
    grid_ = first_grid_;
}

void TimeLine::set_grid(std::int64_t start, std::int64_t size) noexcept {
    first_grid_ = start;
    grid_ = start;
    grid_size_ = size;
}

std::int64_t TimeLine::frames_of(std::int64_t stamps) const noexcept {
    return av_rescale_q(stamps, rules_.unit, AVRational{1, rules_.rate});
}

std::int64_t TimeLine::stamp_of(std::int64_t position) const noexcept {
    return origin_ + av_rescale_q(position, AVRational{1, rules_.rate}, rules_.unit);
}

bool TimeLine::is_coarse() const noexcept { return av_q2d(rules_.unit) * rules_.rate > 1.0; }

// Moves a position from a coarse time stamp to the nearest place where a codec frame can start, if
// it is within the stamp's resolution.
std::int64_t TimeLine::on_grid(std::int64_t position) const noexcept {
    if (!is_coarse() || grid_size_ <= 0 || position <= 0) {
        return position;
    }
    const double steps = static_cast<double>(position - grid_) / static_cast<double>(grid_size_);
    const std::int64_t near = grid_ + std::llround(steps) * grid_size_;
    const double resolution = av_q2d(rules_.unit) * rules_.rate;
    return static_cast<double>(std::abs(near - position)) <= resolution ? near : position;
}

TimeLine::Place TimeLine::place(std::int64_t stamp, std::int64_t frames) noexcept {
    Place place;
    std::int64_t position = frames_of(stamp - origin_) + shift_;
    const std::int64_t jump = position - expected_;
    if (has_previous_ && rules_.are_from_file && std::abs(jump) >= rules_.least_jump) {
        place.step = jump > rules_.longest_gap || jump < -rules_.longest_overlap
                         ? Step::restart
                         : (jump > 0 ? Step::gap : Step::overlap);
    }
    const bool is_jitter = has_previous_ && place.step == Step::goes_on;
    if (is_jitter && rules_.is_jitter_left_out) {
        position = expected_;
    }
    if (place.step == Step::restart) {
        shift_ += expected_ - position;
        position = expected_;
    }
    place.position = on_grid(position);
    if (place.step != Step::goes_on) {
        grid_ = place.position;
    }
    expected_ = position + frames;
    has_previous_ = true;
    return place;
}

}  // namespace raks::audio
