// Timeline: a curve over the frames of something, with stretches that are marked, and the frame
// that is looked at.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "render/panes/pane_context.hpp"

namespace raks::render {

/// A stretch of frames that is marked.
struct TimelineMark {
    std::size_t first = 0;  ///< frame
    std::size_t last = 0;   ///< frame, included
    std::size_t row = 0;    ///< in which row below the curve
    Colour colour;
};

/// What a timeline shows. Views live until it is drawn.
struct TimelineState {
    std::size_t frame_count = 1;      ///< >= 1
    std::size_t frame = 0;            ///< that is looked at
    std::span<const double> curve{};  ///< by frame; NaN: a gap, drawn red
    double top = 1.0;                 ///< value at the curve's upper edge; > 0
    std::string_view title{};         ///< what the curve is
    std::string_view top_text{};      ///< `top`, with its unit
    std::span<const TimelineMark> marks{};
    std::vector<std::string_view> rows{};        ///< names of the rows of marks
    std::optional<std::size_t> stretch_first{};  ///< a stretch that was chosen: its first frame
    std::size_t stretch_last = 0;                ///< and its last
};

/// x of the middle of a frame; units.
[[nodiscard]] float timeline_x(const Box& box, std::size_t frame, std::size_t frame_count) noexcept;
/// The frame at an x, the nearest where it is beside the timeline.
[[nodiscard]] std::size_t timeline_frame(const Box& box, float x, std::size_t frame_count) noexcept;
/// The part of a timeline's box in which frames are: the rest holds names.
[[nodiscard]] Box timeline_frames(const Box& box) noexcept;

/// Draws it. Result: the frame that a person clicked or drags to.
[[nodiscard]] std::optional<std::size_t> timeline(const PaneFrame& frame,
                                                  const Box& box,
                                                  const TimelineState& state);

}  // namespace raks::render
