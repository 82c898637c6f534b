#include "apps/grid/grid_pane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "apps/grid/grid_drawing.hpp"
#include "render/panes/picture_view.hpp"

namespace raks::apps {
namespace {

using render::Align;
using render::Box;
using render::ButtonLook;
namespace palette = render::palette;

bool button(const GridDrawing& drawing,
            const Box& box,
            std::string_view label,
            bool is_possible,
            bool is_chosen = false) {
    return pane_button(drawing.frame,
                       box,
                       label,
                       !is_possible ? ButtonLook::off
                       : is_chosen  ? ButtonLook::chosen
                                    : ButtonLook::usual);
}

void draw_play(GridDrawing& drawing) {
    const GridLayout& layout = drawing.layout;
    const GridView& view = drawing.view;
    if (button(drawing, layout.play, view.is_playing ? "Pause" : "Play", true, view.is_playing)) {
        drawing.wishes.emplace_back(PlayOrRest{});
    }
    if (button(drawing, layout.rate, fmt::format("x {:g}", view.rate), true)) {
        drawing.wishes.emplace_back(PlayAt{view.rate > 0.75 ? 0.5 : view.rate > 0.3 ? 0.25 : 1.0});
    }
    if (button(drawing, layout.tap, "Tap", true, !drawing.session.taps.empty())) {
        drawing.wish(TapBeat{view.now});
    }
}

void draw_edits(GridDrawing& drawing) {
    const GridLayout& layout = drawing.layout;
    const GridSession& session = drawing.session;
    const bool has_beats = !drawing.beats.empty();
    const bool is_chosen = session.chosen.has_value();
    const BeatReach use = session.meant_for_use();
    if (button(drawing, layout.insert, "Insert", true)) {
        drawing.wish(InsertBeat{drawing.view.now});
    }
    if (button(drawing, layout.remove, "Remove", is_chosen)) {
        drawing.wish(RemoveBeat{});
    }
    if (button(drawing, layout.one, "It is a 1", is_chosen)) {
        drawing.wish(MarkOne{});
    }
    if (button(drawing, layout.use, "Leave out", use.first < use.last)) {
        drawing.wish(ToggleUse{});
    }
    if (button(drawing, layout.half, "Half", has_beats)) {
        drawing.wish(HalveBeats{});
    }
    if (button(drawing, layout.twice, "Double", has_beats)) {
        drawing.wish(DoubleBeats{});
    }
    if (button(drawing, layout.even, "Even", has_beats)) {
        drawing.wish(EvenBeats{});
    }
    if (drawing.view.song != nullptr && button(drawing, layout.take_song, "Song's beats", true)) {
        drawing.wishes.emplace_back(TakeSong{});
    }
}

void draw_history(GridDrawing& drawing) {
    const GridLayout& layout = drawing.layout;
    const GridSession& session = drawing.session;
    if (button(drawing, layout.undo, "Undo", session.beats.can_undo())) {
        drawing.wish(UndoGrid{});
    }
    if (button(drawing, layout.redo, "Redo", session.beats.can_redo())) {
        drawing.wish(RedoGrid{});
    }
    const bool is_saved = session.is_saved();
    if (button(drawing, layout.save, is_saved ? "Saved" : "Save", !is_saved)) {
        drawing.wishes.emplace_back(SaveGrid{});
    }
}

// The picture of a body, if there is one. True: it was clicked.
bool draw_still(const GridDrawing& drawing, std::size_t place) {
    const Box& box = drawing.layout.stills[place];
    const auto& pictures = drawing.view.stills;
    const auto gesture =
        picture_view(drawing.frame,
                     fmt::format("still {}", place),
                     render::PicturePlace(box,
                                          std::max(static_cast<int>(box.width), 1),
                                          std::max(static_cast<int>(box.height), 1),
                                          {}),
                     place < pictures.size() ? pictures[place] : nullptr);
    return gesture.kind == render::PictureGesture::Kind::press;
}

// Below each body its beat's number and time; a press goes there.
void draw_stills(GridDrawing& drawing) {
    const auto stills = grid_stills(drawing.beats, drawing.view.now);
    for (std::size_t place = 0; place < stills.size(); ++place) {
        if (!stills[place]) {
            continue;
        }
        const GridStill& still = *stills[place];
        const motion::GridBeat& beat = drawing.beats[still.beat];
        const Box& box = drawing.layout.stills[place];
        const bool is_pressed = draw_still(drawing, place);
        const render::Colour colour = !beat.is_used                      ? palette::kDim.faded(0.6F)
                                      : beat.half == 1 && !still.is_half ? palette::kAmber
                                      : still.is_half                    ? palette::kDim
                                                                         : palette::kText;
        drawing.pen().text(drawing.pen().fonts().small,
                           box.x + box.width / 2.0F,
                           box.bottom() + 2.0F,
                           colour,
                           still.is_half ? fmt::format("&   {:.2f}", still.time)
                                         : fmt::format("{}   {:.2f}", still.beat + 1, still.time),
                           Align::middle,
                           box.width);
        if (!beat.is_used) {
            drawing.pen().fill(box, render::pane_colours::kGround.faded(0.65F));
        }
        if (drawing.session.chosen == still.beat && !still.is_half) {
            drawing.pen().outline(box, palette::kTeal, 2.0F);
        }
        if (is_pressed) {
            drawing.wish(ChooseBeat{still.is_half ? std::nullopt : std::optional(still.beat)});
            drawing.wishes.emplace_back(SeekTo{still.time});
        }
    }
}

// How fast the beats around a moment come.
std::string tempo_at(const GridBeats& beats, double now) {
    for (std::size_t i = 0; i + 1 < beats.size(); ++i) {
        const double length = beats[i + 1].time - beats[i].time;
        if (beats[i].time <= now && now < beats[i + 1].time) {
            return length <= kLongestBeat ? fmt::format("{:.0f} BPM", 60.0 / length)
                                          : std::string("no beats");
        }
    }
    return "no beats";
}

std::string status_of(const GridDrawing& drawing) {
    const GridSession& session = drawing.session;
    std::string text = fmt::format("{:.2f} of {:.2f} s, {}.",
                                   drawing.view.now,
                                   session.seconds,
                                   tempo_at(drawing.beats, drawing.view.now));
    if (!session.taps.empty()) {
        text +=
            fmt::format("  {} tapped; they become beats at the next pause.", session.taps.size());
    }
    if (session.chosen && *session.chosen < drawing.beats.size()) {
        const motion::GridBeat& beat = drawing.beats[*session.chosen];
        text += fmt::format("  Beat {} at {:.3f} s, half {}{}.",
                            *session.chosen + 1,
                            beat.time,
                            beat.half,
                            beat.is_used ? "" : ", left out");
    }
    const BeatReach meant = session.meant();
    text += session.stretch ? fmt::format("  Stretch {:.2f} to {:.2f} s: {} beats.",
                                          session.stretch->from,
                                          session.stretch->to,
                                          meant.last - meant.first)
                            : fmt::format("  {} beats.", drawing.beats.size());
    if (drawing.view.song != nullptr) {
        text += fmt::format("  The clip begins at {:.2f} s of {}.",
                            drawing.view.offset,
                            drawing.view.song->music.name);
    }
    return text;
}

void draw_lines(const GridDrawing& drawing) {
    const render::Pen& pen = drawing.pen();
    const GridLayout& layout = drawing.layout;
    const bool has_message = !drawing.view.message.empty();
    pen.text(pen.fonts().body,
             layout.status.x,
             layout.status.y,
             has_message ? palette::kAmber : palette::kText,
             has_message ? drawing.view.message : status_of(drawing),
             Align::left,
             layout.status.width);
    pen.text(
        pen.fonts().small,
        layout.keys.x,
        layout.keys.y + 2.0F,
        palette::kDim,
        "Space play   R rate   Left, Right a frame, with Shift ten   Up, Down beat   T tap along "
        "  I insert   X remove   Ctrl+Left, Right or a drag: move it   1 it is a 1",
        Align::left,
        layout.keys.width);
    pen.text(
        pen.fonts().small,
        layout.keys.x,
        layout.keys.y + 18.0F,
        palette::kDim,
        std::string("[ ] stretch   Esc none   of it, or of all:  , . shift   H half   D double "
                    "  E even   L leave out, use   U, Y undo, redo   wheel, F zoom   S save   "
                    "Q close") +
            (drawing.view.song != nullptr ? "   - = song   M its beats" : ""),
        Align::left,
        layout.keys.width);
}

}  // namespace

std::vector<GridWish> grid_pane(const render::PaneFrame& frame,
                                const GridSession& session,
                                const GridView& view) {
    GridDrawing drawing{
        frame, session, view, session.shown(), grid_layout(frame.area, view.song != nullptr)};
    for (const KeyEvent& key : frame.keys) {
        for (GridWish& wish : wishes_of_key(key, session, view)) {
            drawing.wishes.push_back(std::move(wish));
        }
    }
    draw_play(drawing);
    draw_edits(drawing);
    draw_history(drawing);
    draw_stills(drawing);
    draw_lanes(drawing);
    draw_lines(drawing);
    return std::move(drawing.wishes);
}

}  // namespace raks::apps
