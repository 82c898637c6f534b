#pragma once

#include <bit>
#include <cstdint>

namespace raks::models {

/// exp(x) for |x| <= 80 with a relative error below 8e-7: a polynomial that the compiler vectorizes
/// and that gives the same bits on every machine. (std::exp of 5,000 states a hop was half of the
/// analyzer's cost.) Real-time: yes.
[[nodiscard]] inline float fast_exp(float x) noexcept {
    // x = whole ln 2 + r; ln 2 in two parts, so that the difference keeps its digits.
    constexpr float kLog2E = 1.44269504F;
    constexpr float kLn2High = 0.693359375F;
    constexpr float kLn2Low = -2.12194440e-4F;
    constexpr float kRound = 12582912.0F;  // 1.5 x 2^23: adding it rounds to an integer
    const float shifted = x * kLog2E + kRound;
    const float whole = shifted - kRound;
    const float r = (x - whole * kLn2High) - whole * kLn2Low;
    float p = 1.9875691500e-4F;  // Cephes expf
    p = p * r + 1.3981999507e-3F;
    p = p * r + 8.3334519073e-3F;
    p = p * r + 4.1665795894e-2F;
    p = p * r + 1.6666665459e-1F;
    p = p * r + 5.0000001201e-1F;
    p = p * r * r + r + 1.0F;
    // exp(r) times 2^whole, by adding `whole` to the exponent's bits.
    const std::uint32_t exponent = std::bit_cast<std::uint32_t>(shifted) << 23U;
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(p) + exponent);
}

}  // namespace raks::models
