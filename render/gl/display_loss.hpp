#pragma once

/// What becomes of the process when its display goes away.
namespace raks::render {

/// From now on the process outlives the display that GLFW has opened (Xlib would end it):
/// is_display_lost() says that it is gone, and nothing of the display or of GLFW may be used then.
/// Where Xlib is older than 1.7, or another system shows the windows, nothing changes. GLFW must be
/// up. Threads: main.
void outlive_display() noexcept;

/// Whether the display that outlive_display() was called for is gone. Threads: main.
[[nodiscard]] bool is_display_lost() noexcept;

}  // namespace raks::render
