// Keys of the grid pane.
#include <algorithm>
#include <cmath>

#include "apps/grid/grid_pane.hpp"

namespace raks::apps {
namespace {

using Wishes = std::vector<GridWish>;

constexpr double kFarSteps = 10.0;  // frames, with Shift

Wishes step(const KeyEvent& key, const GridSession& session, const GridView& view) {
    const double sign = key.key == Key::right ? 1.0 : -1.0;
    const double by = sign * view.frame * (key.has_shift ? kFarSteps : 1.0);
    if (key.has_control) {
        return {GridAction(NudgeBeat{by})};
    }
    return {SeekTo{std::clamp(view.now + by, 0.0, session.seconds)}};
}

// The beat after the one that is chosen, or before it, and the moment of that; without one, that
// after or before the moment that is looked at.
Wishes beat_step(bool is_next, const GridSession& session, const GridView& view) {
    const GridBeats beats = session.shown();
    if (beats.empty()) {
        return {};
    }
    const double edge = is_next ? 0.001 : -0.001;
    const double from =
        session.chosen && *session.chosen < beats.size() ? beats[*session.chosen].time : view.now;
    std::size_t found = is_next ? beats.size() - 1 : 0;
    if (is_next) {
        const auto after = std::find_if(
            beats.begin(), beats.end(), [&](const auto& beat) { return beat.time > from + edge; });
        found = after != beats.end() ? static_cast<std::size_t>(after - beats.begin()) : found;
    } else {
        for (std::size_t i = 0; i < beats.size() && beats[i].time < from + edge; ++i) {
            found = i;
        }
    }
    return {GridAction(ChooseBeat{found}), SeekTo{beats[found].time}};
}

// A place that the lanes keep when they show more or less.
Wishes zoomed(double factor, const GridSession& session, const GridView& view) {
    constexpr double kNearest = 2.0;  // seconds
    const double span = std::clamp(
        (view.to - view.from) * factor, std::min(kNearest, session.seconds), session.seconds);
    const double from = std::clamp(view.now - 0.5 * span, 0.0, session.seconds - span);
    return {ShowRange{from, from + span}};
}

Wishes song_key(double by, const GridView& view) {
    return view.song != nullptr ? Wishes{MoveSong{by}} : Wishes{};
}

Wishes edit_key(char32_t letter, const KeyEvent& key, const GridView& view) {
    const double shift = view.frame * (key.has_shift ? kFarSteps : 1.0);
    switch (letter) {
        case U't':
            return {GridAction(TapBeat{view.now})};
        case U'i':
            return {GridAction(InsertBeat{view.now})};
        case U'x':
            return {GridAction(RemoveBeat{})};
        case U'1':
            return {GridAction(MarkOne{})};
        case U'l':
            return {GridAction(ToggleUse{})};
        case U'h':
            return {GridAction(HalveBeats{})};
        case U'd':
            return {GridAction(DoubleBeats{})};
        case U'e':
            return {GridAction(EvenBeats{})};
        case U'[':
            return {GridAction(MarkStretch{view.now, true})};
        case U']':
            return {GridAction(MarkStretch{view.now, false})};
        case U',':
        case U'<':
            return {GridAction(ShiftBeats{-shift})};
        case U'.':
        case U'>':
            return {GridAction(ShiftBeats{shift})};
        case U'u':
            return {GridAction(UndoGrid{})};
        case U'y':
            return {GridAction(RedoGrid{})};
        case U'z':
            return {key.has_shift ? GridAction(RedoGrid{}) : GridAction(UndoGrid{})};
        default:
            return {};
    }
}

Wishes other_key(char32_t letter,
                 const KeyEvent& key,
                 const GridSession& session,
                 const GridView& view) {
    constexpr double kSongStep = 0.01;  // seconds
    const double by = kSongStep * (key.has_shift ? 10.0 : 1.0);
    switch (letter) {
        case U'q':
            return {CloseGrid{}};
        case U's':
            return {SaveGrid{}};
        case U'r':
            return {PlayAt{view.rate > 0.75 ? 0.5 : view.rate > 0.3 ? 0.25 : 1.0}};
        case U'-':
        case U'_':
            return song_key(-by, view);
        case U'=':
        case U'+':
            return song_key(by, view);
        case U'm':
            return view.song != nullptr ? Wishes{TakeSong{}} : Wishes{};
        case U'f':
            return {view.to - view.from < session.seconds - 0.01
                        ? GridWish(ShowRange{0.0, session.seconds})
                        : zoomed(10.0 / std::max(session.seconds, 1.0), session, view).front()};
        default:
            return edit_key(letter, key, view);
    }
}

}  // namespace

std::vector<GridWish> wishes_of_key(const KeyEvent& key,
                                    const GridSession& session,
                                    const GridView& view) {
    switch (key.key) {
        case Key::space:
            return {PlayOrRest{}};
        case Key::left:
        case Key::right:
            return step(key, session, view);
        case Key::up:
        case Key::down:
            return beat_step(key.key == Key::down, session, view);
        case Key::home:
            return {SeekTo{0.0}};
        case Key::end:
            return {SeekTo{session.seconds}};
        case Key::page_up:
            return zoomed(0.7, session, view);
        case Key::page_down:
            return zoomed(1.0 / 0.7, session, view);
        case Key::backspace:
            return {GridAction(RemoveBeat{})};
        case Key::escape:
            return {GridAction(ForgetChosen{})};
        default:
            return other_key(static_cast<char32_t>(key.key), key, session, view);
    }
}

}  // namespace raks::apps
