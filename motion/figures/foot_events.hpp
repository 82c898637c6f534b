#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/humanoid_mapping.hpp"

/// What the feet of recorded motion do: contacts and landings.
namespace raks::motion {

struct FootRules {
    double contact_speed = 0.25;        ///< toe slower than this touches; m/s
    double contact_height = 0.05;       ///< and lower than this over the floor; metres
    std::size_t contact_frames = 4;     ///< and for at least so long
    double contact_low_pass_hz = 10.0;  ///< of the speed
    double landing_speed = 0.30;        ///< falling under this is a landing; m/s
    double step_speed = 0.60;           ///< after having been over this
    double landing_low_pass_hz = 8.0;
};

/// Speeds of one foot by frame: central differences of the filtered place.
[[nodiscard]] std::vector<double> toe_speed(std::span<const std::array<SourceFoot, 2>> feet,
                                            Side side,
                                            double frames_per_second,
                                            double low_pass_hz);
/// Mean of ankle's and toe tip's.
[[nodiscard]] std::vector<double> foot_speed(std::span<const std::array<SourceFoot, 2>> feet,
                                             Side side,
                                             double frames_per_second,
                                             double low_pass_hz);

/// By frame: does the toe rest on the floor?
[[nodiscard]] std::vector<bool> toe_contacts(std::span<const std::array<SourceFoot, 2>> feet,
                                             Side side,
                                             double frames_per_second,
                                             const FootRules& rules = {});

/// Moments, in frames, at which the foot's speed falls under the landing speed after a step.
[[nodiscard]] std::vector<double> landings(std::span<const std::array<SourceFoot, 2>> feet,
                                           Side side,
                                           double frames_per_second,
                                           const FootRules& rules = {});

}  // namespace raks::motion
