#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "motion/figures/figure_model.hpp"

namespace raks::motion {

/// A stretch of a closed figure in which one toe rests: samples first .. first + length - 1, modulo
/// the number of samples.
struct ContactWindow {
    std::size_t first = 0;
    std::size_t length = 0;
    bool is_step = false;  ///< begins where people's steps come down
};

/// Contacts of one side from the learnt chance of contact: smoothed over the phase, above one half,
/// gaps below a quarter of a beat closed, contacts below a third of a beat dropped.
[[nodiscard]] std::vector<ContactWindow> contact_windows(
    const std::array<double, kContactBins>& chance, int beats, std::size_t samples);

/// Moves the start of each contact to the learnt landing that it belongs to (at most half a beat
/// away, shown by three repeats or more), so that the foot comes to rest when people's feet did. A
/// window without one stays; a landing without a window gets a short one.
[[nodiscard]] std::vector<ContactWindow> start_at_landings(
    std::vector<ContactWindow> windows,
    const std::vector<LandingOffset>& landings,
    double samples_per_beat,
    std::size_t samples);

}  // namespace raks::motion
