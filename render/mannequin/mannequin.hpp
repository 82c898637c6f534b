#pragma once

#include <cstdint>

#include "render/avatar/avatar.hpp"

namespace raks::render {

/// Builds of the mannequin; their skeletons are the same, so that all dance the same dances.
enum class MannequinBuild : std::uint8_t {
    follow,  ///< skirt (where the theme dresses) and ponytail
    lead,    ///< broader, in trousers, with short hair
};

/// The built-in mannequin: a dancer of 1.71 m, made from formulas alone. Its skin is closed,
/// manifold and mirror-symmetric; over it, as a surface with a rig like that of any avatar, lie
/// eyes, brows, mouth, hair and clothes. At most 15,000 vertices in all. The same binary makes the
/// same bytes. Costs about 0.2 s of one core. Threads: any. Real-time: no (allocates).
[[nodiscard]] Avatar build_mannequin(MannequinBuild build = MannequinBuild::follow);

}  // namespace raks::render
