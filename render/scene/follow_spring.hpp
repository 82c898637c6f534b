#pragma once

#include <cmath>

namespace raks::render {

/// Follows a value without kinks and without overshoot: a critically damped spring, solved exactly
/// from step to step. Behind a value that goes on evenly it lags by twice `time_constant`.
/// A value; real-time: yes.
struct FollowSpring {
    float place = 0.0F;  ///< where it is
    float speed = 0.0F;  ///< in units of the place a second

    /// Stands still there.
    void begin(float at) noexcept {
        place = at;
        speed = 0.0F;
    }
    /// `seconds` on, while the value followed is `aim`. Returns the place.
    float follow(float aim, float seconds, float time_constant) noexcept {
        const float rate = 1.0F / time_constant;
        const float left = std::exp(-rate * seconds);
        const float away = place - aim;
        const float change = (speed + rate * away) * seconds;
        place = aim + (away + change) * left;
        speed = (speed - rate * change) * left;
        return place;
    }
};

}  // namespace raks::render
