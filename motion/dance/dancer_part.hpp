#pragma once

#include <cstdint>
#include <memory>

namespace raks::motion {

class Repertoire;

/// What one dancer of several does of its own.
struct DancerPart {
    std::uint64_t seed = 1;     ///< of the figures: the same dance the same row of figures
    std::uint64_t ways = 1;     ///< of how each is danced
    bool is_in_couple = false;  ///< stands by the couple's common point, facing the other
    /// Of a couple: the other's dances. Both then keep to one metre, the mean of theirs: else one
    /// of them would go over to another octave before the other does.
    std::shared_ptr<const Repertoire> partner{};
    double aside = 0.0;  ///< to the left of the stage's centre; metres
    int bars_late = 0;   ///< begins so many bars after it could
};

}  // namespace raks::motion
