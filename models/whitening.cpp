#include "models/whitening.hpp"

#include <cstring>

#include "base/simd_clones.hpp"

namespace raks::models {
namespace {

/// Eight frames of a block: one wide register, or several narrow ones. (As plain loops over the
/// block the sums stay in memory, at ten times the cost.)
using Lanes = double __attribute__((vector_size(64)));
constexpr std::size_t kLanes = sizeof(Lanes) / sizeof(double);
static_assert(kFrameBlock == 2 * kLanes);

}  // namespace

RAKS_SIMD_CLONES void squared_distances(const double* triangle,
                                        const FeatureBlock* centred,
                                        std::size_t dimension,
                                        FeatureBlock& out) noexcept RAKS_NONBLOCKING {
    // Two registers of frames at a time: row i of W times the centred features, squared and summed
    // over i.
    Lanes low_sum = {};
    Lanes high_sum = {};
    for (std::size_t i = 0; i < dimension; ++i) {
        Lanes low_white = {};
        Lanes high_white = {};
        for (std::size_t j = 0; j <= i; ++j) {
            // memcpy loads without assumptions on aliasing; it compiles to one load.
            Lanes low;
            Lanes high;
            std::memcpy(&low, centred[j].frames.data(), sizeof(low));
            std::memcpy(&high, centred[j].frames.data() + kLanes, sizeof(high));
            low_white += triangle[j] * low;
            high_white += triangle[j] * high;
        }
        triangle += i + 1;
        low_sum += low_white * low_white;
        high_sum += high_white * high_white;
    }
    std::memcpy(out.frames.data(), &low_sum, sizeof(low_sum));
    std::memcpy(out.frames.data() + kLanes, &high_sum, sizeof(high_sum));
}

double squared_distance(const double* triangle,
                        std::span<const double> frame,
                        const double* mean) noexcept RAKS_NONBLOCKING {
    double sum = 0.0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        // The same order of sums as above, for the same bits.
        double white = 0.0;
        for (std::size_t j = 0; j <= i; ++j) {
            white += triangle[j] * (frame[j] - mean[j]);
        }
        triangle += i + 1;
        sum += white * white;
    }
    return sum;
}

}  // namespace raks::models
