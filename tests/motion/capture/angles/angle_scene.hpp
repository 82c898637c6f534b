// A short dance of the paper's body, filmed in the studio, and one frame of it laid out.
#pragma once

#include <vector>

#include "motion/capture/angles/frame_marks.hpp"
#include "motion/capture/angles/posture_polish.hpp"
#include "motion/capture/solving/body_size.hpp"
#include "motion/capture/studio/point_studio.hpp"
#include "tests/motion/capture/filmed_swing.hpp"

namespace raks::test {

/// The markers of the shipped set that the paper's body carries: all but the toes'.
inline capture::MarkerSet paper_markers(capture::MarkerColours colours) {
    capture::MarkerSet set = capture::default_markers(colours);
    std::erase_if(set.markers, [](const capture::Marker& marker) {
        return marker.name.find("toe") != std::string::npos;
    });
    return set;
}

/// What a posture of the mannequin looks like at one moment, without noise.
struct SeenPosture {
    explicit SeenPosture(capture::MarkerColours colours = capture::MarkerColours::five,
                         int cameras = 4)
        : rig(capture::studio_rig(cameras)), markers(paper_markers(colours)) {
        for (const capture::Marker& marker : markers.markers) {
            bones.push_back(marker.bone);
        }
        weights.usual = 0.0;
        std::vector<double> change(model.variables());
        for (std::size_t i = 0; i < change.size(); ++i) {
            change[i] = 0.3 * std::sin(3.0 * static_cast<double>(i) + 1.0);
        }
        state = model.moved(model.usual_state(shape), change.data());
        for (double& angle : state.angles) {
            angle = std::max(0.2, angle);
        }
        const std::vector<std::size_t> classes = markers.classes();
        const auto places = capture::marker_places_of(context(), state);
        for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
            for (std::size_t marker = 0; marker < places.size(); ++marker) {
                if ((marker + camera) % 3 == 0) {
                    continue;  // a third is hidden
                }
                const glm::dvec2 pixel = *capture::project(rig.cameras[camera], places[marker]);
                spots.push_back({camera,
                                 classes[marker],
                                 pixel,
                                 capture::direction_of(rig.cameras[camera].lens, pixel)});
            }
        }
    }

    [[nodiscard]] capture::FrameContext context() const { return {model, bones, shape, weights}; }
    [[nodiscard]] capture::FrameMarks marks() const {
        return {rig, spots, markers.classes(), std::vector<bool>(markers.markers.size()), {}};
    }

    capture::Rig rig;
    capture::MarkerSet markers;
    capture::BodyModel model{capture::BodyKind::paper};
    capture::BodyShape shape = capture::shape_of({}, markers);
    std::vector<motion::Bone> bones;
    capture::FrameWeights weights;
    capture::BodyState state;
    std::vector<capture::SeenSpot> spots;
};

}  // namespace raks::test
