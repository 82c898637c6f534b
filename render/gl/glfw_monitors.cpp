#include "render/gl/glfw_monitors.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace raks::render {

std::span<GLFWmonitor* const> all_monitors() {
    int count = 0;
    GLFWmonitor** const monitors = glfwGetMonitors(&count);
    return {monitors, static_cast<std::size_t>(count)};
}

Rectangle rectangle_of(GLFWwindow* window) {
    Rectangle own;
    glfwGetWindowPos(window, &own.x, &own.y);
    glfwGetWindowSize(window, &own.width, &own.height);
    return own;
}

GLFWmonitor* monitor_under(const Rectangle& own) {
    GLFWmonitor* best = glfwGetPrimaryMonitor();
    long best_area = 0;
    for (GLFWmonitor* const monitor : all_monitors()) {
        const GLFWvidmode* const mode = glfwGetVideoMode(monitor);
        if (mode == nullptr) {
            continue;
        }
        int x = 0;
        int y = 0;
        glfwGetMonitorPos(monitor, &x, &y);
        // Sides of the rectangle that window and monitor have in common.
        const long wide = std::min(own.x + own.width, x + mode->width) - std::max(own.x, x);
        const long high = std::min(own.y + own.height, y + mode->height) - std::max(own.y, y);
        if (wide > 0 && high > 0 && wide * high > best_area) {
            best_area = wide * high;
            best = monitor;
        }
    }
    return best;
}

GLFWmonitor* monitor_of(GLFWwindow* window) { return monitor_under(rectangle_of(window)); }

std::string name_of(GLFWmonitor* monitor) {
    const char* const name = glfwGetMonitorName(monitor);
    return name != nullptr ? name : "";
}

std::vector<MonitorPlace> monitor_places() {
    std::vector<MonitorPlace> places;
    for (GLFWmonitor* const monitor : all_monitors()) {
        MonitorPlace place{.name = name_of(monitor)};
        glfwGetMonitorPos(monitor, &place.x, &place.y);
        glfwGetMonitorWorkarea(
            monitor, &place.work_x, &place.work_y, &place.work_width, &place.work_height);
        places.push_back(std::move(place));
    }
    return places;
}

std::optional<double> refresh_rate_of(GLFWwindow* window) {
    GLFWmonitor* const monitor = monitor_of(window);
    const GLFWvidmode* const mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    return mode != nullptr && mode->refreshRate > 0 ? std::optional<double>(mode->refreshRate)
                                                    : std::nullopt;
}

}  // namespace raks::render
