#pragma once

#include <cstddef>

#include "base/realtime.hpp"

namespace raks::models {

/// sums[j] += sum over i of input[i] weights[i][j]: the product of a dense layer. `weights`:
/// row-major, `inputs` x `width`. `sums`: `width` values that do not overlap the others. The same
/// bits on every machine. Threads: any. Real-time: yes.
void add_product(const float* input,
                 std::size_t inputs,
                 const float* weights,
                 std::size_t width,
                 float* __restrict sums) noexcept RAKS_NONBLOCKING;

}  // namespace raks::models
