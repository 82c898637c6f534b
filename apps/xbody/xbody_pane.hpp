// Xbody pane: what `raks xbody` shows around the model, and what is done in it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/xbody/node_kinds.hpp"
#include "apps/xbody/xbody_marks.hpp"
#include "apps/xbody/xbody_session.hpp"
#include "render/panes/pane_context.hpp"
#include "render/panes/pane_picture.hpp"

namespace raks::apps {

/// Where the parts of the pane are; units.
struct XbodyLayout {
    render::Box search;
    std::vector<render::Box> rows;   ///< of the tree, as many as there is room for
    render::Box hide;                ///< under the tree
    std::vector<render::Box> views;  ///< front, side, back, top, fit
    /// Bones, names, springs; own colours, normals, weights; wireframe.
    std::vector<render::Box> looks;
    render::Box view;                ///< the model
    std::vector<render::Box> pages;  ///< by XbodyPage
    std::vector<render::Box> films;  ///< on the page of films: .png, .mp4, .avi, folder, stop
    render::Box axis;                ///< under the lines
    std::vector<render::Box> lines;  ///< of the right pane
    render::Box label;
    render::Box unlabel;
    render::Box undo;
    render::Box redo;
    render::Box save;
    std::vector<render::Box> steps;  ///< first, back, play, on, last
    render::Box number;              ///< of the frame
    render::Box slower;
    render::Box rate;
    render::Box faster;
    render::Box timeline;
    render::Box status;  ///< a line
    render::Box keys;    ///< a line
};
/// The layout of an area of 900 x 500 units or more.
[[nodiscard]] XbodyLayout xbody_layout(const render::Box& area);

/// A line of the right pane.
struct XbodyLine {
    std::string text;
    bool is_title = false;
    bool is_warning = false;
};

/// What the pane shows beside the session.
struct XbodyView {
    std::vector<NodeKind> kinds;                     ///< by node
    SeenMarks seen;                                  ///< in the view
    std::vector<XbodyLine> meshes;                   ///< page of the meshes
    std::vector<XbodyLine> file;                     ///< page of the file
    const render::PanePicture* thumbnail = nullptr;  ///< above them; null: it has none
    float thumbnail_aspect = 1.0F;                   ///< width / height
    std::vector<XbodyLine> film;                     ///< page of films, under its buttons
    std::vector<std::string> expressions;            ///< names, by PoseTuning::expressions
    bool can_pose = false;                           ///< it is a figure that stands
    bool can_gaze = false;
    std::optional<double> film_share;  ///< of a film that is being written
};

/// The camera goes where it has all of the model: "front", "side", "back", "top".
struct FitView {
    std::string view;
};
/// The camera has the chosen branch, or where none is chosen all of the model.
struct FrameChosen {};
/// What is seen at a place of the frame, in the view, is picked.
struct PickSurface {
    glm::vec2 at{};
};
/// The labels are to be written.
struct SaveXbody {};
/// What is shown is to be written: ".png", ".mp4", ".avi", or "" for a folder of pictures.
struct WriteFilm {
    std::string ending;
};
/// What is being written ends with what there is.
struct StopFilm {};
/// Files were dropped together: models, motions, music.
struct TakeFiles {
    std::vector<std::string> paths;
};
/// The window is to close.
struct CloseXbody {};

/// What a person asks for in the pane.
using XbodyWish = std::variant<XbodyAction,
                               FitView,
                               FrameChosen,
                               PickSurface,
                               SaveXbody,
                               WriteFilm,
                               StopFilm,
                               TakeFiles,
                               CloseXbody>;

/// Bones in the order of the page: those that a figure needs, then the others.
[[nodiscard]] std::vector<motion::Bone> listed_bones(const render::HumanoidMap& humanoid);

/// Draws the pane, but for the model itself, and tells what is asked for, in order.
[[nodiscard]] std::vector<XbodyWish> xbody_pane(const render::PaneFrame& frame,
                                                const XbodySession& session,
                                                const XbodyView& view);

/// What a key asks for; what means nothing here is one of the transport.
[[nodiscard]] std::vector<XbodyWish> wishes_of_key(const KeyEvent& key,
                                                   const XbodySession& session);

}  // namespace raks::apps
