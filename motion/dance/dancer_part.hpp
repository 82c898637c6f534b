// Dancer part: what tells the dancers of an ensemble apart.
#pragma once

#include <cstdint>
#include <memory>

#include <glm/vec2.hpp>

namespace raks::motion {

class Repertoire;  // motion/repertoire.hpp

/// Whether the dance follows what the music does beside its beats: how much it gives, its stops and
/// phrases. Off: figure after figure, as large as they were learnt.
enum class Dynamics : std::uint8_t { on, off };

/// What one dancer of several does of its own.
struct DancerPart {
    std::uint64_t seed = 1;  ///< of the choice of figures; equal seeds give equal sequences
    std::uint64_t ways = 1;  ///< of how each figure is danced
    Dynamics dynamics = Dynamics::on;
    bool is_in_couple = false;  ///< stands by the couple's common point, facing the other
    /// In a couple: the other's dances. Both then keep to one metre, the mean of theirs; otherwise
    /// one of them would change octave before the other does. Null: alone.
    std::shared_ptr<const Repertoire> partner{};
    /// From the stage's middle: x to the left, y toward the audience; metres.
    glm::dvec2 place{0.0, 0.0};
    /// Metres about that place in which a dance of takes stays, but for a step or two; others come
    /// back to their place by themselves.
    double room = 1.3;
    int bars_late = 0;  ///< starts this many bars after it could
};

}  // namespace raks::motion
