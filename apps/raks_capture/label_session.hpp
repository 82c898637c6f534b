// Label session: what a person does while labelling, as a value.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/history.hpp"
#include "motion/capture/markers/labels.hpp"
#include "motion/capture/markers/marker_set.hpp"

#include <glm/vec2.hpp>

namespace raks::apps {

/// A spot in the picture that may be a marker.
struct LabelProposal {
    glm::dvec2 pixel{};
    std::size_t colour = 0;             ///< index in MarkerSet::colours()
    std::optional<std::size_t> marker;  ///< which one, where that can be told
};

/// A label that is being moved.
struct MovedLabel {
    std::size_t marker = 0;
    glm::dvec2 pixel{};      ///< where it is now
    bool has_moved = false;  ///< far enough to be meant
};

/// Labels that a person is making, and where they are with it.
struct LabelSession {
    std::vector<std::string> cameras;
    capture::MarkerSet markers;
    History<std::vector<capture::MarkerLabel>> labels;
    std::size_t camera = 0;             ///< that is looked at
    std::vector<std::size_t> pictures;  ///< by camera: which of its pictures
    std::optional<glm::dvec2> picked;   ///< was clicked and has no name yet
    std::optional<std::size_t> chosen;  ///< marker that the next click is for
    std::optional<MovedLabel> moved;    ///< while the button is held

    /// The picture that is looked at.
    [[nodiscard]] std::size_t picture() const { return pictures[camera]; }
    /// The label of a marker in the picture that is looked at. None: it has none.
    [[nodiscard]] const capture::MarkerLabel* label_of(std::size_t marker) const;
    /// In how many cameras a marker is labelled.
    [[nodiscard]] std::size_t cameras_of(std::size_t marker) const;
    /// How many markers are labelled in a picture of this camera.
    [[nodiscard]] std::size_t labelled_in(std::size_t of_camera) const;
};

/// A session that begins with these labels. A camera is looked at in its first picture that is
/// labelled; without any, in the one of `first_pictures`, by camera (empty: the first of its film).
[[nodiscard]] LabelSession label_session(std::vector<std::string> cameras,
                                         capture::MarkerSet markers,
                                         std::vector<capture::MarkerLabel> labels,
                                         std::vector<std::size_t> first_pictures = {});

/// Another camera is looked at.
struct ShowCamera {
    std::size_t camera = 0;
};
/// Another picture of it.
struct ShowPicture {
    std::size_t picture = 0;
};
/// A place was clicked: it becomes the label of the marker that was chosen, after which the next
/// one without a label is; else it waits for a name.
struct PickPixel {
    glm::dvec2 pixel{};
};
/// A name was chosen: the place that waits for one gets it; else the next click does. The same
/// again chooses none. Two labels of a picture whose names meet exchange them.
struct ChooseName {
    std::size_t marker = 0;
};
/// A label is moved; LetGoOfLabel ends it, as one step.
struct MoveLabel {
    MovedLabel label;
};
/// The label that was moved stays where it is; one that was not moved is picked.
struct LetGoOfLabel {};
/// A marker loses its label in this picture.
struct RemoveLabel {
    std::size_t marker = 0;
};
/// Proposals become labels, those that have a marker; in one step.
struct AcceptProposals {
    std::vector<LabelProposal> proposals;
};
/// Nothing is chosen, picked or held any more.
struct ForgetChoice {};
/// The last step is taken back.
struct UndoLabels {};
/// Or done again.
struct RedoLabels {};

using LabelAction = std::variant<ShowCamera,
                                 ShowPicture,
                                 PickPixel,
                                 ChooseName,
                                 MoveLabel,
                                 LetGoOfLabel,
                                 RemoveLabel,
                                 AcceptProposals,
                                 ForgetChoice,
                                 UndoLabels,
                                 RedoLabels>;

/// Does what was asked for. Indices are of the session's cameras and markers. Labels stay sorted by
/// camera, picture and marker, so that the same labels make the same file in whatever order they
/// were made; places are kept to a hundredth of a pixel.
void apply(const LabelAction& action, LabelSession& session);

}  // namespace raks::apps
