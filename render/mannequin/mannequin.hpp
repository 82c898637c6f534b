#pragma once

#include "render/avatar/avatar.hpp"
#include "render/model/mannequin_style.hpp"

namespace raks::render {

/// The built-in mannequin: a dancer of 1.71 m, made from formulas alone. Its skin is closed,
/// manifold and mirror-symmetric; over it, as a surface with a rig like that of any avatar, lie
/// eyes, brows, mouth, hair and clothes. At most 16,500 vertices in all (15,000 in a unitard). The
/// same binary makes the same bytes. Costs about 0.2 s of one core. Threads: any. Real-time: no
/// (allocates).
[[nodiscard]] Avatar build_mannequin(MannequinStyle style = {});

}  // namespace raks::render
