#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/point_clip.hpp"
#include "motion/skeleton/points/joint_points.hpp"
#include "render/scene/clip_body.hpp"

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

/// Where several motions stand to each other.
enum class Arrangement : std::uint8_t {
    overlaid,      ///< as they lie in the world
    side_by_side,  ///< each by itself, the first left
};

/// Recorded points as spheres, joined by sticks along their edges. Upright, the lowest on the floor
/// (the 5th percentile over the frames), the middle of their way at the stage's centre. Points that
/// were not seen are not drawn, nor are sticks to them. A single motion is pale; of two the first
/// has the left side's colour, the second the right's. Threads: any (immutable). Real-time: no.
class PointBodies final : public RecordedBodies {
 public:
    /// `motions`: one or two, of the same number of frames. Errors: no frames, more points than a
    /// mesh has room for (1,000 of a motion).
    [[nodiscard]] static Expected<PointBodies> create(
        std::vector<motion::WorldPoints> motions, Arrangement arrangement = Arrangement::overlaid);

    [[nodiscard]] float size() const noexcept override { return size_; }
    [[nodiscard]] ClipBody at(std::size_t frame) const override;
    /// All but tips of limbs.
    [[nodiscard]] std::vector<BodyPoint> points(std::size_t frame) const override;

 private:
    struct Part {
        motion::WorldPoints points;
        glm::dvec3 origin{};       // of the stage; metres
        std::vector<float> radii;  // by point, against a point that stands free
        StickPart colour = StickPart::middle;
    };
    // Cells of a sphere and sides of a stick.
    struct Detail {
        std::size_t rows;
        std::size_t columns;
        std::size_t sides;
    };

    explicit PointBodies(std::vector<motion::WorldPoints> motions);
    [[nodiscard]] Expected<void> stand_on_floor();
    void stand_side_by_side();
    [[nodiscard]] Expected<void> choose_detail();
    void add(const Part& part, std::size_t frame, Shape<StickVertex>& shape) const;

    std::vector<Part> parts_;
    float size_ = 1.0F;
    Detail detail_{};
};

}  // namespace raks::render
