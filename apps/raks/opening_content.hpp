#pragma once

#include <functional>

#include "engine/show/window_loop.hpp"

namespace raks::apps {

/// Shows the stage and a dancer who waits, until `is_ready`. Returns whether the window is still
/// wanted. Threads: main.
[[nodiscard]] bool show_opening(engine::WindowLoop& window, const std::function<bool()>& is_ready);

}  // namespace raks::apps
