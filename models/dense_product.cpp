#include "models/dense_product.hpp"

#include <cstring>

#include "base/simd_clones.hpp"

namespace raks::models {
namespace {

// Neighbouring outputs that are worked on as one value; clones without such registers take two of
// theirs.
using Lanes __attribute__((vector_size(32))) = float;
constexpr std::size_t kLanes = sizeof(Lanes) / sizeof(float);

// The sums of kCount x kLanes outputs stay in registers over all inputs.
template <std::size_t kCount>
[[gnu::always_inline]] inline void add_columns(const float* input,
                                               std::size_t inputs,
                                               const float* weights,
                                               std::size_t width,
                                               float* sums) noexcept {
    Lanes kept[kCount];  // NOLINT: filled below
    for (std::size_t k = 0; k < kCount; ++k) {
        std::memcpy(&kept[k], sums + k * kLanes, sizeof(Lanes));
    }
    for (std::size_t i = 0; i < inputs; ++i, weights += width) {
        for (std::size_t k = 0; k < kCount; ++k) {
            Lanes row;  // NOLINT: filled below
            std::memcpy(&row, weights + k * kLanes, sizeof(row));
            kept[k] += input[i] * row;
        }
    }
    for (std::size_t k = 0; k < kCount; ++k) {
        std::memcpy(sums + k * kLanes, &kept[k], sizeof(Lanes));
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
