#include "motion/capture/angles/frame_marks.hpp"

#include <algorithm>
#include <optional>

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

MarkPicture picture_of(const Camera& camera, std::size_t index, double late) {
    return {index,
            late,
            0.5 * (camera.lens.fx + camera.lens.fy) / kFocalLength,
            camera.rotation,
            camera.translation};
}

}  // namespace

FrameMarks::FrameMarks(const Rig& rig,
                       const std::vector<SeenSpot>& spots,
                       const std::vector<std::size_t>& classes,
                       const std::vector<bool>& is_hidden,
                       const std::vector<SaidView>& said)
    : markers_(classes.size()) {
    std::vector<std::size_t> picture_of_spot;
    for (const SeenSpot& spot : spots) {
        const auto known =
            std::find_if(pictures_.begin(), pictures_.end(), [&spot](const MarkPicture& picture) {
                return picture.camera == spot.camera && picture.late == spot.late;
            });
        picture_of_spot.push_back(static_cast<std::size_t>(known - pictures_.begin()));
        if (known == pictures_.end()) {
            pictures_.push_back(picture_of(rig.cameras[spot.camera], spot.camera, spot.late));
        }
    }
    for (std::size_t marker = 0; marker < markers_; ++marker) {
        for (std::size_t picture = 0; picture < pictures_.size(); ++picture) {
            const std::size_t first = marks_.size();
            const auto word = std::find_if(said.begin(), said.end(), [&](const SaidView& view) {
                return view.marker == marker && view.camera == pictures_[picture].camera;
            });
            std::optional<std::size_t> meant;
            constexpr double kSaidRadius = 6.0;  // pixels: a spot this near is what is meant
            double nearest = kSaidRadius;
            for (std::size_t i = 0; i < spots.size() && !is_hidden[marker]; ++i) {
                if (picture_of_spot[i] != picture || spots[i].colour != classes[marker]) {
                    continue;
                }
                if (word == said.end()) {
                    marks_.push_back({kFocalLength * spots[i].direction, i});
                } else if (const double apart = glm::distance(spots[i].pixel, word->pixel);
                           apart < nearest) {
                    nearest = apart;
                    meant = i;
                }
            }
            if (meant) {
                marks_.push_back({kFocalLength * spots[*meant].direction, *meant});
            }
            ranges_.push_back({first, marks_.size() - first});
        }
    }
    for (const Mark& mark : marks_) {
        unmoved_.push_back(mark.place);
    }
}

void FrameMarks::set_motion(const std::vector<glm::dvec3>& places,
                            const std::vector<glm::dvec3>& velocities) {
    for (std::size_t marker = 0; marker < markers_; ++marker) {
        for (std::size_t i = 0; i < pictures_.size(); ++i) {
            const MarkPicture& picture = pictures_[i];
            const glm::dvec3 now = picture.seen(places[marker]);
            const glm::dvec3 then =
                picture.seen(places[marker] + picture.late * velocities[marker]);
            const bool is_before_camera = now.z > 0.1 && then.z > 0.1;
            const glm::dvec2 move =
                is_before_camera ? glm::dvec2(then) - glm::dvec2(now) : glm::dvec2(0.0);
            const MarkRange range = of(marker, i);
            for (std::size_t k = range.first; k < range.first + range.count; ++k) {
                marks_[k].place = unmoved_[k] - move;
            }
        }
    }
}

bool FrameMarks::is_seen(std::size_t marker) const noexcept {
    for (std::size_t picture = 0; picture < pictures_.size(); ++picture) {
        if (of(marker, picture).count > 0) {
            return true;
        }
    }
    return false;
}

}  // namespace raks::capture
