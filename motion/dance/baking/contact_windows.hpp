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
    bool is_step = false;     ///< begins where people's steps come down
    bool is_passing = false;  ///< of a foot that steps on at once
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

/// Adds those of a foot that comes down between two contacts and steps on at once, within a beat:
/// it rests for too short a time to be a contact by chance, and would creep from one to the other.
/// It stands for as long as the next step leaves it. For dances whose repeats step alike: in a mean
/// of people's, some of whom step there, such a landing is of few.
[[nodiscard]] std::vector<ContactWindow> with_passing_steps(
    std::vector<ContactWindow> windows,
    const std::vector<LandingOffset>& landings,
    double samples_per_beat,
    std::size_t samples);

}  // namespace raks::motion
