#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

/// Levels. Each caller sets its own floor under what it hands in: the logarithm of 0 has none.
/// Threads: any. Real-time: yes.
namespace raks {

/// Of samples; a full-scale sine has 1/2. `energy`: is added to theirs, where silence must not be
/// 0.
[[nodiscard]] inline double mean_square(std::span<const float> samples,
                                        double energy = 0.0) noexcept {
    // Summed in double: squares of quiet samples vanish beside those of loud ones in single
    // precision.
    for (const float sample : samples) {
        energy += static_cast<double>(sample) * static_cast<double>(sample);
    }
    return energy / static_cast<double>(std::max<std::size_t>(1, samples.size()));
}

[[nodiscard]] inline double decibels_of_power(double power) noexcept {
    return 10.0 * std::log10(power);
}

/// By which samples are multiplied.
[[nodiscard]] inline double amplitude_of_decibels(double decibels) noexcept {
    return std::pow(10.0, decibels / 20.0);
}

}  // namespace raks
