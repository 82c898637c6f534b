#pragma once

#include <cstddef>
#include <string>

#include "base/expected.hpp"
#include "engine/outputs/output_target.hpp"

namespace raks::engine {

/// Where the dancer's way over the floor is told.
enum class VmcTravel {
    hips,  ///< by the place of the hips
    root,  ///< by that of the model's root
    none,  ///< nowhere: it dances on its place
};
/// Against what the rotations of bones are told.
enum class VmcRotations {
    automatic,   ///< raw where a VRM 1.0 is worn, else normalised
    normalised,  ///< against the T-pose, in the axes of the avatar
    raw,         ///< against the parent, as nodes of the model's file have it
};

/// How a dance is told to an avatar elsewhere.
struct VmcStyle {
    VmcTravel travel = VmcTravel::hips;
    float way = 1.0F;  ///< factor on the way over the floor
    float yaw = 0.0F;  ///< turns the dancer to its left, seen from above; radians
    VmcRotations rotations = VmcRotations::automatic;
};

/// What a person writes behind --vmc.
struct VmcTarget {
    HostPort place;
    std::size_t dancer = 0;  ///< of the stage
    double rate = 60.0;      ///< frames a second
    VmcStyle style;
    Nanos lead{};  ///< so long before it is heard a pose is told; less than 0: behind it
};
/// Errors: what is wrong with it.
[[nodiscard]] Expected<VmcTarget> read_vmc_target(const std::string& target);

}  // namespace raks::engine
