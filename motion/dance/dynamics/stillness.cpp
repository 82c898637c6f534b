#include "motion/dance/dynamics/stillness.hpp"

#include <algorithm>

namespace raks::motion {

// At an even slowing the way is half of what it would be at full speed.
void Stillness::begin(StreamTime now,
                      Beats phase,
                      double rate,
                      Beats key) noexcept RAKS_NONBLOCKING {
    const double seconds = std::max(0.0, 2.0 * (key - phase).count() / std::max(rate, 0.1));
    begin(now, phase, rate, key, now + nanos_from_seconds(seconds));
}

void Stillness::begin(StreamTime now,
                      Beats phase,
                      double rate,
                      Beats key,
                      StreamTime stands) noexcept RAKS_NONBLOCKING {
    is_on_ = true;
    began_ = now;
    from_ = phase;
    key_ = key;
    rate_ = std::max(rate, 0.1);
    seconds_ = std::max(0.0, to_seconds(stands - now));
    posture_.reset();
}

double Stillness::seconds_at_rest(StreamTime time) const noexcept RAKS_NONBLOCKING {
    return to_seconds(time - began_) - seconds_;
}

bool Stillness::is_at_rest(StreamTime time) const noexcept RAKS_NONBLOCKING {
    return is_on_ && seconds_at_rest(time) >= 0.0;
}

Beats Stillness::phase(StreamTime time) const noexcept RAKS_NONBLOCKING {
    const double t = to_seconds(time - began_);
    if (t >= seconds_) {
        return key_;
    }
    if (t <= 0.0) {
        return from_ + Beats(rate_ * t);
    }
    // A cubic from the rate of the dance to none.
    const double u = t / seconds_;
    const double rest = 1.0 - u;
    return from_ + u * u * (3.0 - 2.0 * u) * (key_ - from_) + Beats(rate_ * t * rest * rest);
}

}  // namespace raks::motion
