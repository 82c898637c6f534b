#include "motion/dance/dynamics/energy_range.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/time.hpp"

namespace raks::motion {
namespace {

constexpr float kFades = 120.0F;     // seconds in which what was heard counts 1/e
constexpr double kHeldLikely = 8.0;  // seconds that the even distribution counts

}  // namespace

void EnergyRange::hear(float energy) noexcept RAKS_NONBLOCKING {
    const auto hop = static_cast<float>(to_seconds(kHop));
    const auto at = static_cast<std::size_t>(
        std::lround(std::clamp(energy, 0.0F, 1.0F) * static_cast<float>(kBins - 1)));
    const float stays = 1.0F - hop / kFades;
    for (float& each : seconds_) {
        each *= stays;
    }
    seconds_[at] += hop;
    sum_ = sum_ * stays + hop;
}

// Each bin is spread evenly over its width and that of its neighbours.
double EnergyRange::share_below(double energy) const noexcept RAKS_NONBLOCKING {
    const double clamped = std::clamp(energy, 0.0, 1.0);
    const double at = clamped * static_cast<double>(kBins - 1) + 0.5;
    double below = 0.0;
    for (std::size_t i = 0; i < kBins; ++i) {
        below += static_cast<double>(seconds_[i]) *
                 std::clamp((at + 1.0 - static_cast<double>(i)) / 3.0, 0.0, 1.0);
    }
    return (below + kHeldLikely * clamped) / (static_cast<double>(sum_) + kHeldLikely);
}

}  // namespace raks::motion
