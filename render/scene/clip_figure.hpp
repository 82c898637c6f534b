#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/humanoid_mapping.hpp"
#include "motion/skeleton/motion_clip.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/scene/stick_figure.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// A recorded body as it stands in the world at one frame.
struct ClipFigure {
    Shape<StickVertex> shape;  ///< in the world, metres; all of bone 0
    /// Where the humanoid's joints are, for shadow, light and camera; a joint that the clip does
    /// not have lies where its parent does.
    motion::WorldPose landmarks;
};

/// What is drawn of a recording, frame by frame.
class RecordedFigures {
 public:
    virtual ~RecordedFigures() = default;
    /// Its height divided by the mannequin's: the factor for a camera's distance.
    [[nodiscard]] virtual float size() const noexcept = 0;
    /// The figure at a frame of the recording; `frame` < its frame count.
    [[nodiscard]] virtual ClipFigure at(std::size_t frame) const = 0;
};

/// The stick figure of a clip's own skeleton, of whatever shape: nothing is retargeted. Feet on the
/// floor (y = 0 at the 5th percentile of the lowest joint's height), the middle of the root's way
/// at the stage's centre. Joints whose rest place is left or right of the middle have that side's
/// colour; the head is an egg with a nose where one is known by name. Threads: any (immutable).
/// Real-time: no.
class ClipFigures final : public RecordedFigures {
 public:
    /// The most joints that are drawn.
    static constexpr std::size_t kMaxJoints =
        200;  ///< what 16-bit indices of one mesh have room for

    /// `metres_per_unit` > 0. The clip must outlive it. Errors: no frames, more joints than above.
    [[nodiscard]] static Expected<ClipFigures> create(const motion::MotionClip& clip,
                                                      double metres_per_unit);

    [[nodiscard]] float size() const noexcept override { return size_; }
    [[nodiscard]] ClipFigure at(std::size_t frame) const override;

 private:
    explicit ClipFigures(const motion::MotionClip& clip) : clip_(&clip) {}

    enum class JointSide : std::uint8_t { middle, left, right };
    struct Joint {
        bool is_drawn = true;   // below a head: eyes and jaws lie inside the egg
        bool is_small = false;  // a finger's
        JointSide side = JointSide::middle;
    };

    void find_bones();
    void look_at_rest_pose();
    void find_origin();
    [[nodiscard]] glm::vec3 place_of(const glm::dvec3& in_file_units) const;
    void add_joint(const motion::ClipWorldPose& world,
                   std::size_t joint,
                   Shape<StickVertex>& shape) const;
    void add_head(const motion::ClipWorldPose& world, Shape<StickVertex>& shape) const;
    [[nodiscard]] motion::WorldPose landmarks(const motion::ClipWorldPose& world) const;

    const motion::MotionClip* clip_;
    double metres_per_unit_ = 1.0;
    float size_ = 1.0F;  // of the body against the mannequin's 1.714 m
    std::vector<Joint> joints_;
    std::optional<std::size_t> head_;
    motion::HumanoidMapping mapping_;  // empty for what is no humanoid
    glm::dvec3 origin_{};              // of the stage; metres
};

}  // namespace raks::render
