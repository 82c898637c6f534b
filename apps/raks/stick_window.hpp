#pragma once

#include <string>

#include "base/expected.hpp"
#include "engine/setup/settings.hpp"
#include "engine/show/picture.hpp"
#include "engine/show/window_loop.hpp"
#include "render/gl/window.hpp"

namespace raks::apps {

/// Opens a window for what `raks stick` shows. Errors: no display, no OpenGL 3.3.
[[nodiscard]] Expected<render::Window> open_stick_window(const std::string& name,
                                                         const engine::Look& look,
                                                         const engine::Settings& settings);

/// Shows `content` in the window until it is closed, Q or Esc is pressed, or a signal comes.
/// Errors: no OpenGL 3.3.
[[nodiscard]] Expected<void> show_in_window(render::Window window,
                                            const engine::Look& look,
                                            engine::WindowContent& content);

}  // namespace raks::apps
