// The time line of the grid pane.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "apps/grid/grid_drawing.hpp"
#include "base/statistics.hpp"

namespace raks::apps {
namespace {

using render::Align;
using render::Box;
using render::Colour;
namespace palette = render::palette;
namespace pane_colours = render::pane_colours;

constexpr Colour kLeftFoot{0x62D0C8};
constexpr Colour kRightFoot{0xF27B45};
constexpr Colour kSongBeat{0xA878FF};
constexpr float kNear = 5.0F;   // units: a press so near to a beat is meant for it
constexpr float kMoves = 5.0F;  // a beat follows the pointer from so far on

Colour colour_of(const motion::GridBeat& beat) {
    return !beat.is_used    ? palette::kDim.faded(0.45F)
           : beat.half == 1 ? palette::kAmber
                            : palette::kText;
}

void name_lane(const GridDrawing& drawing, const Box& lane, std::string_view name) {
    drawing.pen().text(drawing.pen().fonts().small,
                       lane.x - 8.0F,
                       lane.y + 1.0F,
                       palette::kDim,
                       name,
                       Align::right);
}

void draw_ruler(const GridDrawing& drawing) {
    const double span = drawing.view.to - drawing.view.from;
    double step = 0.5;
    while (span / step > 16.0) {
        step *= 2.0;
    }
    for (double second = std::ceil(drawing.view.from / step) * step; second <= drawing.view.to;
         second += step) {
        const float x = drawing.x(second);
        if (x > drawing.layout.lanes.right() - 4.0F) {
            break;
        }
        drawing.pen().line(
            x, drawing.layout.lanes.y, x, drawing.layout.lanes.bottom(), pane_colours::kLine);
        drawing.pen().text(drawing.pen().fonts().small,
                           x + 3.0F,
                           drawing.layout.ruler.y + 1.0F,
                           palette::kDim,
                           fmt::format("{:g} s", second),
                           Align::left,
                           drawing.layout.lanes.right() - x - 4.0F);
    }
    name_lane(drawing, drawing.layout.ruler, "time");
}

// A curve of values by row from the bottom of a lane upwards; the largest of each column.
void draw_curve(const GridDrawing& drawing,
                const Box& lane,
                const std::vector<double>& values,
                double rate,
                double start,
                double low,
                double high,
                Colour colour) {
    const render::Pen& pen = drawing.pen();
    const float step = 1.0F / pen.unit();
    if (values.empty()) {
        return;
    }
    for (float x = lane.x; x < lane.right(); x += step) {
        const auto time_of = [&](float at) {
            return drawing.view.from + static_cast<double>((at - lane.x) / lane.width) *
                                           (drawing.view.to - drawing.view.from);
        };
        const double first = (time_of(x) - start) * rate;
        const double last = (time_of(x + step) - start) * rate;
        if (last < 0.0 || first > static_cast<double>(values.size() - 1)) {
            continue;
        }
        const auto begin = static_cast<std::size_t>(std::max(first, 0.0));
        const auto end =
            std::min(std::max(static_cast<std::size_t>(last), begin + 1), values.size());
        double most = values[std::min(begin, values.size() - 1)];
        for (std::size_t i = begin; i < end; ++i) {
            most = std::max(most, values[i]);
        }
        const auto share =
            static_cast<float>(std::clamp((most - low) / std::max(high - low, 1e-6), 0.0, 1.0));
        const float height = std::max(share * lane.height, step);
        pen.fill({x, lane.bottom() - height, step, height}, colour);
    }
}

void draw_motion(const GridDrawing& drawing) {
    const motion::GridCues& cues = *drawing.view.cues;
    constexpr double kFastest = 2.5;  // m/s
    draw_curve(drawing,
               drawing.layout.feet,
               cues.feet_speed,
               motion::kCueRate,
               0.0,
               0.0,
               kFastest,
               palette::kTeal.faded(0.55F));
    // Leaps and what lies on the floor at the ends may be cut.
    const double low = lower_percentile(cues.hips_height, 0.01);
    const double high = lower_percentile(cues.hips_height, 0.99);
    draw_curve(drawing,
               drawing.layout.hips,
               cues.hips_height,
               motion::kCueRate,
               0.0,
               low - 0.2 * (high - low),
               high,
               palette::kDim.faded(0.5F));
    name_lane(drawing, drawing.layout.feet, "feet's speed");
    name_lane(drawing, drawing.layout.hips, "hips' height");
    name_lane(drawing, drawing.layout.landings, "landings");
    for (const motion::CueLanding& landing : cues.landings) {
        if (!drawing.is_seen(landing.time, landing.time)) {
            continue;
        }
        const bool is_left = landing.side == motion::Side::left;
        const float x = drawing.x(landing.time);
        const float y = drawing.layout.landings.y + (is_left ? 0.0F : 14.0F);
        drawing.pen().fill({x - 1.0F, y + 1.0F, 2.0F, 12.0F}, is_left ? kLeftFoot : kRightFoot);
        drawing.pen().text(drawing.pen().fonts().small,
                           x + 3.0F,
                           y - 1.0F,
                           is_left ? kLeftFoot : kRightFoot,
                           is_left ? "L" : "R");
    }
}

void draw_repeats(const GridDrawing& drawing) {
    const Box& lane = drawing.layout.repeats;
    name_lane(drawing, lane, "repeats");
    for (const motion::FoundLag& lag : *drawing.view.repeats) {
        if (!drawing.is_seen(lag.start, lag.end)) {
            continue;
        }
        const float from = std::max(drawing.x(lag.start), lane.x);
        const float to = std::min(drawing.x(lag.end), lane.right());
        // The more alike, the brighter.
        const auto share = static_cast<float>(std::clamp(1.4 - 2.0 * lag.distance, 0.2, 1.0));
        drawing.pen().fill({from, lane.y + 2.0F, to - from - 1.0F, lane.height - 4.0F},
                           Colour{0x3C6E9E}.faded(share),
                           3.0F);
        const float middle = drawing.x(0.5 * (lag.start + lag.end));
        drawing.pen().fill({middle - 1.0F, lane.y, 2.0F, lane.height}, palette::kText);
        drawing.pen().text(drawing.pen().fonts().small,
                           from + 4.0F,
                           lane.y + 1.0F,
                           palette::kText,
                           fmt::format("{:.2f} s", lag.seconds),
                           Align::left,
                           middle - from - 6.0F);
    }
}

void draw_song(const GridDrawing& drawing) {
    if (drawing.view.song == nullptr) {
        return;
    }
    const Box& lane = drawing.layout.song;
    name_lane(drawing, lane, "song");
    draw_curve(drawing,
               lane,
               drawing.view.song->onsets,
               kOnsetRate,
               -drawing.view.offset,
               0.0,
               1.0,
               kSongBeat.faded(0.5F));
    for (const motion::MusicBeat& beat : drawing.view.song->music.beats) {
        const double time = beat.seconds - drawing.view.offset;
        if (drawing.is_seen(time, time)) {
            const bool is_bar = beat.bar_position == 1;
            drawing.pen().fill({drawing.x(time) - 0.75F, lane.y, is_bar ? 2.5F : 1.0F, lane.height},
                               is_bar ? palette::kText : kSongBeat);
        }
    }
}

void draw_beats(const GridDrawing& drawing) {
    const render::Pen& pen = drawing.pen();
    const Box& lane = drawing.layout.beats;
    name_lane(drawing, lane, "beats");
    for (std::size_t i = 0; i < drawing.beats.size(); ++i) {
        const motion::GridBeat& beat = drawing.beats[i];
        const bool has_next = i + 1 < drawing.beats.size();
        const double next = has_next ? drawing.beats[i + 1].time : beat.time;
        if (!drawing.is_seen(beat.time, next)) {
            continue;
        }
        const float x = drawing.x(beat.time);
        // What is danced between this beat and the next one.
        if (beat.is_used && has_next) {
            const float from = std::max(x, lane.x);
            const float to = std::min(drawing.x(next), lane.right());
            pen.fill({from, lane.bottom() - 4.0F, std::max(to - from - 1.0F, 1.0F), 4.0F},
                     palette::kAmber.faded(0.5F));
        }
        if (!drawing.is_seen(beat.time, beat.time)) {
            continue;
        }
        const Colour colour = colour_of(beat);
        pen.fill({x - 0.75F, lane.y + 8.0F, 1.5F, drawing.layout.lanes.bottom() - lane.y - 8.0F},
                 colour.faded(0.55F));
        pen.triangle({x - 6.0F, lane.y}, {x + 6.0F, lane.y}, {x, lane.y + 11.0F}, colour);
        if (drawing.session.chosen == i) {
            pen.outline({x - 8.0F, lane.y - 2.0F, 16.0F, 16.0F}, palette::kTeal, 3.0F);
        }
        // Numbers where there is room.
        if (i == 0 || !has_next || drawing.x(next) - x > 20.0F) {
            pen.text(pen.fonts().small, x + 3.0F, lane.y + 12.0F, colour, std::to_string(i + 1));
        }
    }
}

void draw_stretch(const GridDrawing& drawing) {
    if (!drawing.session.stretch) {
        return;
    }
    const Box& lanes = drawing.layout.lanes;
    const float from = std::clamp(drawing.x(drawing.session.stretch->from), lanes.x, lanes.right());
    const float to = std::clamp(drawing.x(drawing.session.stretch->to), lanes.x, lanes.right());
    drawing.pen().fill({from, lanes.y, std::max(to - from, 1.0F), lanes.height},
                       palette::kAmber.faded(0.13F));
}

void draw_now(const GridDrawing& drawing) {
    const Box& lanes = drawing.layout.lanes;
    if (!drawing.is_seen(drawing.view.now, drawing.view.now)) {
        return;
    }
    const float x = drawing.x(drawing.view.now);
    drawing.pen().fill({x - 1.0F, lanes.y, 2.0F, lanes.height}, palette::kRed);
    drawing.pen().triangle(
        {x - 5.0F, lanes.y}, {x + 5.0F, lanes.y}, {x, lanes.y + 7.0F}, palette::kRed);
}

// All of the clip: where it is danced, what the lanes show, where it stands.
void draw_overview(GridDrawing& drawing) {
    const Box& lane = drawing.layout.overview;
    const render::Pen& pen = drawing.pen();
    pen.fill(lane, pane_colours::kSunken);
    name_lane(drawing, lane, "whole clip");
    const double seconds = std::max(drawing.session.seconds, 1e-6);
    const auto x_of = [&](double time) {
        return lane.x + lane.width * static_cast<float>(time / seconds);
    };
    for (std::size_t i = 0; i + 1 < drawing.beats.size(); ++i) {
        if (drawing.beats[i].is_used) {
            const float from = x_of(drawing.beats[i].time);
            pen.fill({from, lane.y + 6.0F, x_of(drawing.beats[i + 1].time) - from, 10.0F},
                     palette::kAmber.faded(0.45F));
        }
    }
    const float from = x_of(drawing.view.from);
    pen.outline({from, lane.y, x_of(drawing.view.to) - from, lane.height}, palette::kTeal, 3.0F);
    pen.fill({x_of(drawing.view.now) - 1.0F, lane.y, 2.0F, lane.height}, palette::kRed);
    [[maybe_unused]] const render::PaneItem item = pane_item(lane, "overview", drawing.frame);
    if (ImGui::IsItemActive()) {
        const double time = std::clamp(
            static_cast<double>((drawing.frame.pointer.x - lane.x) / lane.width) * seconds,
            0.0,
            drawing.session.seconds);
        drawing.wishes.emplace_back(SeekTo{time});
    }
}

// The beat that a press at an x is meant for, if any.
std::optional<std::size_t> beat_near(const GridDrawing& drawing, float x) {
    std::optional<std::size_t> nearest;
    float away = kNear;
    for (std::size_t i = 0; i < drawing.beats.size(); ++i) {
        const float distance = std::abs(drawing.x(drawing.beats[i].time) - x);
        if (distance < away) {
            away = distance;
            nearest = i;
        }
    }
    return nearest;
}

void press(GridDrawing& drawing, double moment) {
    const auto beat = beat_near(drawing, drawing.frame.pointer.x);
    if (!beat) {
        drawing.wishes.emplace_back(SeekTo{moment});
        return;
    }
    const double time = drawing.beats[*beat].time;
    drawing.wish(HoldBeat{{*beat, time, false}});
    drawing.wishes.emplace_back(SeekTo{time});
}

void drag(GridDrawing& drawing, double moment) {
    HeldBeat held = *drawing.session.held;
    if (held.beat >= drawing.session.beats.now().size()) {
        return;
    }
    const float home = drawing.x(drawing.session.beats.now()[held.beat].time);
    held.has_moved = held.has_moved || std::abs(drawing.frame.pointer.x - home) > kMoves;
    if (held.has_moved) {
        held.time = moment;
        drawing.wish(HoldBeat{held});
        drawing.wishes.emplace_back(SeekTo{moment});
    }
}

// Beats are chosen and dragged, moments gone to; the wheel shows more or less around the pointer.
void take_pointer(GridDrawing& drawing) {
    const Box& lanes = drawing.layout.lanes;
    const render::PaneItem item = pane_item(lanes, "lanes", drawing.frame);
    const bool is_active = ImGui::IsItemActive();
    const double moment =
        moment_at(lanes, drawing.view, drawing.session.seconds, drawing.frame.pointer.x);
    if (is_active && drawing.frame.has_pressed(render::MouseButton::left)) {
        press(drawing, moment);
    } else if (is_active && drawing.session.held) {
        drag(drawing, moment);
    } else if (is_active) {
        drawing.wishes.emplace_back(SeekTo{moment});
    } else if (drawing.session.held) {
        drawing.wish(LetGoOfBeat{});
    }
    if (item.is_hovered && drawing.frame.wheel != 0.0F) {
        constexpr double kLeast = 2.0;  // seconds
        const double seconds = drawing.session.seconds;
        const double span = std::clamp((drawing.view.to - drawing.view.from) *
                                           std::pow(0.8, static_cast<double>(drawing.frame.wheel)),
                                       std::min(kLeast, seconds),
                                       seconds);
        const double share = (moment - drawing.view.from) / (drawing.view.to - drawing.view.from);
        const double from = std::clamp(moment - share * span, 0.0, seconds - span);
        drawing.wishes.emplace_back(ShowRange{from, from + span});
    }
}

}  // namespace

void draw_lanes(GridDrawing& drawing) {
    const GridLayout& layout = drawing.layout;
    drawing.pen().fill(layout.lanes, pane_colours::kSunken);
    draw_stretch(drawing);
    draw_ruler(drawing);
    draw_motion(drawing);
    draw_repeats(drawing);
    draw_song(drawing);
    draw_beats(drawing);
    draw_now(drawing);
    take_pointer(drawing);
    draw_overview(drawing);
}

}  // namespace raks::apps
