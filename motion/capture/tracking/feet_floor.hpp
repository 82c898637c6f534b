// Floor of the feet: where the floor lies and which way is up, by a dancer who stands on it.
#pragma once

#include <optional>

#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/tracks.hpp"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace raks::capture {

/// A better world from the one that tracks are in: place = rotation * place + translation.
struct Levelling {
    glm::dmat3 rotation{1.0};
    glm::dvec3 translation{};  ///< metres
};

/// Turns and moves a world so that y is up, the floor is y = 0, and the dancer's feet are on the
/// average over its origin. Up is first the mean direction from feet to head and chest; then a
/// plane is laid through the markers near the soles where they stand still (each at its height over
/// the floor when a body so tall stands, `height` in metres, 0: the mannequin's), which tilts it as
/// far as the feet stood apart. None: in no frame both such a marker and one of head or chest are
/// known.
[[nodiscard]] std::optional<Levelling> level_by_feet(const Tracks& tracks,
                                                     const MarkerSet& markers,
                                                     double height);

/// Moves the cameras into the better world, whose floor is then one of feet.
void level(Rig& rig, const Levelling& levelling);

}  // namespace raks::capture
