#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/realtime.hpp"

/// Squared Mahalanobis distances, the expensive part of full-covariance emissions.
namespace raks::models {

/// Frames that are computed side by side.
inline constexpr std::size_t kFrameBlock = 16;

/// One feature of a block of frames, aligned to cache lines.
struct alignas(64) FeatureBlock {
    std::array<double, kFrameBlock> frames{};
};

/// out[b] = |W centred_b|^2 for every frame b of a block. `triangle`: the rows of the lower
/// triangle W, packed; `centred`: D features, minus their mean. Each frame's sums run in the same
/// order as in squared_distance, so that both give the same bits on any machine.
/// Threads: any. Real-time: yes (O(D^2), no allocation).
void squared_distances(const double* triangle,
                       const FeatureBlock* centred,
                       std::size_t dimension,
                       FeatureBlock& out) noexcept RAKS_NONBLOCKING;

/// The same for one frame; `mean`: D values, subtracted from it.
[[nodiscard]] double squared_distance(const double* triangle,
                                      std::span<const double> frame,
                                      const double* mean) noexcept RAKS_NONBLOCKING;

}  // namespace raks::models
