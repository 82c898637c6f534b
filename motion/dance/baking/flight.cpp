#include "motion/dance/baking/flight.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "motion/dance/baking/banded_system.hpp"
#include "motion/dance/body/closed_curve.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kOrder = 3;  // of the difference whose square is minimised: jerk
// Coefficients of the third difference.
constexpr std::array<double, kOrder + 1> kThird = {-1.0, 3.0, -3.0, 1.0};

/// Smooths one coordinate of samples first .. first + length - 1: minimises the squared distance to
/// them plus `stiffness` times the squared third differences.
void smooth(std::ptrdiff_t first,
            std::size_t length,
            double stiffness,
            glm::vec3::length_type axis,
            std::vector<glm::vec3>& path) {
    const auto at = [&](std::ptrdiff_t i) -> float& { return path[wrap(i, path.size())][axis]; };
    BandedSystem<kOrder> system(length);
    const auto count = static_cast<std::ptrdiff_t>(length);
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        system.add(i, {1.0}, 1.0, static_cast<double>(at(first + i)));
    }
    // Differences that reach into the rests on either side, whose samples are fixed, are included:
    // they make speed and acceleration continuous there.
    for (std::ptrdiff_t i = -static_cast<std::ptrdiff_t>(kOrder); i < count; ++i) {
        double known = 0.0;  // what the fixed samples contribute to this difference
        for (std::size_t k = 0; k < kThird.size(); ++k) {
            const std::ptrdiff_t sample = i + static_cast<std::ptrdiff_t>(k);
            if (sample < 0 || sample >= count) {
                known += kThird[k] * static_cast<double>(at(first + sample));
            }
        }
        system.add(i, kThird, stiffness, -known);
    }
    const std::vector<double> smooth = system.solve();
    for (std::size_t i = 0; i < length; ++i) {
        at(first + static_cast<std::ptrdiff_t>(i)) = static_cast<float>(smooth[i]);
    }
}

}  // namespace

void fly(const std::vector<bool>& rests, double bandwidth, std::vector<glm::vec3>& path) {
    const std::size_t size = path.size();
    // The third difference multiplies a wave of angular frequency w by (2 sin(w / 2))^3 in
    // amplitude. With this stiffness both terms weigh the same at `bandwidth`, so half of the wave
    // remains.
    const double stiffness = std::pow(2.0 * std::sin(M_PI * bandwidth), -2.0 * kOrder);
    const auto rests_at = [&](std::size_t i) { return static_cast<bool>(rests[i % size]); };
    for (std::size_t i = 0; i < size; ++i) {
        // A flight begins at the last resting sample before it.
        if (!rests_at(i) || rests_at(i + 1)) {
            continue;
        }
        std::size_t length = 0;
        while (!rests_at(i + 1 + length)) {
            ++length;
        }
        for (glm::vec3::length_type axis = 0; axis < 3; ++axis) {
            smooth(static_cast<std::ptrdiff_t>(i) + 1, length, stiffness, axis, path);
        }
    }
}

}  // namespace raks::motion
