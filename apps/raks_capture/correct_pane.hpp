// Correct pane: what `raks capture correct` shows, and what is done in it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/raks_capture/correct_session.hpp"
#include "apps/raks_capture/skeleton_view.hpp"
#include "motion/capture/markers/observations.hpp"
#include "render/panes/picture_view.hpp"

namespace raks::apps {

/// Where the parts of the pane are; units.
struct CorrectLayout {
    render::Box play;
    render::Box flag_before;
    render::Box flag_after;
    render::Box worst;
    render::Box hide;
    render::Box fill;           ///< of markers alone
    render::Box swap;           ///< likewise
    render::Box exchange;       ///< of joints alone
    render::Box exchange_limb;  ///< likewise
    render::Box hide_view;      ///< likewise
    render::Box track;
    render::Box undo;
    render::Box redo;
    render::Box save;
    std::vector<render::Box> views;    ///< a picture for each camera; empty boxes are not shown
    render::Box title;                 ///< over the list
    render::Box legend;                ///< below that, of joints alone
    std::vector<render::Box> markers;  ///< a row each, as many as there is room for
    render::Box timeline;
    render::Box status;  ///< a line
    render::Box keys;    ///< a line
};
/// What a take is of.
enum class CorrectKind : std::uint8_t { markers, joints };

/// The layout of an area with so many markers, and views of these shapes (width over height).
[[nodiscard]] CorrectLayout correct_layout(const render::Box& area,
                                           const std::vector<double>& shapes,
                                           std::size_t markers,
                                           std::optional<std::size_t> alone,
                                           CorrectKind kind = CorrectKind::markers);

/// One camera's view at the frame that is looked at.
struct CorrectView {
    int width = 1280;  ///< of the picture; pixels
    int height = 720;
    render::PictureZoom zoom;
    const render::PanePicture* picture = nullptr;  ///< null: a dark ground
    std::vector<capture::Detection> spots;         ///< colours as of MarkerSet::colours()
    /// By marker: where its place is seen from here; none: lost, or behind the camera.
    std::vector<std::optional<glm::dvec2>> places;
    /// Of joints: what the network saw here, after the edits. `places` are then these, too.
    std::optional<ViewSkeleton> skeleton{};
    /// Likewise: where all views together have the joints, by BodyPoint.
    std::array<std::optional<glm::dvec2>, capture::kBodyPoints> placed{};
    std::string note;  ///< why there is no picture; may be empty
};

/// What the pane shows beside the session.
struct CorrectScene {
    const capture::MarkerSet& markers;
    std::vector<CorrectView> views;  ///< by camera
    std::vector<double> errors;      ///< of the marker by frame, mm; NaN: lost
    std::size_t first_row = 0;       ///< marker in the first row of the list
    bool is_tracking = false;        ///< the edits are being applied
    bool is_tracked = true;          ///< the tracks are by the edits as they are
    std::string message;             ///< what there is to say; may be empty
};

/// A view moves.
struct SetViewZoom {
    std::size_t camera = 0;
    render::PictureZoom zoom;
};
/// The list moves.
struct SetMarkerRow {
    std::size_t first_row = 0;
};
/// The edits are to be applied.
struct TrackAgain {};
/// The edits are to be written.
struct SaveEdits {};
/// The window is to close.
struct CloseEdits {};

/// What a person asks for in the pane.
using CorrectWish =
    std::variant<CorrectAction, SetViewZoom, SetMarkerRow, TrackAgain, SaveEdits, CloseEdits>;

/// Draws the pane and tells what is asked for, in order. A press near the marker that is looked at
/// drags it, one near another marker chooses that.
[[nodiscard]] std::vector<CorrectWish> correct_pane(const render::PaneFrame& frame,
                                                    const CorrectSession& session,
                                                    const CorrectScene& scene);

/// What a key asks for; nothing: another key.
[[nodiscard]] std::vector<CorrectWish> wishes_of_key(const KeyEvent& key,
                                                     const CorrectSession& session,
                                                     const CorrectScene& scene);

/// The layout that correct_pane uses.
[[nodiscard]] CorrectLayout layout_of(const render::Box& area,
                                      const CorrectSession& session,
                                      const CorrectScene& scene);

}  // namespace raks::apps
