#pragma once

#include "render/renderer.hpp"

namespace raks::render {

/// Draws an avatar once in a context of this thread's own. Drivers finish shaders when they are
/// first used and keep them in a cache on disk: the renderer of a window then finds them there,
/// where a software driver would stop its picture for half a second. Does nothing where there is no
/// such context. `quality`: fast or high. Threads: workers. Real-time: no.
void warm_up_shaders(const Avatar& avatar, Quality quality);

}  // namespace raks::render
