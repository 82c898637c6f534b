// Known body: what the reader of a clip knows of the body in it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "motion/skeleton/humanoid_mapping.hpp"

namespace raks::motion {

/// The body of a clip that lies in a model, as the model's own finder has it, which knows more than
/// motion shows: what the file states, the flesh on the joints. A clip with one is not searched for
/// another, so that a model has the same bones whether it is worn or its clip is danced.
struct KnownBody {
    HumanoidMapping mapping;
    std::array<std::string, kBoneCount> reasons;  ///< by bone, a few words; empty: not found
    std::array<double, kBoneCount> confidence{};  ///< by bone, 0 (not found) to 1
    std::optional<double> height;                 ///< of the mesh at rest, file units; > 0
    /// Way that it faces at rest, about up: 0 is +z, +90 is +x; degrees.
    std::optional<double> facing;
};

}  // namespace raks::motion
