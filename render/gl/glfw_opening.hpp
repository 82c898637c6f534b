#pragma once

#include "render/gl/window.hpp"

// GLFW's own; its header stays out of this one.
struct GLFWwindow;

namespace raks::render {

/// Opens a window of GLFW with a context of OpenGL 3.3, as and where the options say. Null: the
/// system refuses it, and glfwGetError() says why. GLFW must be up. Threads: main.
[[nodiscard]] GLFWwindow* open_glfw_window(const WindowOptions& options);

}  // namespace raks::render
