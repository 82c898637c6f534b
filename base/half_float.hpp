#pragma once

#include <cmath>
#include <cstdint>

namespace raks {

/// The value of a half float (IEEE 754 binary16), given as its bits. Threads: any. Real-time: yes.
[[nodiscard]] inline float float_of_half(std::uint16_t half) noexcept {
    const int exponent = (half >> 10) & 31;
    const auto fraction = static_cast<float>(half & 1023U);
    const float magnitude = exponent == 0    ? std::ldexp(fraction, -24)
                            : exponent == 31 ? INFINITY
                                             : std::ldexp(1024.0F + fraction, exponent - 25);
    return (half & 0x8000U) != 0U ? -magnitude : magnitude;
}

}  // namespace raks
