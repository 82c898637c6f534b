#pragma once

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <span>

#include "base/random.hpp"

namespace raks {

/// A sequence of random draws from one stream (seed, number): each call takes the next ones. The
/// same seed, stream and calls give the same draws.
/// Threads: one.
class Dice {
 public:
    /// Starts at the first number of the stream.
    Dice(std::uint64_t seed, std::uint64_t stream) : random_(seed, stream) {}

    /// Uniform in [low, high).
    double uniform(double low = 0.0, double high = 1.0) {
        return low + (high - low) * random_.uniform(next_++);
    }
    /// Uniform in the logarithm, in [low, high), both positive.
    double log_uniform(double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    }
    /// True with this probability.
    bool chance(double probability) { return uniform() < probability; }
    /// Normal with mean 0 and this standard deviation (Box-Muller).
    double normal(double deviation) {
        constexpr double kTwoPi = 6.283185307179586;
        const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
        return deviation * radius * std::cos(kTwoPi * uniform());
    }
    /// A whole number in [low, high].
    int whole(int low, int high) {
        return low +
               static_cast<int>(random_.below(next_++, static_cast<unsigned>(high - low + 1)));
    }
    /// One of the elements, each equally likely; `from` is not empty.
    template <class T>
    const T& pick(std::span<const T> from) {
        return from[random_.below(next_++, from.size())];
    }
    /// The same of a list in the code.
    template <class T>
    T pick(std::initializer_list<T> from) {
        return *(from.begin() + random_.below(next_++, from.size()));
    }

 private:
    CounterRandom random_;
    std::uint64_t next_ = 0;
};

/// A range [low, high), both positive, that is drawn from uniformly in the logarithm.
struct LogRange {
    double low;                                                            ///< > 0
    double high;                                                           ///< > low
    double draw(Dice& dice) const { return dice.log_uniform(low, high); }  ///< one number
};

}  // namespace raks
