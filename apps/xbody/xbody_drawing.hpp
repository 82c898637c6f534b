// Xbody drawing: what the parts of the Xbody pane share while a frame is drawn.
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/xbody/xbody_pane.hpp"
#include "render/panes/widgets.hpp"

namespace raks::apps {

/// One frame of the pane: what there is to show, and what is asked for.
struct XbodyDrawing {
    const render::PaneFrame& frame;
    const XbodySession& session;
    const XbodyView& view;
    XbodyLayout layout;
    std::vector<XbodyWish> wishes{};

    [[nodiscard]] const render::Pen& pen() const noexcept { return frame.pen; }
    void wish(XbodyAction action) { wishes.emplace_back(std::move(action)); }
    /// True: it was clicked. `is_chosen`: what it stands for is on.
    [[nodiscard]] bool button(const render::Box& box,
                              std::string_view label,
                              bool is_possible,
                              bool is_chosen = false) const {
        return pane_button(frame,
                           box,
                           label,
                           !is_possible ? render::ButtonLook::off
                           : is_chosen  ? render::ButtonLook::chosen
                                        : render::ButtonLook::usual);
    }
    /// A line, cut at the end of its box.
    void text(const render::Box& box,
              float indent,
              render::Colour colour,
              std::string_view line) const {
        pen().text(pen().fonts().body,
                   box.x + indent,
                   box.y + 2.0F,
                   colour,
                   line,
                   render::Align::left,
                   box.width - indent - 4.0F);
    }
    /// The first line of a list of `count` that is in its rows: `first`, or an earlier one, so that
    /// no row is empty that need not be. Draws a mark beside rows that do not have them all.
    [[nodiscard]] std::size_t list_begin(const std::vector<render::Box>& rows,
                                         std::size_t first,
                                         std::size_t count) const;
    /// Where a list begins after the wheel was turned over its rows; none: it was not.
    [[nodiscard]] std::optional<std::size_t> scrolled(const std::vector<render::Box>& rows,
                                                      std::size_t first,
                                                      std::size_t count) const;
};

/// The tree, its search, and the button below it.
void draw_tree(XbodyDrawing& drawing);
/// The right pane: its pages and the buttons of labels.
void draw_pages(XbodyDrawing& drawing);
/// Frame, rate and timeline.
void draw_transport(XbodyDrawing& drawing);

}  // namespace raks::apps
