#include "models/dense_product.hpp"

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
    for (std::size_t k = 0; k < kCount; ++k) {
        kept[k] = lanes_at(sums + k * kLanes);
    }
    for (std::size_t i = 0; i < inputs; ++i, weights += width) {
        for (std::size_t k = 0; k < kCount; ++k) {
            kept[k] += input[i] * lanes_at(weights + k * kLanes);
        }
    }
    for (std::size_t k = 0; k < kCount; ++k) {
        store_lanes(kept[k], sums + k * kLanes);
    }
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
    for (; at < width; ++at) {
        float sum = sums[at];
        for (std::size_t i = 0; i < inputs; ++i) {
            sum += input[i] * weights[i * width + at];
        }
        sums[at] = sum;
    }
}

}  // namespace raks::models
