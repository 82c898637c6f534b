// Label pane: what `raks capture label` shows, and what is done in it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/raks_capture/label_session.hpp"
#include "render/panes/picture_view.hpp"

namespace raks::apps {

/// Where the parts of the pane are; units.
struct LabelLayout {
    std::vector<render::Box> cameras;  ///< a button each
    render::Box before;                ///< the picture before
    render::Box number;                ///< of the picture
    render::Box after;                 ///< the picture behind
    render::Box undo;
    render::Box redo;
    render::Box save;
    render::Box picture;
    render::Box title;                 ///< over the list
    std::vector<render::Box> markers;  ///< a row each, as many as there is room for
    render::Box accept;
    render::Box remove;
    render::Box status;  ///< a line
    render::Box keys;    ///< a line
};
/// The layout of an area with so many cameras and markers.
[[nodiscard]] LabelLayout label_layout(const render::Box& area,
                                       std::size_t cameras,
                                       std::size_t markers);

/// What the pane shows beside the session.
struct LabelView {
    render::PictureZoom zoom;
    std::size_t first_row = 0;                     ///< marker in the first row of the list
    const render::PanePicture* picture = nullptr;  ///< null: spots on a dark ground
    int width = 1280;                              ///< of the picture; pixels
    int height = 720;
    bool is_loading = false;               ///< the picture is being read
    std::vector<LabelProposal> proposals;  ///< for the picture that is shown
    std::string message;                   ///< what there is to say; may be empty
};

/// The view moves.
struct SetLabelZoom {
    render::PictureZoom zoom;
};
/// The list moves.
struct SetLabelRow {
    std::size_t first_row = 0;
};
/// The labels are to be written.
struct SaveLabels {};
/// The window is to close.
struct CloseLabels {};

/// What a person asks for in the pane.
using LabelWish = std::variant<LabelAction, SetLabelZoom, SetLabelRow, SaveLabels, CloseLabels>;

/// Draws the pane and tells what is asked for, in order. A click near a spot is meant for the spot.
[[nodiscard]] std::vector<LabelWish> label_pane(const render::PaneFrame& frame,
                                                const LabelSession& session,
                                                const LabelView& view);

/// What a key asks for; nothing: another key.
[[nodiscard]] std::vector<LabelWish> wishes_of_key(const KeyEvent& key,
                                                   const LabelSession& session,
                                                   const LabelView& view);

}  // namespace raks::apps
