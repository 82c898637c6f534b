#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/body/body_finder.hpp"
#include "motion/skeleton/motion_clip.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/scene/camera.hpp"
#include "render/scene/stick_figure.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// A recorded body as it stands in the world at one frame.
struct ClipBody {
    Shape<StickVertex> shape;  ///< in the world, metres; all of bone 0
    /// Where the humanoid's joints are, for shadow, light and camera; a joint that the clip does
    /// not have lies where its parent does.
    motion::WorldPose landmarks;
};

/// A joint or point of a recording on the stage.
struct BodyPoint {
    std::string_view name;               ///< as its file has it; lives as long as the bodies
    glm::vec3 place{};                   ///< in the world, metres; NaN: not seen
    StickPart part = StickPart::middle;  ///< whose colour it has
};

/// What is drawn of a recording, frame by frame.
class RecordedBodies {
 public:
    virtual ~RecordedBodies() = default;
    /// Its joints or points at a frame, where `at` draws them; the same ones in each frame.
    [[nodiscard]] virtual std::vector<BodyPoint> points(std::size_t frame) const = 0;
    /// Its height divided by the mannequin's: the factor for a camera's distance.
    [[nodiscard]] virtual float size() const noexcept = 0;
    /// The body at a frame of the recording; `frame` < its frame count.
    [[nodiscard]] virtual ClipBody at(std::size_t frame) const = 0;
};

/// The camera as far away as a body needs to lie in a picture of width / height = `aspect` whole,
/// with a margin, when the camera has panned to its hips; no nearer than it stands. A body that
/// is too large for the greatest distance is cut.
[[nodiscard]] Camera enclosing(Camera camera, float aspect, const ClipBody& body);

/// The stick figure of a clip's own skeleton, of whatever shape: bones keep their lengths. A
/// humanoid is found as for retargeting (body_finder.hpp): it stands with y up, in metres, on the
/// whole facing us. Of anything else (an animal, half a body) the longer of y and z is up, and the
/// unit guessed from the extent of the rest pose. Feet on the floor (y = 0 at the 5th percentile of
/// the lowest joint's height), the middle of the root's way at the stage's centre. Joints whose
/// rest place is left or right of the middle have that side's colour; the head is an egg with a
/// nose where one is known. Threads: any (immutable). Real-time: no.
class ClipBodies final : public RecordedBodies {
 public:
    /// The most joints that are drawn.
    static constexpr std::size_t kMaxJoints =
        200;  ///< what 16-bit indices of one mesh have room for

    /// `options`: what is known of the clip. Errors: no frames, more joints than above.
    [[nodiscard]] static Expected<ClipBodies> create(motion::MotionClip clip,
                                                     const motion::BodyOptions& options = {});

    /// The body, where it is a humanoid's.
    [[nodiscard]] const std::optional<motion::FoundBody>& body() const noexcept { return body_; }
    /// What was taken in doubt; one line each.
    [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return notes_; }
    /// Metres a unit of the file that was taken.
    [[nodiscard]] double metres_per_unit() const noexcept { return metres_per_unit_; }
    /// Frames of the clip.
    [[nodiscard]] std::size_t frames() const noexcept { return clip_.frame_count; }

    /// Height of the body as posed divided by the mannequin's: the factor for a camera's distance.
    /// A body of absurd size (a wrong unit was given) is drawn as small or large as can be shown.
    [[nodiscard]] float size() const noexcept override { return size_; }

    /// The body at a frame of the clip; `frame` < the clip's frame count.
    [[nodiscard]] ClipBody at(std::size_t frame) const override;
    /// Those of its joints that are drawn.
    [[nodiscard]] std::vector<BodyPoint> points(std::size_t frame) const override;

 private:
    explicit ClipBodies(motion::MotionClip clip) : clip_(std::move(clip)) {}

    struct Joint {
        bool is_drawn = true;   // below a head: eyes and jaws lie inside the egg
        bool is_small = false;  // a finger's
        StickPart side = StickPart::middle;
    };

    void find_bones(const motion::BodyOptions& options);
    void stand_up_other(const motion::BodyOptions& options);
    void look_at_rest_pose();
    void find_origin();
    void face_us();
    [[nodiscard]] glm::vec3 place_of(const glm::dvec3& in_file_units) const;
    void add_joint(const motion::ClipWorldPose& world,
                   std::size_t joint,
                   Shape<StickVertex>& shape) const;
    void add_head(const motion::ClipWorldPose& world, Shape<StickVertex>& shape) const;
    [[nodiscard]] motion::WorldPose landmarks(const motion::ClipWorldPose& world) const;

    motion::MotionClip clip_;  // standing
    std::optional<motion::FoundBody> body_;
    std::vector<std::string> notes_;
    double metres_per_unit_ = 1.0;
    double drawn_metres_ = 1.0;  // of a unit, for a body of a size that can be shown
    float size_ = 1.0F;          // of the body against the mannequin's 1.714 m
    std::vector<Joint> joints_;
    std::optional<std::size_t> head_;
    motion::HumanoidMapping mapping_;           // empty for what is no humanoid
    glm::dvec3 origin_{};                       // of the stage; drawn metres
    glm::dquat facing_ = {1.0, 0.0, 0.0, 0.0};  // turns the body to us
};

}  // namespace raks::render
