// MMD morphs: the shapes of faces that MikuMikuDance's bodies share, as expressions.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motion/skeleton/expression_track.hpp"
#include "motion/skeleton/formats/mmd/mmd_motion.hpp"

namespace raks::motion {

/// The number of the morph that a name in a file says (bytes, as mmd_bone_named takes them). None:
/// one that no expression stands for.
[[nodiscard]] std::optional<std::size_t> mmd_morph_named(std::string_view bytes);

/// The morph that stands for an expression of VRM 1.0 when a motion is written, in UTF-8; empty:
/// there is none.
[[nodiscard]] std::string_view mmd_morph_of(std::string_view expression);

/// The weights of the expressions that a motion's morphs stand for, one a frame; those that stay at
/// zero are left out. Several morphs of one expression: the largest counts.
[[nodiscard]] std::vector<ExpressionTrack> mmd_expressions(const MmdMotion& motion,
                                                           std::size_t frames);

}  // namespace raks::motion
