#include "render/gl/glfw_opening.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "render/gl/glfw_monitors.hpp"
#include "render/gl/window_place.hpp"

namespace raks::render {
namespace {

void set_hints(const WindowOptions& options) {
    const auto yes_no = [](bool is_on) { return is_on ? GLFW_TRUE : GLFW_FALSE; };
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    // macOS gives a core context only with this; elsewhere it does no harm.
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SAMPLES, options.samples);
    glfwWindowHint(GLFW_TRANSPARENT_FRAMEBUFFER, yes_no(options.is_transparent));
    glfwWindowHint(GLFW_DECORATED, yes_no(!options.is_borderless));
    glfwWindowHint(GLFW_FLOATING, yes_no(options.is_on_top));
    // Shown once it is where it was.
    glfwWindowHint(GLFW_VISIBLE, yes_no(options.is_visible && !options.place));
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "raks");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "raks");
}

}  // namespace

// Not every driver has contexts of which it tells that they are lost.
GLFWwindow* open_glfw_window(const WindowOptions& options) {
    OpeningPlace opening{.at = {}, .width = options.width, .height = options.height};
    if (options.place) {
        opening = opening_place(*options.place, monitor_places());
    }
    const auto create = [&](int robustness) {
        set_hints(options);
        glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, robustness);
        return glfwCreateWindow(
            opening.width, opening.height, options.title.c_str(), nullptr, nullptr);
    };
    GLFWwindow* handle = options.outlives_loss ? create(GLFW_LOSE_CONTEXT_ON_RESET) : nullptr;
    handle = handle != nullptr ? handle : create(GLFW_NO_ROBUSTNESS);
    if (handle != nullptr && options.place) {
        if (opening.at) {
            glfwSetWindowPos(handle, opening.at->x, opening.at->y);
        }
        if (options.is_visible) {
            glfwShowWindow(handle);
        }
    }
    return handle;
}

}  // namespace raks::render
