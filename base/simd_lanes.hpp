#pragma once

#include <cstddef>
#include <cstring>

#include "base/simd_clones.hpp"

// Lanes are passed by value to functions that are always inlined, in which no calling convention
// takes part.
#pragma GCC diagnostic ignored "-Wpsabi"

/// Of a function that works on lanes within one that is compiled by RAKS_SIMD_CLONES.
#define RAKS_LANES_INLINE [[gnu::always_inline]] inline

namespace raks {

/// Eight numbers that are worked on as one value: one AVX register, two of SSE. For sums whose
/// order must not depend on the machine, and for what a compiler does not vectorize by itself.
using Lanes __attribute__((vector_size(32))) = float;
inline constexpr std::size_t kLanes = sizeof(Lanes) / sizeof(float);  ///< in one value

/// The eight from here on; aligned or not.
RAKS_LANES_INLINE Lanes lanes_at(const float* from) noexcept {
    Lanes lanes;  // NOLINT: filled below
    std::memcpy(&lanes, from, sizeof(lanes));
    return lanes;
}

/// To here and on; aligned or not.
RAKS_LANES_INLINE void store_lanes(const Lanes& lanes, float* to) noexcept {
    std::memcpy(to, &lanes, sizeof(lanes));
}

/// Sum of the lanes: of i and i + 4 first, then of i and i + 2, then of the two that are left.
RAKS_LANES_INLINE float sum_of_lanes(const Lanes& lanes) noexcept {
    const Lanes fours = lanes + __builtin_shufflevector(lanes, lanes, 4, 5, 6, 7, 0, 1, 2, 3);
    const Lanes twos = fours + __builtin_shufflevector(fours, fours, 2, 3, 0, 1, 6, 7, 4, 5);
    return twos[0] + twos[1];
}

}  // namespace raks
