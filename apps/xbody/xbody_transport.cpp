// The transport of the Xbody pane.
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "apps/xbody/xbody_drawing.hpp"
#include "render/panes/timeline.hpp"

#include <fmt/format.h>

namespace raks::apps {

namespace palette = render::palette;

void draw_transport(XbodyDrawing& drawing) {
    const render::OverlayTransport clip = drawing.session.transport.picture();
    const std::size_t last = clip.frame_count - 1;
    const std::size_t now = clip.frame;
    const bool has_clip = last > 0;
    const std::array<std::pair<const char*, std::size_t>, 4> steps = {
        {{"|<", 0},
         {"<", now - std::min<std::size_t>(now, 1)},
         {">", std::min(now + 1, last)},
         {">|", last}}};
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const render::Box& box = drawing.layout.steps[i < 2 ? i : i + 1];
        if (drawing.button(box, steps[i].first, has_clip)) {
            drawing.wish(GoToFrame{steps[i].second});
        }
    }
    if (drawing.button(drawing.layout.steps[2], clip.is_paused ? "Play" : "Pause", has_clip)) {
        drawing.wish(PlayOrPause{});
    }
    drawing.pen().fill(drawing.layout.number, render::pane_colours::kSunken, 5.0F);
    const std::string typed(clip.typed);
    drawing.text(
        {drawing.layout.number.x,
         drawing.layout.number.y + 3.0F,
         drawing.layout.number.width,
         20.0F},
        8.0F,
        typed.empty() ? palette::kText : palette::kTeal,
        typed.empty() ? fmt::format("frame {} of {}", now, clip.frame_count) : typed + "_");
    if (drawing.button(drawing.layout.slower, "-", has_clip)) {
        drawing.wish(SetRate{clip.rate - 0.25});
    }
    drawing.pen().text(drawing.pen().fonts().body,
                       drawing.layout.rate.x + drawing.layout.rate.width / 2.0F,
                       drawing.layout.rate.y + 5.0F,
                       palette::kText,
                       fmt::format("x {:g}", clip.rate),
                       render::Align::middle);
    if (drawing.button(drawing.layout.faster, "+", has_clip)) {
        drawing.wish(SetRate{clip.rate + 0.25});
    }
    const render::TimelineState state{
        .frame_count = clip.frame_count, .frame = now, .title = has_clip ? "frames" : "no motion"};
    const auto chosen = timeline(drawing.frame, drawing.layout.timeline, state);
    if (has_clip && chosen && *chosen != now) {
        drawing.wish(GoToFrame{*chosen});
    }
}

}  // namespace raks::apps
