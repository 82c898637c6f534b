#include "models/dense_product.hpp"

#include "base/simd_clones.hpp"

namespace raks::models {

// Row by row, so that the inner loop runs over neighbouring numbers and vectorizes.
RAKS_SIMD_CLONES void add_product(const float* input,
                                  std::size_t inputs,
                                  const float* weights,
                                  std::size_t width,
                                  float* __restrict sums) noexcept RAKS_NONBLOCKING {
    for (std::size_t i = 0; i < inputs; ++i) {
        const float x = input[i];
        const float* const row = weights + i * width;
        for (std::size_t j = 0; j < width; ++j) {
            sums[j] += x * row[j];
        }
    }
}

}  // namespace raks::models
