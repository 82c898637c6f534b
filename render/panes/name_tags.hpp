// Name tags: names beside points, none over another as far as there is room.
#pragma once

#include <string>
#include <vector>

#include "render/panes/pane_context.hpp"

#include <glm/vec2.hpp>

namespace raks::render {

/// A name and the point that it belongs to; units.
struct NameTag {
    glm::vec2 at{};
    std::string name;
    Colour colour = palette::kText;
};

/// Where the tags' boxes go, of `widths` by `height` units: right of their point, else around it,
/// farther away where that is taken by a box before or by a point; inside `area` where one of these
/// places is. Pure; the same input, the same boxes.
[[nodiscard]] std::vector<Box> place_tags(const std::vector<glm::vec2>& points,
                                          const std::vector<float>& widths,
                                          float height,
                                          const Box& area);

/// Draws them, with a line to the point where the box is not beside it.
void draw_tags(const PaneFrame& frame, const std::vector<NameTag>& tags);

}  // namespace raks::render
