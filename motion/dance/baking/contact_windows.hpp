// Contact windows: when each foot of a closed figure stands on the floor.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "motion/figures/figure_model.hpp"

namespace raks::motion {

/// A stretch of a closed figure in which one toe rests: samples first .. first + length - 1, modulo
/// the number of samples.
struct ContactWindow {
    std::size_t first = 0;    ///< sample
    std::size_t length = 0;   ///< samples
    bool is_step = false;     ///< begins at a learnt landing
    bool is_passing = false;  ///< of a foot that steps on at once (with_passing_steps)
};

/// Contact windows of one side from its learnt contact probability, by order of their start: the
/// probability is smoothed over the phase and thresholded, then gaps below a quarter of a beat are
/// closed and contacts below a third of a beat dropped. `samples`: of the whole figure. Threads:
/// workers. Real-time: no.
[[nodiscard]] std::vector<ContactWindow> contact_windows(std::span<const double> chance,
                                                         int beats,
                                                         std::size_t samples);

/// Moves the start of each contact to the learnt landing nearest to it (less than `reach`
/// beats away, from three repeats or more), so that the foot comes to rest when people's feet did;
/// its end stays. A window without a landing stays; a landing without a window gets a short one.
/// Threads: workers. Real-time: no.
[[nodiscard]] std::vector<ContactWindow> start_at_landings(
    std::vector<ContactWindow> windows,
    const std::vector<LandingOffset>& landings,
    double reach,
    double samples_per_beat,
    std::size_t samples);

/// Adds short contacts of a foot that comes down between two contacts and steps on within a beat.
/// It rests too briefly for the contact probability to show it, and without a contact it would
/// creep from one place to the other. It stands until the next step must leave. Only for dances
/// whose repeats step alike: in a mean over people, some of whom step there, such a landing stands
/// for a minority. Threads: workers. Real-time: no.
[[nodiscard]] std::vector<ContactWindow> with_passing_steps(
    std::vector<ContactWindow> windows,
    const std::vector<LandingOffset>& landings,
    double samples_per_beat,
    std::size_t samples);

}  // namespace raks::motion
