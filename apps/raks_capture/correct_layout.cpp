// Layout of the correct pane.
#include <algorithm>

#include "apps/raks_capture/correct_pane.hpp"
#include "apps/raks_capture/pane_sizes.hpp"

namespace raks::apps {
namespace {

using render::Box;

constexpr float kTimeline = 112.0F;
constexpr float kBetween = 4.0F;

// Cells of one size in as few rows as show the widest of the shapes largest.
std::vector<Box> grid(const Box& room, const std::vector<double>& shapes) {
    double shape = 0.0;
    for (const double one : shapes) {
        shape = std::max(shape, one);
    }
    const std::size_t count = shapes.size();
    std::size_t columns = 1;
    double best = -1.0;
    const auto rows_of = [count](std::size_t of) { return (count + of - 1) / of; };
    for (std::size_t i = 1; i <= count; ++i) {
        const double width = static_cast<double>(room.width) / static_cast<double>(i);
        const double height = static_cast<double>(room.height) / static_cast<double>(rows_of(i));
        const double shown = std::min(width, height * shape);
        if (shown > best) {
            best = shown;
            columns = i;
        }
    }
    const float width = room.width / static_cast<float>(columns);
    const float height = room.height / static_cast<float>(rows_of(columns));
    std::vector<Box> cells;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t row = i / columns;
        cells.push_back({room.x + static_cast<float>(i % columns) * width,
                         room.y + static_cast<float>(row) * height,
                         width - kBetween,
                         height - kBetween});
    }
    return cells;
}

}  // namespace

CorrectLayout correct_layout(const Box& area,
                             const std::vector<double>& shapes,
                             std::size_t markers,
                             std::optional<std::size_t> alone,
                             CorrectKind kind) {
    using namespace pane_sizes;
    CorrectLayout layout;
    float x = area.x + kMargin;
    const auto next = [&](float width) {
        x += width + kBetween;
        return Box{x - width - kBetween, area.y + kMargin, width, kBar};
    };
    constexpr float kGroup = 10.0F;  // between groups of buttons
    // Joints have longer words: six more units are theirs.
    const float usual = kind == CorrectKind::joints ? 58.0F : 66.0F;
    layout.play = next(usual);
    layout.flag_before = next(usual);
    layout.flag_after = next(usual);
    layout.worst = next(usual);
    x += kGroup;
    if (kind == CorrectKind::joints) {
        layout.exchange = next(116.0F);
        layout.exchange_limb = next(94.0F);
        layout.hide = next(78.0F);
        layout.hide_view = next(84.0F);
    } else {
        layout.hide = next(60.0F);
        layout.fill = next(60.0F);
        layout.swap = next(100.0F);
    }
    x += kGroup;
    layout.track = next(106.0F);
    x = area.right() - kMargin - 58.0F - 58.0F - 72.0F - 2.0F * kBetween;
    layout.undo = next(58.0F);
    layout.redo = next(58.0F);
    layout.save = next(72.0F);

    const float right = area.right() - kMargin;
    const float top = area.y + kBar + 2.0F * kMargin;
    const float lines = area.bottom() - 2.0F * kLine - kMargin;
    layout.timeline = {
        area.x + kMargin, lines - kTimeline - kMargin, right - area.x - kMargin, kTimeline};
    const float bottom = layout.timeline.y - kMargin;
    const float list = right - kList;
    const Box room{
        area.x + kMargin, top, list - area.x - 2.0F * kMargin + kBetween, bottom - top + kBetween};
    if (alone) {
        layout.views.resize(shapes.size());
        layout.views[*alone] = {room.x, room.y, room.width - kBetween, room.height - kBetween};
    } else {
        layout.views = grid(room, shapes);
    }
    layout.title = {list, top, kList, 24.0F};
    layout.legend = {list + 4.0F,
                     layout.title.bottom(),
                     kList - 4.0F,
                     kind == CorrectKind::joints ? kLine : 0.0F};
    const float rows_top = layout.legend.bottom() + 2.0F;
    layout.markers = marker_rows({list, rows_top, kList, bottom - rows_top}, markers);
    layout.status = {area.x + kMargin, lines, right - area.x - kMargin, kLine};
    layout.keys = {area.x + kMargin, lines + kLine + 2.0F, right - area.x - kMargin, kLine};
    return layout;
}

CorrectLayout layout_of(const Box& area, const CorrectSession& session, const CorrectScene& scene) {
    std::vector<double> shapes;
    for (const CorrectView& view : scene.views) {
        shapes.push_back(static_cast<double>(view.width) / static_cast<double>(view.height));
    }
    return correct_layout(area,
                          shapes,
                          session.tracks.markers.size(),
                          session.alone,
                          session.is_of_joints ? CorrectKind::joints : CorrectKind::markers);
}

}  // namespace raks::apps
