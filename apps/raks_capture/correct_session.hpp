// Correct session: what a person does while correcting tracks, as a value.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/history.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/edits.hpp"
#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/tracks.hpp"

#include <glm/vec2.hpp>

namespace raks::apps {

/// A marker that is being dragged in a view.
struct HeldMarker {
    std::size_t camera = 0;
    glm::dvec2 from{};       ///< where the button went down
    glm::dvec2 pixel{};      ///< where it is now
    bool has_moved = false;  ///< far enough to be meant
};

/// A stretch of frames, both included.
struct FrameStretch {
    std::size_t first = 0;
    std::size_t last = 0;

    friend bool operator==(const FrameStretch&, const FrameStretch&) = default;
};

/// Edits that a person is making, and where they are with it.
struct CorrectSession {
    std::vector<std::string> cameras;  ///< of the views
    capture::Tracks tracks;            ///< by the edits when they were tracked last
    History<std::vector<capture::Edit>> edits;
    std::size_t frame = 0;                ///< that is looked at
    std::size_t marker = 0;               ///< that is looked at
    std::size_t camera = 0;               ///< whose view edits of views are about
    bool is_of_joints = false;            ///< a take without markers: markers are joints
    std::optional<std::size_t> alone;     ///< camera whose view fills all; none: all views
    std::optional<FrameStretch> stretch;  ///< frames that were chosen
    bool is_swapping = false;             ///< the next marker that is chosen is the other one
    bool is_playing = false;
    std::optional<HeldMarker> held;

    /// The frames that hide and fill are about: those that were chosen, else the flagged stretch of
    /// the marker at this frame, else the frame alone.
    [[nodiscard]] FrameStretch meant() const;
    /// The same of edits of the camera's view: else a flagged stretch of the marker, or of the
    /// camera, at this frame, other than a lost one; else the frame alone.
    [[nodiscard]] FrameStretch meant_in_view() const;
};

/// Another frame is looked at; the last one where there is none so late.
struct ShowFrame {
    std::size_t frame = 0;
};
/// Another marker is; while swapping it is the other one of the swap.
struct ChooseMarker {
    std::size_t marker = 0;
};
/// The view of this camera is the one that edits of views are about.
struct ChooseView {
    std::size_t camera = 0;
};
/// One view alone, or all.
struct ShowView {
    std::optional<std::size_t> camera;
};
/// Playing begins or ends.
struct TogglePlay {};
/// The next stretch that a flag names, of any marker, by its first frame, or the one before it.
struct ShowFlag {
    bool is_next = true;
};
/// The worst frame of the marker; once more the next worst, half a second or more from those
/// before.
struct ShowWorst {};
/// This frame begins the stretch, or ends it.
struct SetStretch {
    bool is_first = true;
};
/// The marker is dragged in a view; LetGoOfMarker ends it as a `set`.
struct HoldMarker {
    HeldMarker held;
};
/// See HoldMarker.
struct LetGoOfMarker {};
/// The marker's spots are not believed in meant(); of joints what the camera sees of it, in
/// meant_in_view().
struct HideMarker {};
/// Nothing that the camera sees counts in meant_in_view().
struct HideView {};
/// Left and right are exchanged in what the camera sees, in meant_in_view().
struct ExchangeSides {
    bool is_of_limb = false;  ///< of the arms or legs alone, to which the marker belongs
};
/// Its places in meant() are made from those around.
struct FillMarker {};
/// The next marker that is chosen and this one are each other from here on.
struct BeginSwap {};
/// Nothing is chosen or held any more.
struct ForgetStretch {};
/// The last edit is taken back.
struct UndoEdit {};
/// Or done again.
struct RedoEdit {};

using CorrectAction = std::variant<ShowFrame,
                                   ChooseMarker,
                                   ChooseView,
                                   ShowView,
                                   TogglePlay,
                                   ShowFlag,
                                   ShowWorst,
                                   SetStretch,
                                   HoldMarker,
                                   LetGoOfMarker,
                                   HideMarker,
                                   HideView,
                                   ExchangeSides,
                                   FillMarker,
                                   BeginSwap,
                                   ForgetStretch,
                                   UndoEdit,
                                   RedoEdit>;

/// Does what was asked for. Edits are kept in the order in which they were made, since they are
/// applied so; a `set` of what the last edit set replaces it. Pixels are kept to a hundredth.
void apply(const CorrectAction& action, CorrectSession& session);

/// Frames of a marker, the worst first: lost ones, then by deviation; each at least `apart` frames
/// from those before; at most `count`.
[[nodiscard]] std::vector<std::size_t> worst_frames(const capture::Tracks& tracks,
                                                    std::size_t marker,
                                                    std::size_t apart,
                                                    std::size_t count);

/// Checks edits before they are shown. Errors, one line that names the edit: a marker or camera
/// that there is not (with the nearest name), a pixel outside of the picture.
[[nodiscard]] Expected<void> check_edits(const std::vector<capture::Edit>& edits,
                                         const capture::MarkerSet& markers,
                                         const capture::Rig& rig);

}  // namespace raks::apps
