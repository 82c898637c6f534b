// Grid drawing: what the parts of the grid pane share while a frame is drawn.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "apps/grid/grid_pane.hpp"
#include "render/panes/widgets.hpp"

namespace raks::apps {

/// One frame of the pane: what there is to show, and what is asked for.
struct GridDrawing {
    const render::PaneFrame& frame;
    const GridSession& session;
    const GridView& view;
    GridBeats beats;  ///< as they are shown
    GridLayout layout;
    std::vector<GridWish> wishes{};

    [[nodiscard]] const render::Pen& pen() const noexcept { return frame.pen; }
    void wish(GridAction action) { wishes.emplace_back(std::move(action)); }
    /// x of a moment in the lanes.
    [[nodiscard]] float x(double time) const noexcept { return place_of(layout.lanes, view, time); }
    /// Whether something from one moment to another is seen in the lanes.
    [[nodiscard]] bool is_seen(double from, double to) const noexcept {
        return to >= view.from && from <= view.to;
    }
};

/// Draws the lanes, and takes up what the pointer does in them.
void draw_lanes(GridDrawing& drawing);

}  // namespace raks::apps
