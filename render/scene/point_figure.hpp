#pragma once

#include <cstddef>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/point_clip.hpp"
#include "render/scene/clip_figure.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// How recorded points lie in the world.
struct PointFrame {
    double metres_per_unit = 1.0;  ///< > 0
    glm::dvec3 up{0.0, 1.0, 0.0};  ///< in the recording's axes; unit length
};

/// The frame of a recording: what its file says; else the unit (m, cm or mm) in which the points
/// are about as high as a person, and as up that one of y and z along which they reach further.
struct GuessedPointFrame {
    PointFrame frame;
    bool is_unit_guessed = false;
    bool is_up_guessed = false;
};
[[nodiscard]] GuessedPointFrame guess_point_frame(const motion::PointClip& clip);

/// Recorded points as spheres, joined by nothing: no body is known. Upright, the lowest on the
/// floor (the 5th percentile over the frames), the middle of their way at the stage's centre.
/// Points that were not seen are not drawn. Threads: any (immutable). Real-time: no.
class PointFigures final : public RecordedFigures {
 public:
    /// The clip must outlive it. Errors: no frames, more points than a mesh has room for (1,000).
    [[nodiscard]] static Expected<PointFigures> create(const motion::PointClip& clip,
                                                       const PointFrame& frame);

    [[nodiscard]] float size() const noexcept override { return size_; }
    [[nodiscard]] ClipFigure at(std::size_t frame) const override;

 private:
    PointFigures(const motion::PointClip& clip, const PointFrame& frame);
    [[nodiscard]] glm::dvec3 upright(const glm::dvec3& place) const;

    const motion::PointClip* clip_;
    double metres_per_unit_ = 1.0;
    glm::dquat turn_{1.0, 0.0, 0.0, 0.0};  // from the recording's axes to y up
    glm::dvec3 origin_{};                  // of the stage; metres, upright
    float size_ = 1.0F;
};

}  // namespace raks::render
