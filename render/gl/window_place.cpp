#include "render/gl/window_place.hpp"

#include <algorithm>

namespace raks::render {
namespace {

// The monitor of this name, of several the one at this place; null: it is gone.
const MonitorPlace* monitor_for(const WindowPlace& place, std::span<const MonitorPlace> monitors) {
    const MonitorPlace* found = nullptr;
    for (const MonitorPlace& monitor : monitors) {
        if (monitor.name != place.monitor) {
            continue;
        }
        if (monitor.x == place.monitor_x && monitor.y == place.monitor_y) {
            return &monitor;
        }
        found = found == nullptr ? &monitor : found;
    }
    return found;
}

// Moved so that [at, at + size) lies in [low, low + room), which is no smaller.
int moved_into(int at, int size, int low, int room) {
    return std::clamp(at, low, low + room - size);
}

}  // namespace

OpeningPlace opening_place(const WindowPlace& place, std::span<const MonitorPlace> monitors) {
    OpeningPlace opening{
        .at = OpeningPlace::Point{place.x, place.y}, .width = place.width, .height = place.height};
    if (monitors.empty()) {
        return opening;
    }
    const MonitorPlace* const found = monitor_for(place, monitors);
    const MonitorPlace& monitor = found != nullptr ? *found : monitors.front();
    opening.width = std::min(place.width, std::max(monitor.work_width, 1));
    opening.height = std::min(place.height, std::max(monitor.work_height, 1));
    if (found == nullptr) {
        opening.at.reset();
        return opening;
    }
    opening.at->x = moved_into(monitor.x + (place.x - place.monitor_x),
                               opening.width,
                               monitor.work_x,
                               std::max(monitor.work_width, 1));
    opening.at->y = moved_into(monitor.y + (place.y - place.monitor_y),
                               opening.height,
                               monitor.work_y,
                               std::max(monitor.work_height, 1));
    return opening;
}

}  // namespace raks::render
