#include "render/panes/timeline.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/panes/widgets.hpp"

namespace raks::render {
namespace {

constexpr float kNames = 86.0F;      // width of the names at the left
constexpr float kRowHeight = 11.0F;  // of marks
constexpr float kPad = 4.0F;

/// Where the parts of a timeline are.
struct TimelineParts {
    Box curve;
    Box marks;
};

TimelineParts parts_of(const Box& box, std::size_t rows) {
    const Box frames = timeline_frames(box);
    const float marks = static_cast<float>(rows) * kRowHeight;
    return {{frames.x, frames.y + kPad, frames.width, frames.height - marks - 2.0F * kPad},
            {frames.x, frames.bottom() - marks - kPad / 2.0F, frames.width, marks}};
}

// One column of the curve for each pixel: its largest value, so that no peak is lost.
void draw_curve(const PaneFrame& frame, const Box& box, const TimelineState& state) {
    const float step = 1.0F / frame.pen.unit();
    const auto count = std::min(state.curve.size(), state.frame_count);
    const auto columns = static_cast<int>(std::round(box.width / step));
    const float left = std::round(box.x / step);
    for (int column = 0; column < columns; ++column) {
        const float x = (left + static_cast<float>(column)) * step;
        const std::size_t first = timeline_frame(box, x, state.frame_count);
        const std::size_t end =
            std::max(timeline_frame(box, x + step, state.frame_count), first + 1);
        double most = -std::numeric_limits<double>::infinity();
        bool has_gap = false;
        for (std::size_t i = first; i < std::min(end, count); ++i) {
            has_gap = has_gap || std::isnan(state.curve[i]);
            most = std::isnan(state.curve[i]) ? most : std::max(most, state.curve[i]);
        }
        if (has_gap) {
            frame.pen.fill({x, box.y, step, box.height}, palette::kRed.faded(0.28F));
        }
        if (std::isfinite(most)) {
            const auto share = static_cast<float>(std::clamp(most / state.top, 0.0, 1.0));
            const float height = std::max(share * box.height, step);
            frame.pen.fill({x, box.bottom() - height, step, height},
                           share >= 1.0F ? palette::kAmber : palette::kTeal.faded(0.85F));
        }
    }
}

void draw_marks(const PaneFrame& frame, const Box& box, const TimelineState& state) {
    for (const TimelineMark& mark : state.marks) {
        const float half = box.width / static_cast<float>(state.frame_count) / 2.0F;
        const float from = timeline_x(box, mark.first, state.frame_count) - half;
        const float to = timeline_x(box, mark.last, state.frame_count) + half;
        // Short ones stay visible.
        const float width = std::max(to - from, 2.0F);
        frame.pen.fill({from,
                        box.y + static_cast<float>(mark.row) * kRowHeight + 1.0F,
                        width,
                        kRowHeight - 2.0F},
                       mark.colour);
    }
}

void draw_names(const PaneFrame& frame,
                const Box& box,
                const TimelineParts& parts,
                const TimelineState& state) {
    const Pen& pen = frame.pen;
    const ImFont* const font = pen.fonts().small;
    pen.text(font, box.x + kPad, parts.curve.y, palette::kText, state.title);
    pen.text(
        font, parts.curve.x - kPad, parts.curve.y, palette::kDim, state.top_text, Align::right);
    for (std::size_t row = 0; row < state.rows.size(); ++row) {
        pen.text(font,
                 box.x + kPad,
                 parts.marks.y + static_cast<float>(row) * kRowHeight - 2.0F,
                 palette::kDim,
                 state.rows[row]);
    }
}

}  // namespace

Box timeline_frames(const Box& box) noexcept {
    return {box.x + kNames, box.y, box.width - kNames - kPad, box.height};
}

float timeline_x(const Box& box, std::size_t frame, std::size_t frame_count) noexcept {
    return box.x + box.width * (static_cast<float>(frame) + 0.5F) / static_cast<float>(frame_count);
}

std::size_t timeline_frame(const Box& box, float x, std::size_t frame_count) noexcept {
    const float share = std::clamp((x - box.x) / box.width, 0.0F, 1.0F);
    return std::min(static_cast<std::size_t>(share * static_cast<float>(frame_count)),
                    frame_count - 1);
}

std::optional<std::size_t> timeline(const PaneFrame& frame,
                                    const Box& box,
                                    const TimelineState& state) {
    const Pen& pen = frame.pen;
    pen.fill(box, pane_colours::kSunken);
    const TimelineParts parts = parts_of(box, state.rows.size());
    if (state.stretch_first) {
        const float from = timeline_x(parts.curve, *state.stretch_first, state.frame_count);
        const float to = timeline_x(parts.curve, state.stretch_last, state.frame_count);
        pen.fill({from, box.y, std::max(to - from, 2.0F), box.height}, palette::kAmber.faded(0.2F));
    }
    draw_curve(frame, parts.curve, state);
    draw_marks(frame, parts.marks, state);
    draw_names(frame, box, parts, state);
    // Of one frame alone there is no place to show.
    const float x = state.frame_count > 1 ? timeline_x(parts.curve, state.frame, state.frame_count)
                                          : timeline_frames(box).x;
    pen.fill({x - 0.75F, box.y, 1.5F, box.height}, palette::kText);
    pen.triangle({x - 5.0F, box.y}, {x + 5.0F, box.y}, {x, box.y + 6.0F}, palette::kText);

    const Box frames = timeline_frames(box);
    [[maybe_unused]] const PaneItem item = pane_item(frames, "timeline", frame);
    return ImGui::IsItemActive()
               ? std::optional(timeline_frame(frames, frame.pointer.x, state.frame_count))
               : std::nullopt;
}

}  // namespace raks::render
