#pragma once

#include <cmath>
#include <cstdint>

namespace raks {

/// Counter-based random numbers: number i of stream (seed, stream) is a pure function of the
/// three, so a figure's variation can be drawn again, in any order, on any thread, without state.
/// (SplitMix64's finalizer over a keyed counter: Steele, Lea, Flood 2014.)
/// Threads: any. Real-time: yes.
class CounterRandom {
 public:
    /// `stream`: streams of one seed are independent of each other.
    constexpr explicit CounterRandom(std::uint64_t seed, std::uint64_t stream = 0) noexcept
        : key_(mix(seed ^ mix(stream + kGolden))) {}

    /// 64 random bits.
    [[nodiscard]] constexpr std::uint64_t bits(std::uint64_t i) const noexcept {
        return mix(key_ + kGolden * (i + 1));
    }
    /// Uniform in [0, 1), 53 bits.
    [[nodiscard]] constexpr double uniform(std::uint64_t i) const noexcept {
        return static_cast<double>(bits(i) >> 11U) * 0x1.0p-53;
    }
    /// Uniform integer in [0, count), count > 0 (bias below 2^-32 for count < 2^32).
    [[nodiscard]] constexpr std::uint64_t below(std::uint64_t i,
                                                std::uint64_t count) const noexcept {
        return static_cast<std::uint64_t>(uniform(i) * static_cast<double>(count));
    }
    /// Standard normal (Box-Muller on numbers 2i and 2i + 1 of this stream).
    [[nodiscard]] double normal(std::uint64_t i) const noexcept {
        constexpr double kTwoPi = 6.283185307179586;
        const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(2 * i)));
        return radius * std::cos(kTwoPi * uniform(2 * i + 1));
    }

 private:
    static constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ULL;

    [[nodiscard]] static constexpr std::uint64_t mix(std::uint64_t x) noexcept {
        x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
        return x ^ (x >> 31U);
    }

    std::uint64_t key_;
};

}  // namespace raks
