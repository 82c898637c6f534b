#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/gl/window_place.hpp"

// GLFW's own; its header stays out of this one.
struct GLFWmonitor;
struct GLFWwindow;

/// The monitors of the desktop, as GLFW tells them. GLFW must be up. Threads: main.
namespace raks::render {

/// A part of the screen, in screen coordinates, which are not pixels on every system.
struct Rectangle {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// All monitors, the main one first.
[[nodiscard]] std::span<GLFWmonitor* const> all_monitors();
/// What lies within the frame of a window.
[[nodiscard]] Rectangle rectangle_of(GLFWwindow* window);
/// The monitor that shows most of this part of the screen, or the first one; null: there is none.
[[nodiscard]] GLFWmonitor* monitor_under(const Rectangle& own);
/// The monitor that shows most of the window, or the first one; null: there is none.
[[nodiscard]] GLFWmonitor* monitor_of(GLFWwindow* window);
/// Such as "DP-1".
[[nodiscard]] std::string name_of(GLFWmonitor* monitor);
/// Where all of them are, the main one first.
[[nodiscard]] std::vector<MonitorPlace> monitor_places();
/// Pictures a second of the monitor that the window is on, where it tells.
[[nodiscard]] std::optional<double> refresh_rate_of(GLFWwindow* window);

}  // namespace raks::render
