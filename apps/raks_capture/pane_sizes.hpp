// Pane sizes: what the panes of capture have in common; all in units.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "render/overlay/pen.hpp"

/// Sizes of capture's panes.
namespace raks::apps::pane_sizes {

inline constexpr float kMargin = 8.0F;     ///< between parts
inline constexpr float kBar = 30.0F;       ///< height of buttons
inline constexpr float kLine = 20.0F;      ///< height of a line of text
inline constexpr float kList = 236.0F;     ///< width of the list of markers
inline constexpr float kLeastRow = 19.0F;  ///< height of its rows
inline constexpr float kMostRow = 27.0F;   ///< likewise
inline constexpr float kNear = 10.0F;      ///< a press so near to a point is meant for it
inline constexpr float kMoves = 3.0F;      ///< a point follows the pointer from so far on

/// Rows of markers from the top of `room` on, as many as there is room for, at least one.
[[nodiscard]] inline std::vector<render::Box> marker_rows(const render::Box& room,
                                                          std::size_t markers) {
    const float height = std::max(room.height, kLeastRow);
    const float row = std::clamp(height / static_cast<float>(markers), kLeastRow, kMostRow);
    const auto count = std::min(markers, static_cast<std::size_t>(height / row));
    std::vector<render::Box> rows;
    for (std::size_t i = 0; i < count; ++i) {
        rows.push_back({room.x, room.y + static_cast<float>(i) * row, room.width, row - 1.0F});
    }
    return rows;
}

/// The first row that is shown after a turn of the wheel over the list.
[[nodiscard]] inline std::size_t scrolled(std::size_t first,
                                          float wheel,
                                          std::size_t rows,
                                          std::size_t markers) {
    constexpr std::size_t kStep = 3;
    const std::size_t last = markers - rows;
    return wheel > 0.0F ? first - std::min(first, kStep) : std::min(first + kStep, last);
}

}  // namespace raks::apps::pane_sizes
