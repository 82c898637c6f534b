// Formations: how many dance together, and where each of them stands.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace raks::motion {

/// Dancers of one music, at most.
inline constexpr std::size_t kMostDancers = 32;

/// How several stand and follow one another.
enum class Formation {
    solo,
    couple,  ///< lead and follow, facing, the same figures
    unison,  ///< side by side, the same figures at the same time
    canon,   ///< side by side, each two bars after the one before
    free,    ///< here and there, each with figures of its own
    grid,    ///< in rows and gaps, the same figures
    ring,    ///< in a circle, from eleven on in two, the same figures
    v,       ///< as cranes fly, the first in front, the same figures
};
/// Names of the formations, in the order of Formation.
inline constexpr std::array<std::string_view, 8> kFormationNames = {
    "solo", "couple", "unison", "canon", "free", "grid", "ring", "v"};

/// How many dance in a formation that is asked for `asked` dancers (0: as many as it usually has;
/// kMostDancers at most). Solo and couple have one and two whatever is asked. Pure.
[[nodiscard]] std::size_t dancers_in(Formation formation, std::size_t asked) noexcept;

/// Metres about each one's place in which nobody else dances at the same time. Pure.
[[nodiscard]] double room_in(Formation formation) noexcept;

/// Where they stand: metres from the stage's middle, x to the dancers' left, y toward the audience;
/// nobody nearer to another than 1.3 m. Those of a couple have their places from the dance.
/// `dancers`: of dancers_in. Pure.
[[nodiscard]] std::vector<glm::dvec2> places_in(Formation formation, std::size_t dancers);

}  // namespace raks::motion
