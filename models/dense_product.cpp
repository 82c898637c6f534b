#include "models/dense_product.hpp"

#include <algorithm>
#include <array>

#include "base/simd_lanes.hpp"

namespace raks::models {
namespace {

// The sums of kCount x kLanes outputs stay in registers over all inputs.
template <std::size_t kCount>
RAKS_LANES_INLINE void add_columns(const float* input,
                                   std::size_t inputs,
                                   const float* weights,
                                   std::size_t width,
                                   float* sums) noexcept {
    Lanes kept[kCount];  // NOLINT: filled below
    // Unrolled, or the sums go through memory.
#pragma GCC unroll 12
    for (std::size_t k = 0; k < kCount; ++k) {
        kept[k] = lanes_at(sums + k * kLanes);
    }
    for (std::size_t i = 0; i < inputs; ++i, weights += width) {
#pragma GCC unroll 12
        for (std::size_t k = 0; k < kCount; ++k) {
            kept[k] += input[i] * lanes_at(weights + k * kLanes);
        }
    }
#pragma GCC unroll 12
    for (std::size_t k = 0; k < kCount; ++k) {
        store_lanes(kept[k], sums + k * kLanes);
    }
}

// The last `count` columns, fewer than lanes: the other lanes read on into the next row, as far as
// there is one, and are dropped.
RAKS_LANES_INLINE void add_last_columns(const float* input,
                                        std::size_t inputs,
                                        const float* weights,
                                        std::size_t width,
                                        std::size_t count,
                                        float* sums) noexcept {
    if (count == 0) {
        return;
    }
    std::array<float, kLanes> first{};
    std::copy_n(sums, count, first.begin());
    const std::size_t beyond = (kLanes - count + width - 1) / width;  // rows that end too soon
    const std::size_t whole = inputs > beyond ? inputs - beyond : 0;
    Lanes lanes = lanes_at(first.data());
    std::size_t i = 0;
    for (; i < whole; ++i, weights += width) {
        lanes += input[i] * lanes_at(weights);
    }
    std::array<float, kLanes> kept;  // NOLINT: filled below
    store_lanes(lanes, kept.data());
    for (; i < inputs; ++i, weights += width) {
        for (std::size_t j = 0; j < count; ++j) {
            kept[j] += input[i] * weights[j];
        }
    }
    std::copy_n(kept.begin(), count, sums);
}

}  // namespace

// In blocks of outputs, the widest first: each output adds up its products in the order of the
// inputs, whatever its block.
RAKS_SIMD_CLONES void add_product(const float* input,
                                  std::size_t inputs,
                                  const float* weights,
                                  std::size_t width,
                                  float* __restrict sums) noexcept RAKS_NONBLOCKING {
    constexpr std::size_t kWide = 12;  // 12 sums, a row's and an input's value: 14 of 16 registers
    constexpr std::size_t kNarrow = 4;
    std::size_t at = 0;
    for (; at + kWide * kLanes <= width; at += kWide * kLanes) {
        add_columns<kWide>(input, inputs, weights + at, width, sums + at);
    }
    for (; at + kNarrow * kLanes <= width; at += kNarrow * kLanes) {
        add_columns<kNarrow>(input, inputs, weights + at, width, sums + at);
    }
    for (; at + kLanes <= width; at += kLanes) {
        add_columns<1>(input, inputs, weights + at, width, sums + at);
    }
    add_last_columns(input, inputs, weights + at, width, width - at, sums + at);
}

}  // namespace raks::models
