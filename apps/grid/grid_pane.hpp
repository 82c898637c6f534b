// Grid pane: what the window shows in which the beats of a take are set right, and what is done in
// it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/grid/grid_session.hpp"
#include "apps/grid/take_music.hpp"
#include "render/panes/pane_context.hpp"
#include "render/panes/pane_picture.hpp"
#include "training/cells/grid_cues.hpp"
#include "training/cells/grid_proposal.hpp"

namespace raks::apps {

/// Bodies beside the large one: those of eight beats in a row, and of half beats below them.
inline constexpr std::size_t kGridStills = 8;

/// Where the parts of the pane are; units.
struct GridLayout {
    render::Box play;
    render::Box rate;
    render::Box tap;
    render::Box insert;
    render::Box remove;
    render::Box one;
    render::Box use;
    render::Box half;
    render::Box twice;
    render::Box even;
    render::Box take_song;  ///< without width: there is no song
    render::Box undo;
    render::Box redo;
    render::Box save;
    render::Box figure;               ///< the body at the moment that is looked at
    std::vector<render::Box> stills;  ///< of beats around it, then of half beats; with a line below
    render::Box lanes;                ///< all lanes of the time line, where moments are
    render::Box names;                ///< left of them
    render::Box ruler;                ///< seconds
    render::Box beats;                ///< the grid
    render::Box landings;             ///< left above right
    render::Box feet;                 ///< their speed
    render::Box hips;                 ///< their height
    render::Box repeats;
    render::Box song;      ///< without height: there is none
    render::Box overview;  ///< all of the clip
    render::Box status;    ///< a line
    render::Box keys;      ///< two lines
};
/// The layout of an area.
[[nodiscard]] GridLayout grid_layout(const render::Box& area, bool has_song);

/// What the pane shows beside the session.
struct GridView {
    const motion::GridCues* cues = nullptr;                  ///< never null
    const std::vector<motion::FoundLag>* repeats = nullptr;  ///< never null
    const TakeMusic* song = nullptr;                         ///< null: none
    double offset = 0.0;  ///< seconds of the song at the clip's first frame
    double now = 0.0;     ///< moment that is looked at, seconds
    bool is_playing = false;
    double rate = 1.0;
    double from = 0.0;          ///< what the lanes show: from here
    double to = 10.0;           ///< to here
    double frame = 1.0 / 60.0;  ///< seconds of a frame of the clip
    std::string message;        ///< what there is to say; may be empty
    /// By the layout's stills: their pictures; null or fewer: there is none.
    std::vector<const render::PanePicture*> stills{};
};

/// A body beside the large one.
struct GridStill {
    std::size_t beat = 0;  ///< that it shows or follows
    bool is_half = false;  ///< half way to the next
    double time = 0.0;     ///< seconds of the clip
};

/// Another moment is looked at.
struct SeekTo {
    double time = 0.0;
};
/// Playing begins or ends.
struct PlayOrRest {};
/// It plays at this rate.
struct PlayAt {
    double rate = 1.0;
};
/// The lanes show another part of the clip.
struct ShowRange {
    double from = 0.0;
    double to = 0.0;
};
/// The song lies this much later over the clip.
struct MoveSong {
    double by = 0.0;
};
/// The song's beats become the grid.
struct TakeSong {};
/// The beats are to be written.
struct SaveGrid {};
/// The window is to close.
struct CloseGrid {};

/// What a person asks for in the pane.
using GridWish = std::variant<GridAction,
                              SeekTo,
                              PlayOrRest,
                              PlayAt,
                              ShowRange,
                              MoveSong,
                              TakeSong,
                              SaveGrid,
                              CloseGrid>;

/// Draws the pane, but for the bodies, and tells what is asked for, in order. A press on a beat
/// chooses it and drags it, one elsewhere in the lanes goes there.
[[nodiscard]] std::vector<GridWish> grid_pane(const render::PaneFrame& frame,
                                              const GridSession& session,
                                              const GridView& view);

/// What a key asks for; nothing: another key.
[[nodiscard]] std::vector<GridWish> wishes_of_key(const KeyEvent& key,
                                                  const GridSession& session,
                                                  const GridView& view);

/// The bodies beside the large one, by the layout's stills: of the row of eight beats in which a
/// moment is, and half way to the beats behind them. Rows begin as those of strips do. None: there
/// is no such beat.
[[nodiscard]] std::vector<std::optional<GridStill>> grid_stills(const GridBeats& beats, double now);

/// x of a moment in the lanes; units.
[[nodiscard]] float place_of(const render::Box& lanes, const GridView& view, double time) noexcept;
/// The moment at an x; inside of the clip.
[[nodiscard]] double moment_at(const render::Box& lanes,
                               const GridView& view,
                               double seconds,
                               float x) noexcept;

}  // namespace raks::apps
