#pragma once

#include <cstdint>
#include <span>

namespace raks::engine {

/// Where a known sound lies in a recording.
struct Match {
    std::int64_t place = 0;    ///< of its first sample
    double correlation = 0.0;  ///< normalized; 0: it was not found
};

/// The place from `from` up to `to`, not included, at which `wanted` fits best, by normalized
/// cross-correlation. Threads: any. Real-time: no.
[[nodiscard]] Match best_match(std::span<const float> samples,
                               std::span<const float> wanted,
                               std::int64_t from,
                               std::int64_t to);

}  // namespace raks::engine
