// Label proposals: which spots of a picture are which markers, as far as that can be told.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "apps/raks_capture/label_session.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/observations.hpp"

namespace raks::apps {

/// A label in another camera, of the same moment.
struct OtherLabel {
    std::size_t camera = 0;  ///< index in the rig
    std::size_t marker = 0;
    glm::dvec2 pixel{};
};

/// What proposals follow from.
struct ProposalInput {
    const capture::MarkerSet& markers;
    std::span<const capture::Detection> spots;  ///< colours as of markers.colours()
    /// By marker: where it is labelled in this picture already; none: it is not.
    std::vector<std::optional<glm::dvec2>> labelled;
    const capture::Rig* rig = nullptr;  ///< null: cameras are not calibrated
    std::size_t camera = 0;             ///< index in the rig of this picture's camera
    std::span<const OtherLabel> others;
};

/// The spots that no label of this picture is on, in their order. A spot gets the marker
/// - of its colour that two other cameras place within 12 pixels of it, or
/// - of its colour on whose epipolar line, of one other camera, it lies within 4 pixels, or
/// - that is the only one of its colour without a label, where it is the only such spot;
/// each only where no other marker or spot would do. Pure.
[[nodiscard]] std::vector<LabelProposal> propose_labels(const ProposalInput& input);

}  // namespace raks::apps
