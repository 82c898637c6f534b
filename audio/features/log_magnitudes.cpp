#include "audio/features/log_magnitudes.hpp"

#include "base/assert.hpp"
#include "base/simd_clones.hpp"
#include "models/fast_log.hpp"

namespace raks::audio {
namespace {

RAKS_SIMD_CLONES void take_logs(const float* magnitudes,
                                float factor,
                                std::size_t count,
                                float* __restrict logs) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        logs[i] = models::fast_log(1.0F + factor * magnitudes[i]);
    }
}

}  // namespace

void log_magnitudes(std::span<const float> magnitudes,
                    float factor,
                    std::span<float> logs) noexcept RAKS_NONBLOCKING {
    RAKS_ASSERT(magnitudes.size() == logs.size());
    take_logs(magnitudes.data(), factor, logs.size(), logs.data());
}

}  // namespace raks::audio
