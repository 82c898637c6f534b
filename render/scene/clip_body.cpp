#include "render/scene/clip_body.hpp"

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
constexpr float kMinSize = 0.2F;
constexpr float kMaxSize = 2.5F;  // larger ones the camera cannot go far enough away from
// Of the body's height: bones shorter than this, so far out in the T-pose, are a hand's.
constexpr double kFingerLength = 0.065;
constexpr double kFingersFrom = 0.3;
constexpr double kMiddle = 0.02;      // of the height: joints nearer to x = 0 have no side
constexpr double kFloorShare = 0.05;  // of the frames have their lowest joint below the floor

/// The range of all joints' places along an axis, tips included, over a few frames: how high the
/// body is, as posed.
double posed_extent(const motion::MotionClip& clip, const glm::dvec3& axis) {
    constexpr std::size_t kFrames = 40;
    std::vector<double> extents;
    const std::size_t count = std::min(kFrames, clip.frame_count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t frame = count == 1 ? 0 : i * (clip.frame_count - 1) / (count - 1);
        const motion::ClipWorldPose world = motion::world_pose(clip, frame);
        double low = 1e300;
        double high = -1e300;
        for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
            const glm::dvec3 tip = clip.joints[joint].end_site.value_or(glm::dvec3(0.0));
            const double place = glm::dot(world.positions[joint], axis);
            const double end = place + glm::dot(world.rotations[joint] * tip, axis);
            low = std::min({low, place, end});
            high = std::max({high, place, end});
        }
        extents.push_back(high - low);
    }
    return upper_median(std::move(extents));
}

/// Whether a joint is called "head", with or without a name space or prefix before it.
bool is_named_head(const std::string& name) {
    const std::string plain = motion::lower(name.substr(name.rfind(':') + 1));
    return plain == "head" || plain.ends_with("_head") || plain.ends_with(" head");
}

// Whether a body lies in the picture whole, with a margin.
bool is_whole(const Camera& camera, float aspect, const ClipBody& body) {
    constexpr float kEdge = 0.96F;  // of half the picture
    const glm::mat4 clip_from_world = camera.clip_from_world(aspect);
    return std::all_of(
        body.shape.vertices.begin(), body.shape.vertices.end(), [&](const StickVertex& vertex) {
            const glm::vec4 at = clip_from_world * glm::vec4(vertex.position, 1.0F);
            return at.w > 0.0F && std::abs(at.x) <= kEdge * at.w && std::abs(at.y) <= kEdge * at.w;
        });
}

}  // namespace

Camera enclosing(Camera camera, float aspect, const ClipBody& body) {
    constexpr float kStep = 1.03F;
    Camera panned = camera;
    panned.pan_to(body.landmarks.position(motion::Bone::hips));
    while (!is_whole(panned, aspect, body) && panned.distance < Camera::kMaxDistance) {
        panned.zoom(kStep);
    }
    camera.distance = panned.distance;
    return camera;
}

Expected<ClipBodies> ClipBodies::create(motion::MotionClip clip,
                                        const motion::BodyOptions& options) {
    if (clip.frame_count == 0 || clip.joints.empty()) {
        return fail("has no frame to draw");
    }
    if (clip.joints.size() > kMaxJoints) {
        return fail("has " + std::to_string(clip.joints.size()) + " joints; at most " +
                    std::to_string(kMaxJoints) + " can be drawn");
    }
    ClipBodies bodies(std::move(clip));
    bodies.find_bones(options);
    bodies.look_at_rest_pose();
    bodies.face_us();
    bodies.find_origin();
    return bodies;
}

/// A humanoid's joints are known by their part in the skeleton; of anything else only the head.
void ClipBodies::find_bones(const motion::BodyOptions& options) {
    auto body = motion::find_body(clip_, options);
    if (body) {
        clip_ = motion::stood_up(std::move(clip_), *body);
        metres_per_unit_ = body->size.metres_per_unit;
        mapping_ = body->mapping();
        head_ = mapping_.joint(motion::Bone::head);
        notes_ = body->notes();
        body_ = std::move(*body);
        return;
    }
    stand_up_other(options);
    for (std::size_t joint = 0; joint < clip_.joints.size() && !head_; ++joint) {
        if (is_named_head(clip_.joints[joint].name)) {
            head_ = joint;
        }
    }
}

/// Which axis is up in a clip that is not of a human body, so that there are no feet to tell it:
/// the axis that was given, else the longer of y and z.
void ClipBodies::stand_up_other(const motion::BodyOptions& options) {
    const glm::dvec3 y(0.0, 1.0, 0.0);
    const glm::dvec3 z(0.0, 0.0, 1.0);
    constexpr double kClearly = 1.5;
    const bool is_z_up = posed_extent(clip_, z) > kClearly * posed_extent(clip_, y);
    const glm::dvec3 up = options.up.value_or(is_z_up ? z : y);
    if (!options.up && is_z_up) {
        notes_.push_back("+z is taken for up, along which it is longer (--up sets it)");
    }
    metres_per_unit_ = options.metres_per_unit.value_or(motion::guess_metres_per_unit(clip_));
    const glm::dquat turn = motion::turn_to_y(up);
    for (std::size_t j = 0; j < clip_.joints.size(); ++j) {
        if (clip_.joints[j].parent != j) {
            continue;
        }
        clip_.joints[j].offset = turn * clip_.joints[j].offset;
        for (std::size_t frame = 0; frame < clip_.frame_count; ++frame) {
            const std::size_t at = frame * clip_.joints.size() + j;
            clip_.positions[at] = turn * clip_.positions[at];
            clip_.rotations[at] = turn * clip_.rotations[at];
        }
    }
}

/// Sides and fingers come from the rest pose, where they do not depend on the motion; the size from
/// the posed body.
void ClipBodies::look_at_rest_pose() {
    const std::vector<glm::dvec3> rest = motion::rest_positions(clip_);
    const double extent = posed_extent(clip_, {0.0, 1.0, 0.0});
    const double height = body_ ? std::max(body_->size.height / metres_per_unit_, extent) : extent;
    const double size = height * metres_per_unit_ / kMannequinHeight;
    size_ = std::clamp(static_cast<float>(size), kMinSize, kMaxSize);
    // Bodies of other sizes are drawn in the size that the camera can still show.
    drawn_metres_ =
        size > 0.0 ? metres_per_unit_ * static_cast<double>(size_) / size : metres_per_unit_;
    joints_.resize(rest.size());
    for (std::size_t j = 0; j < rest.size(); ++j) {
        const std::size_t parent = clip_.joints[j].parent;
        Joint& joint = joints_[j];
        joint.is_small = std::abs(rest[j].x) > kFingersFrom * height &&
                         glm::length(rest[j] - rest[parent]) < kFingerLength * height;
        if (std::abs(rest[j].x) > kMiddle * height) {
            joint.side = rest[j].x > 0.0 ? StickPart::left : StickPart::right;
        }
        // A joint below the head is hidden, and with it everything below that joint; so is what a
        // body's hips hang on (a root that stays on the floor).
        const bool is_hips = j == mapping_.joint(motion::Bone::hips);
        const bool is_top = is_hips || (parent == j && !body_);
        joint.is_drawn = is_top || (joints_[parent].is_drawn && parent != j && parent != head_);
    }
}

/// Turns the body so that it faces us on the whole, by the line of its hip sockets: the mean of all
/// frames, or the first where it turns about. A body that nearly does keeps its axes.
void ClipBodies::face_us() {
    const auto left = mapping_.joint(motion::Bone::left_upper_leg);
    const auto right = mapping_.joint(motion::Bone::right_upper_leg);
    if (!left || !right) {
        return;
    }
    const auto ahead = [&](std::size_t frame) {
        const motion::ClipWorldPose world = motion::world_pose(clip_, frame);
        const glm::dvec3 across = world.positions[*left] - world.positions[*right];
        const glm::dvec3 way(-across.z, 0.0, across.x);
        return glm::length(way) > 0.0 ? glm::normalize(way) : glm::dvec3(0.0);
    };
    glm::dvec3 mean(0.0);
    for (std::size_t frame = 0; frame < clip_.frame_count; ++frame) {
        mean += ahead(frame) / static_cast<double>(clip_.frame_count);
    }
    constexpr double kOnTheWhole = 0.4;  // length of a mean of directions
    const glm::dvec3 face = glm::length(mean) > kOnTheWhole ? mean : ahead(0);
    const double heading = std::atan2(face.x, face.z);
    constexpr double kNearly = 0.5;  // radians
    if (std::abs(heading) > kNearly) {
        facing_ = glm::angleAxis(-heading, glm::dvec3(0.0, 1.0, 0.0));
    }
}

/// Under the middle of the root's way, at the height of the floor.
void ClipBodies::find_origin() {
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    std::vector<double> lowest;
    for (std::size_t frame = 0; frame < clip_.frame_count; ++frame) {
        const motion::ClipWorldPose world = motion::world_pose(clip_, frame);
        low = glm::min(low, world.positions[0]);
        high = glm::max(high, world.positions[0]);
        double least = 1e300;
        for (std::size_t j = 0; j < joints_.size(); ++j) {
            if (!joints_[j].is_drawn) {
                continue;
            }
            // A foot's end site is lower than its joint; without end site the tip is the joint
            // itself.
            const glm::dvec3 tip = clip_.joints[j].end_site.value_or(glm::dvec3(0.0));
            least = std::min(
                {least, world.positions[j].y, (world.positions[j] + world.rotations[j] * tip).y});
        }
        lowest.push_back(least);
    }
    // A low percentile, not the minimum: single frames with a foot below the floor would lift all.
    const auto floor_rank =
        static_cast<std::size_t>(kFloorShare * static_cast<double>(lowest.size()));
    origin_ =
        drawn_metres_ *
        glm::dvec3(0.5 * (low.x + high.x), nth_value(lowest, floor_rank), 0.5 * (low.z + high.z));
    // Sticks have a thickness: the foot's stands on the floor, not in it.
    origin_.y -= static_cast<double>(kStickTaper * kStickBoneRadius * size_);
}

/// World place on the stage. The subtraction is in doubles: clips may be recorded far from their
/// origin.
glm::vec3 ClipBodies::place_of(const glm::dvec3& in_file_units) const {
    return glm::vec3(facing_ * (drawn_metres_ * in_file_units - origin_));
}

/// The sphere of a joint, the stick to its parent, and the stick to its tip where it ends a limb.
void ClipBodies::add_joint(const motion::ClipWorldPose& world,
                           std::size_t j,
                           Shape<StickVertex>& shape) const {
    const Joint& joint = joints_[j];
    const StickPart part = joint.side;
    StickBuilder builder(shape, 0, part);
    const glm::vec3 place = place_of(world.positions[j]);
    const float radius = size_ * (joint.is_small ? kStickFingerRadius : kStickJointRadius);
    builder.set_tint(1.0F);
    // Few triangles for fingers: they are small in the picture and there are many.
    builder.add_ellipsoid(
        place, glm::vec3(radius), joint.is_small ? 6 : 10, joint.is_small ? 8 : 18);
    builder.set_tint(part == StickPart::middle ? 0.0F : kStickBoneTint);
    const float thickness = size_ * (joint.is_small ? kStickFingerBoneRadius : kStickBoneRadius);
    if (const std::size_t parent = clip_.joints[j].parent;
        parent != j && joints_[parent].is_drawn) {
        builder.add_cone(
            place_of(world.positions[parent]), place, thickness, kStickTaper * thickness);
    }
    if (clip_.joints[j].end_site && j != head_) {
        const glm::vec3 tip =
            place_of(world.positions[j] + world.rotations[j] * *clip_.joints[j].end_site);
        builder.add_cone(place, tip, thickness, kStickTaper * thickness);
        builder.add_ellipsoid(tip, glm::vec3(kStickTaper * thickness), 6, 10);
    }
}

/// The head is built at the origin in the mannequin's size, then turned, scaled and moved.
void ClipBodies::add_head(const motion::ClipWorldPose& world, Shape<StickVertex>& shape) const {
    if (!head_) {
        return;
    }
    const std::size_t first = shape.vertices.size();
    StickBuilder(shape, 0, StickPart::middle).add_head();
    const glm::vec3 place = place_of(world.positions[*head_]);
    const glm::quat rotation(facing_ * world.rotations[*head_]);
    for (std::size_t i = first; i < shape.vertices.size(); ++i) {
        StickVertex& vertex = shape.vertices[i];
        vertex.position = place + size_ * (rotation * vertex.position);
        vertex.normal = rotation * vertex.normal;
    }
}

/// Places of the humanoid's bones. Bones come after their parents, so a missing one can take the
/// place that its parent already has.
motion::WorldPose ClipBodies::landmarks(const motion::ClipWorldPose& world) const {
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

ClipBody ClipBodies::at(std::size_t frame) const {
    const motion::ClipWorldPose world = motion::world_pose(clip_, frame);
    ClipBody body;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
        if (joints_[j].is_drawn) {
            add_joint(world, j, body.shape);
        }
    }
    add_head(world, body.shape);
    body.landmarks = landmarks(world);
    return body;
}

std::vector<BodyPoint> ClipBodies::points(std::size_t frame) const {
    const motion::ClipWorldPose world = motion::world_pose(clip_, frame);
    std::vector<BodyPoint> points;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
        if (joints_[j].is_drawn) {
            points.push_back({clip_.joints[j].name, place_of(world.positions[j]), joints_[j].side});
        }
    }
    return points;
}

}  // namespace raks::render
