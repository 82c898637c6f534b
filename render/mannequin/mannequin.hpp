#pragma once

#include "render/avatar/avatar.hpp"

namespace raks::render {

/// The built-in mannequin: a dancer of 1.71 m, closed, manifold and mirror-symmetric, 10,000 to
/// 15,000 vertices, made from formulas alone. The same binary makes the same bytes. Costs about
/// 0.2 s of one core.
/// Threads: any. Real-time: no (allocates).
[[nodiscard]] Avatar build_mannequin();

}  // namespace raks::render
