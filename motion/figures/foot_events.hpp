#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "motion/skeleton/body/retarget.hpp"
#include "motion/skeleton/humanoid.hpp"

/// Foot events: contacts and landings of recorded or evaluated motion. A contact is a toe at rest
/// on the floor; a landing is the moment when a step's speed falls under a limit. The feet passed
/// in are by frame and Side, metres, over a floor at y = 0.
namespace raks::motion {

/// Limits of the detectors; the defaults are those that figures are learnt and evaluated with.
struct FootRules {
    double contact_speed = 0.25;        ///< a toe slower than this is in contact, m/s
    double contact_height = 0.05;       ///< if it is also lower than this over the floor, metres
    std::size_t contact_frames = 4;     ///< and for at least this many frames
    double contact_low_pass_hz = 10.0;  ///< cutoff of the filter before that speed
    double landing_speed = 0.30;        ///< a foot that falls under this lands, m/s
    double step_speed = 0.60;           ///< if it was faster than this since its last landing, m/s
    double landing_low_pass_hz = 8.0;   ///< cutoff of the filter before that speed
};

/// Speed of the toe tip by frame, m/s: central differences of the low-pass filtered place. Threads:
/// any. Real-time: no.
[[nodiscard]] std::vector<double> toe_speed(std::span<const std::array<SourceFoot, 2>> feet,
                                            Side side,
                                            double frames_per_second,
                                            double low_pass_hz);
/// Mean of the speeds of ankle and toe tip by frame, m/s.
[[nodiscard]] std::vector<double> foot_speed(std::span<const std::array<SourceFoot, 2>> feet,
                                             Side side,
                                             double frames_per_second,
                                             double low_pass_hz);

/// By frame: whether the toe is in contact.
[[nodiscard]] std::vector<bool> toe_contacts(std::span<const std::array<SourceFoot, 2>> feet,
                                             Side side,
                                             double frames_per_second,
                                             const FootRules& rules = {});

/// Landings: moments in fractional frames, rising, at which the foot's speed falls under the
/// landing speed after a step.
[[nodiscard]] std::vector<double> landings(std::span<const std::array<SourceFoot, 2>> feet,
                                           Side side,
                                           double frames_per_second,
                                           const FootRules& rules = {});

}  // namespace raks::motion
