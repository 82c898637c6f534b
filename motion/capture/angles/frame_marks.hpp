// Frame marks: what the cameras saw at one frame, laid out for weighing postures.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "motion/capture/camera/rig.hpp"
#include "motion/capture/tracking/frame_views.hpp"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace raks::capture {

/// Spots are measured as if every camera had this focal length, in pixels, without distortion and
/// with (0, 0) in the middle. So one bound of what is near holds for all of them.
inline constexpr double kFocalLength = 600.0;

/// A picture that belongs to a frame.
struct MarkPicture {
    std::size_t camera = 0;
    double late = 0.0;   ///< when it was taken, against the frame's moment; seconds
    double scale = 1.0;  ///< pixels of the camera to one of ours
    glm::dmat3 rotation{1.0};
    glm::dvec3 translation{};

    /// Where a place is seen. `z`: its depth, metres; behind the camera it is 0 or less.
    [[nodiscard]] glm::dvec3 seen(const glm::dvec3& place) const noexcept {
        const glm::dvec3 at = rotation * place + translation;
        return {kFocalLength * at.x / at.z, kFocalLength * at.y / at.z, at.z};
    }
};

/// A spot that may be a marker's.
struct Mark {
    glm::dvec2 place{};    ///< where it would be at the frame's moment; our pixels
    std::size_t spot = 0;  ///< index in the frame's spots
};

/// A range of marks.
struct MarkRange {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// The spots of a frame as each marker may have them.
class FrameMarks {
 public:
    /// `spots`: of the frame; must outlive this. `classes`: by marker, its colour.
    /// `is_hidden`: by marker, its spots are not believed. `said`: views that a person said of this
    /// frame; there a marker has that spot and no other.
    FrameMarks(const Rig& rig,
               const std::vector<SeenSpot>& spots,
               const std::vector<std::size_t>& classes,
               const std::vector<bool>& is_hidden,
               const std::vector<SaidView>& said);

    /// Tells where the markers are thought to be and how they move, so that spots of pictures that
    /// were taken earlier or later are moved to the frame's moment. `velocities`: metres a second.
    void set_motion(const std::vector<glm::dvec3>& places,
                    const std::vector<glm::dvec3>& velocities);

    [[nodiscard]] const std::vector<MarkPicture>& pictures() const noexcept { return pictures_; }
    [[nodiscard]] const std::vector<Mark>& marks() const noexcept { return marks_; }
    [[nodiscard]] std::size_t markers() const noexcept { return markers_; }
    /// The marks that a marker may have in a picture.
    [[nodiscard]] MarkRange of(std::size_t marker, std::size_t picture) const noexcept {
        return ranges_[marker * pictures_.size() + picture];
    }
    /// Whether a marker has marks at all.
    [[nodiscard]] bool is_seen(std::size_t marker) const noexcept;

 private:
    std::size_t markers_;
    std::vector<MarkPicture> pictures_;
    std::vector<Mark> marks_;
    std::vector<glm::dvec2> unmoved_;  // by mark: where it is in its picture
    std::vector<MarkRange> ranges_;    // by marker and picture
};

}  // namespace raks::capture
