#include "motion/dance/dynamics/stillness.hpp"

#include <algorithm>

namespace raks::motion {

// At an even slowing the way is half of what it would be at full speed.
void Stillness::begin(StreamTime now,
                      Beats phase,
                      double rate,
                      Beats key) noexcept RAKS_NONBLOCKING {
    is_on_ = true;
    began_ = now;
    from_ = phase;
    key_ = key;
    rate_ = std::max(rate, 0.1);
    seconds_ = std::max(0.0, 2.0 * (key - phase).count() / rate_);
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
    return from_ + Beats(rate_ * t * (1.0 - 0.5 * std::max(t, 0.0) / seconds_));
}

}  // namespace raks::motion
