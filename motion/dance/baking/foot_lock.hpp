// Foot lock: plants the feet of one closed figure in their planned contacts.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "motion/dance/baking/contact_windows.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec2.hpp>

namespace raks::motion {

/// One contact of a foot with the floor that the foot lock keeps.
struct PlannedContact {
    ContactWindow window;  ///< samples in which the foot stands
    /// Where the pivot rests on the floor (x, z); metres; none: at its own mean place
    std::optional<glm::vec2> place;
    glm::vec2 aside{};  ///< added to that place; metres (x, z)
    /// The step before it is a mean of repeats that step at different moments (flight.hpp)
    bool is_mean = false;
    /// Sample at which the free foot comes to rest by itself; it may lie before or after
    /// window.first.
    std::optional<double> arrival;
    /// How much of the step before it takes the speed profile of one reach, 0 (none) to 1
    /// (flight.hpp).
    double reach = 0.0;
};

/// Plants the feet of a closed figure (Kovar, Schreiner, Gleicher 2002, "Footskate cleanup for
/// motion capture editing"). It shifts the hips by one height, so that the soles in contact are on
/// the floor on average; holds the pivot of a foot in contact at its planned or own mean place (the
/// foot may turn about it); bends the toes while the heel is up; keeps soles out of the floor; and
/// lowers the hips where a leg would not reach. Sets foot_contact.
///
/// `contacts`: by Side, in order of time. `stepping`: by Side, one target a pose; they may come
/// from another track than `poses`, so that a varied body keeps the learnt steps. The steps are
/// first brought into time with their contacts (in_time), and those that are means are evened after
/// planting (rising_once). Between two contacts the ankle takes the path of least jerk that leaves
/// and meets each with the contact's own speed and acceleration (flight.hpp): nothing kinks where a
/// foot is released or taken up. `samples_per_beat`: rate of `poses`; it sets the widths of all
/// smoothing. Threads: workers. Real-time: no.
void lock_feet(const Skeleton& skeleton,
               const std::array<std::vector<PlannedContact>, 2>& contacts,
               double samples_per_beat,
               const std::array<std::vector<FootTarget>, 2>& stepping,
               std::vector<Pose>& poses);

}  // namespace raks::motion
