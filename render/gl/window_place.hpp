#pragma once

#include <optional>
#include <span>
#include <string>

/// Where a window lies on a desktop of several monitors, in screen coordinates. Pure.
namespace raks::render {

/// A monitor.
struct MonitorPlace {
    std::string name;  ///< such as "DP-1"; two may have the same
    int x = 0;         ///< of its left edge
    int y = 0;         ///< of its upper edge
    int work_x = 0;    ///< of what panels of the desktop leave free: left edge
    int work_y = 0;    ///< upper edge
    int work_width = 0;
    int work_height = 0;
};

/// Where a window was: what lies within its frame.
struct WindowPlace {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    std::string monitor;  ///< that held most of it
    int monitor_x = 0;    ///< where that monitor's left edge was
    int monitor_y = 0;    ///< and its upper edge
    friend bool operator==(const WindowPlace&, const WindowPlace&) = default;
};

/// A window that opens.
struct OpeningPlace {
    /// A point of the screen.
    struct Point {
        int x = 0;
        int y = 0;
        friend bool operator==(const Point&, const Point&) = default;
    };
    std::optional<Point> at;  ///< none: where the desktop puts it
    int width = 0;
    int height = 0;
};

/// Where a window opens that was at `place`: on the same monitor, by its name, and of two with one
/// name by its place, too; wherever that monitor is now, and as a whole within what panels leave
/// free. Of a monitor that is gone the size alone is kept, as far as the first has room.
/// `monitors`: the desktop's, its main one first; none: as it was.
[[nodiscard]] OpeningPlace opening_place(const WindowPlace& place,
                                         std::span<const MonitorPlace> monitors);

}  // namespace raks::render
