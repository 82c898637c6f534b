#pragma once

#include <bit>
#include <cstdint>

namespace raks::models {

/// ln(x) for x from 1e-37 up, with an error below 1e-7 or 2e-7 of it: a polynomial that the
/// compiler vectorizes and that gives the same bits on every machine. Real-time: yes.
[[nodiscard]] inline float fast_log(float x) noexcept {
    // x = 2^whole (1 + f), with 1 + f between the root of a half and that of 2.
    constexpr std::uint32_t kRootOfHalf = 0x3F3504F3U;
    constexpr float kLn2High = 0.693359375F;
    constexpr float kLn2Low = -2.12194440e-4F;
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const std::int32_t exponent = static_cast<std::int32_t>(bits - kRootOfHalf) >> 23;
    const float f = std::bit_cast<float>(bits - (static_cast<std::uint32_t>(exponent) << 23U)) - 1;
    const auto whole = static_cast<float>(exponent);
    float p = 7.0376836292e-2F;  // Cephes logf
    p = p * f - 1.1514610310e-1F;
    p = p * f + 1.1676998740e-1F;
    p = p * f - 1.2420140846e-1F;
    p = p * f + 1.4249322787e-1F;
    p = p * f - 1.6668057665e-1F;
    p = p * f + 2.0000714765e-1F;
    p = p * f - 2.4999993993e-1F;
    p = p * f + 3.3333331174e-1F;
    const float square = f * f;
    const float rest = f * square * p + whole * kLn2Low - 0.5F * square;
    return (f + rest) + whole * kLn2High;
}

}  // namespace raks::models
