#include "render/scene/clip_figure.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>

#include "base/statistics.hpp"
#include "motion/skeleton/text_lines.hpp"
#include "render/scene/stick_figure.hpp"

namespace raks::render {
namespace {

constexpr double kMannequinHeight = 1.714;  // metres: what the stick figure's radii belong to
constexpr float kMinSize = 0.05F;
constexpr float kMaxSize = 20.0F;
// Of the body's height: bones shorter than this, so far out in the T-pose, are a hand's.
constexpr double kFingerLength = 0.065;
constexpr double kFingersFrom = 0.3;
constexpr double kMiddle = 0.02;      // of the height: joints nearer to x = 0 have no side
constexpr double kFloorShare = 0.05;  // of the frames have their lowest joint below the floor

/// Joint places in the rest pose, tips included: how high the body is.
double rest_height(const motion::MotionClip& clip, const std::vector<glm::dvec3>& rest) {
    double low = 1e300;
    double high = -1e300;
    for (std::size_t joint = 0; joint < rest.size(); ++joint) {
        const double tip = rest[joint].y + clip.joints[joint].end_site.value_or(glm::dvec3(0.0)).y;
        low = std::min({low, rest[joint].y, tip});
        high = std::max({high, rest[joint].y, tip});
    }
    return high - low;
}

/// Whether a joint is called "head", with or without a name space or prefix before it.
bool is_named_head(const std::string& name) {
    const std::string plain = motion::lower(name.substr(name.rfind(':') + 1));
    return plain == "head" || plain.ends_with("_head") || plain.ends_with(" head");
}

}  // namespace

Expected<ClipFigures> ClipFigures::create(const motion::MotionClip& clip, double metres_per_unit) {
    if (clip.frame_count == 0 || clip.joints.empty()) {
        return fail("has no frame to draw");
    }
    if (clip.joints.size() > kMaxJoints) {
        return fail("has " + std::to_string(clip.joints.size()) + " joints; at most " +
                    std::to_string(kMaxJoints) + " can be drawn");
    }
    ClipFigures figures(clip);
    figures.metres_per_unit_ = metres_per_unit;
    figures.find_bones();
    figures.look_at_rest_pose();
    figures.find_origin();
    return figures;
}

/// A humanoid's joints are known by their part in the skeleton; of anything else only the head.
void ClipFigures::find_bones() {
    if (auto mapping = motion::map_humanoid(*clip_)) {
        mapping_ = *mapping;
        head_ = mapping_.joint(motion::Bone::head);
        return;
    }
    for (std::size_t joint = 0; joint < clip_->joints.size() && !head_; ++joint) {
        if (is_named_head(clip_->joints[joint].name)) {
            head_ = joint;
        }
    }
}

/// Size, sides and fingers come from the rest pose, where they do not depend on the motion.
void ClipFigures::look_at_rest_pose() {
    const std::vector<glm::dvec3> rest = motion::rest_positions(*clip_);
    const double height = rest_height(*clip_, rest);
    size_ = std::clamp(
        static_cast<float>(height * metres_per_unit_ / kMannequinHeight), kMinSize, kMaxSize);
    joints_.resize(rest.size());
    for (std::size_t j = 0; j < rest.size(); ++j) {
        const std::size_t parent = clip_->joints[j].parent;
        Joint& joint = joints_[j];
        joint.is_small = std::abs(rest[j].x) > kFingersFrom * height &&
                         glm::length(rest[j] - rest[parent]) < kFingerLength * height;
        if (std::abs(rest[j].x) > kMiddle * height) {
            joint.side = rest[j].x > 0.0 ? JointSide::left : JointSide::right;
        }
        // A joint below the head is hidden, and with it everything below that joint.
        joint.is_drawn = parent == j || (joints_[parent].is_drawn && parent != head_);
    }
}

/// Under the middle of the root's way, at the height of the floor.
void ClipFigures::find_origin() {
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    std::vector<double> lowest;
    for (std::size_t frame = 0; frame < clip_->frame_count; ++frame) {
        const motion::ClipWorldPose world = motion::world_pose(*clip_, frame);
        low = glm::min(low, world.positions[0]);
        high = glm::max(high, world.positions[0]);
        double least = 1e300;
        for (std::size_t j = 0; j < joints_.size(); ++j) {
            // A foot's end site is lower than its joint; without end site the tip is the joint
            // itself.
            const glm::dvec3 tip = clip_->joints[j].end_site.value_or(glm::dvec3(0.0));
            least = std::min(
                {least, world.positions[j].y, (world.positions[j] + world.rotations[j] * tip).y});
        }
        lowest.push_back(least);
    }
    // A low percentile, not the minimum: single frames with a foot below the floor would lift all.
    const auto floor_rank =
        static_cast<std::size_t>(kFloorShare * static_cast<double>(lowest.size()));
    origin_ =
        metres_per_unit_ *
        glm::dvec3(0.5 * (low.x + high.x), nth_value(lowest, floor_rank), 0.5 * (low.z + high.z));
    // Sticks have a thickness: the foot's stands on the floor, not in it.
    origin_.y -= static_cast<double>(kStickTaper * kStickBoneRadius * size_);
}

/// World place on the stage. The subtraction is in doubles: clips may be recorded far from their
/// origin.
glm::vec3 ClipFigures::place_of(const glm::dvec3& in_file_units) const {
    return glm::vec3(metres_per_unit_ * in_file_units - origin_);
}

/// The sphere of a joint, the stick to its parent, and the stick to its tip where it ends a limb.
void ClipFigures::add_joint(const motion::ClipWorldPose& world,
                            std::size_t j,
                            Shape<StickVertex>& shape) const {
    const Joint& joint = joints_[j];
    const StickPart part = joint.side == JointSide::middle ? StickPart::middle
                           : joint.side == JointSide::left ? StickPart::left
                                                           : StickPart::right;
    StickBuilder builder(shape, 0, part);
    const glm::vec3 place = place_of(world.positions[j]);
    const float radius = size_ * (joint.is_small ? kStickFingerRadius : kStickJointRadius);
    builder.set_tint(1.0F);
    // Few triangles for fingers: they are small in the picture and there are many.
    builder.add_ellipsoid(
        place, glm::vec3(radius), joint.is_small ? 6 : 10, joint.is_small ? 8 : 18);
    builder.set_tint(part == StickPart::middle ? 0.0F : kStickBoneTint);
    const float thickness = size_ * (joint.is_small ? kStickFingerBoneRadius : kStickBoneRadius);
    if (const std::size_t parent = clip_->joints[j].parent; parent != j) {
        builder.add_cone(
            place_of(world.positions[parent]), place, thickness, kStickTaper * thickness);
    }
    if (clip_->joints[j].end_site && j != head_) {
        const glm::vec3 tip =
            place_of(world.positions[j] + world.rotations[j] * *clip_->joints[j].end_site);
        builder.add_cone(place, tip, thickness, kStickTaper * thickness);
        builder.add_ellipsoid(tip, glm::vec3(kStickTaper * thickness), 6, 10);
    }
}

/// The head is built at the origin in the mannequin's size, then turned, scaled and moved.
void ClipFigures::add_head(const motion::ClipWorldPose& world, Shape<StickVertex>& shape) const {
    if (!head_) {
        return;
    }
    const std::size_t first = shape.vertices.size();
    StickBuilder(shape, 0, StickPart::middle).add_head();
    const glm::vec3 place = place_of(world.positions[*head_]);
    const glm::quat rotation(world.rotations[*head_]);
    for (std::size_t i = first; i < shape.vertices.size(); ++i) {
        StickVertex& vertex = shape.vertices[i];
        vertex.position = place + size_ * (rotation * vertex.position);
        vertex.normal = rotation * vertex.normal;
    }
}

/// Places of the humanoid's bones. Bones come after their parents, so a missing one can take the
/// place that its parent already has.
motion::WorldPose ClipFigures::landmarks(const motion::ClipWorldPose& world) const {
    motion::WorldPose landmarks;
    landmarks.rotations.fill(motion::kNoRotation);
    landmarks.positions[0] =
        place_of(world.positions[mapping_.joint(motion::Bone::hips).value_or(0)]);
    for (std::size_t bone = 1; bone < landmarks.positions.size(); ++bone) {
        const auto joint = mapping_.joints[bone];
        landmarks.positions[bone] = joint ? place_of(world.positions[*joint])
                                          : landmarks.positions[motion::kBoneParents[bone]];
    }
    return landmarks;
}

ClipFigure ClipFigures::at(std::size_t frame) const {
    const motion::ClipWorldPose world = motion::world_pose(*clip_, frame);
    ClipFigure figure;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
        if (joints_[j].is_drawn) {
            add_joint(world, j, figure.shape);
        }
    }
    add_head(world, figure.shape);
    figure.landmarks = landmarks(world);
    return figure;
}

}  // namespace raks::render
