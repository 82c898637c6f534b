#include "apps/xbody/shown_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/printable.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/loaded_avatar.hpp"
#include "engine/show/standing_model.hpp"
#include "render/avatar/model_avatar.hpp"
#include "render/import/humanoid_labels.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/model_reader.hpp"
#include "render/import/node_tree.hpp"
#include "render/model/model_survey.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

constexpr double kUsualRate = 60.0;  // frames a second

/// The eight corners of a box.
std::vector<glm::vec3> corners_of(const glm::vec3& low, const glm::vec3& high) {
    constexpr int kCorners = 8;
    std::vector<glm::vec3> corners;
    corners.reserve(kCorners);
    for (int i = 0; i < kCorners; ++i) {
        corners.emplace_back((i & 1) != 0 ? high.x : low.x,
                             (i & 2) != 0 ? high.y : low.y,
                             (i & 4) != 0 ? high.z : low.z);
    }
    return corners;
}

/// Adds the places of a figure's bones, and of its fingertips.
void add_bones(const ShownModel& model, const ShownPose& shown, std::vector<glm::vec3>& points) {
    constexpr float kHand = 0.8F;  // of a forearm, from the hand's joint to the tips
    const render::HumanoidMap& humanoid = model.figure.model.character.humanoid;
    const auto place = [&](motion::Bone bone) -> std::optional<glm::vec3> {
        const int joint = model.avatar->rig->tree.joint_of(humanoid.nodes[motion::index_of(bone)]);
        return joint < 0 ? std::nullopt
                         : std::optional<glm::vec3>(
                               shown.state.joints.world[static_cast<std::size_t>(joint)][3]);
    };
    for (std::size_t bone = 0; bone < humanoid.nodes.size(); ++bone) {
        if (const auto there = place(static_cast<motion::Bone>(bone))) {
            points.push_back(*there);
        }
    }
    for (const motion::Side side : motion::kSides) {
        const auto elbow = place(on_side(motion::Bone::left_lower_arm, side));
        const auto hand = place(on_side(motion::Bone::left_hand, side));
        if (elbow && hand) {
            points.push_back(*hand + kHand * (*hand - *elbow));
        }
    }
}

/// Adds the places of all joints of a thing but those that are farther from it than it is large:
/// what carries nothing may be anywhere. `points`: a body's box.
void add_joints(const ShownPose& shown, float largest, std::vector<glm::vec3>& points) {
    const glm::vec3 middle =
        points.empty() ? glm::vec3(0.0F) : 0.5F * (points.front() + points.back());
    for (const glm::mat4& world : shown.state.joints.world) {
        if (const glm::vec3 place(world[3]); glm::distance(middle, place) <= largest) {
            points.push_back(place);
        }
    }
}

Expected<void> read_labels(const ShownModelPlan& plan, ShownModel& shown) {
    const fs::path found = engine::find_labels(plan.file, plan.options.labels);
    if (found.empty()) {
        shown.labels_file = plan.file;
        shown.labels_file.replace_extension(".labels.toml");
        return {};
    }
    shown.labels_file = found;
    auto labels = render::load_labels(found);
    if (!labels) {
        return fail(std::move(labels.error()));
    }
    shown.labels = std::move(*labels);
    return {};
}

// Makes a model without a body ready to be looked at, and one with a body ready to dance.
void stand(ShownModel& shown) {
    render::Model& model = shown.figure.model;
    model = shown.as_read;
    const auto mapped = render::map_humanoid(model, shown.labels ? &*shown.labels : nullptr);
    if (!mapped) {
        model.warnings.push_back("it cannot dance: " + mapped.error().message);
    }
    shown.figure.options = render::missing_bones(model.character.humanoid).empty()
                               ? engine::stand_model(model, shown.plan.options.height)
                               : engine::stand_thing(model);
}

// The images are unpacked; what they lack is a fault of the file.
void make_first_avatar(ShownModel& shown) {
    const std::size_t before = shown.figure.model.warnings.size();
    auto loaded = engine::make_avatar(shown.figure, shown.plan.file.filename().string());
    const auto& warnings = shown.figure.model.warnings;
    shown.as_read.warnings.insert(shown.as_read.warnings.end(),
                                  warnings.begin() + static_cast<std::ptrdiff_t>(before),
                                  warnings.end());
    shown.avatar = std::move(loaded.avatar);
    shown.images = shown.avatar->surface.images->get();
    shown.notes = std::move(loaded.warnings);
}

}  // namespace

std::size_t ShownModel::frame_count() const {
    constexpr double kSlack = 1e-3;  // of a frame: clips have their times as floats
    constexpr double kMost = 1e7;
    return clip ? 1 + static_cast<std::size_t>(
                          std::clamp(clip->duration() * clip->rate() + kSlack, 0.0, kMost))
                : 1;
}

double ShownModel::rate() const { return clip ? clip->rate() : kUsualRate; }

Expected<ShownModel> load_shown_model(const ShownModelPlan& plan) {
    auto model = render::load_model(plan.file);
    if (!model) {
        return fail(std::move(model.error()));
    }
    if (model->meshes.empty() && model->nodes.empty()) {
        return fail(printable(plan.file.string()) + ": there is nothing in it to show");
    }
    ShownModel shown;
    shown.plan = plan;
    if (auto read = read_labels(plan, shown); !read) {
        return fail(std::move(read.error()));
    }
    shown.as_read = std::move(*model);
    stand(shown);
    make_first_avatar(shown);
    if (!plan.motion.empty()) {
        auto clip = load_motion(plan.motion, wearer_of(shown));
        if (!clip) {
            return fail(std::move(clip.error()));
        }
        shown.clip = std::move(*clip);
    }
    return shown;
}

void stand_by_labels(std::vector<render::BoneLabel> labels, ShownModel& model) {
    model.labels.reset();
    if (!labels.empty()) {
        model.labels = render::BoneLabels{.file = printable(model.labels_file.filename().string()),
                                          .bones = std::move(labels)};
    }
    stand(model);
    model.avatar = std::make_shared<const render::Avatar>(render::build_avatar_with(
        model.avatar->surface.images, model.figure.model, model.figure.options));
    model.notes = model.figure.model.warnings;
    const auto& rig = model.avatar->rig->warnings;
    model.notes.insert(model.notes.end(), rig.begin(), rig.end());
    model.clip.reset();
    if (model.plan.motion.empty()) {
        return;
    }
    if (auto clip = load_motion(model.plan.motion, wearer_of(model))) {
        model.clip = std::move(*clip);
    } else {
        model.notes.push_back(clip.error().message);
    }
}

MotionWearer wearer_of(const ShownModel& model) {
    return {.plan = model.plan,
            .labels = model.labels,
            .missing = render::missing_bones(model.figure.model.character.humanoid),
            .hips = model.avatar->skeleton.offsets[0],
            .scale = model.figure.options.scale};
}

Expected<engine::AvatarClip> load_motion(const std::string& motion, const MotionWearer& wearer) {
    if (!wearer.missing.empty()) {
        return fail(fmt::format("{}: no figure that can move: it lacks {}; label them first",
                                printable(wearer.plan.file.string()),
                                wearer.missing));
    }
    return engine::AvatarClip::load(motion,
                                    wearer.hips,
                                    {.avatar = wearer.plan.file,
                                     .own_scale = wearer.scale,
                                     .labels = wearer.plan.options.labels,
                                     .joints = wearer.plan.joints,
                                     .arm_angle = wearer.plan.arm_angle,
                                     .own_labels = wearer.labels,
                                     .others = render::OtherNodes::moved});
}

void wear(std::string motion, engine::AvatarClip clip, ShownModel& model) {
    model.clip = std::move(clip);
    model.plan.motion = std::move(motion);
}

ShownPose::ShownPose(const ShownModel& model) : state(*model.avatar->rig) {
    show_frame(model, 0, *this);
}

void show_frame(const ShownModel& model, std::size_t frame, ShownPose& shown) {
    const double seconds =
        static_cast<double>(std::min(frame, model.frame_count() - 1)) / model.rate();
    if (model.clip) {
        shown.pose = model.clip->pose_at(seconds);
    } else {
        shown.pose = {};
        shown.pose.hips_position = model.avatar->skeleton.offsets[0];
    }
    shown.face =
        model.clip ? model.clip->face_at(seconds).value_or(render::Face()) : render::Face();
    const render::JointTree& tree = model.avatar->rig->tree;
    render::go_to_rest(tree.joints, shown.state.joints);  // a clip before may have moved others
    if (model.clip) {
        model.clip->move_others(seconds, shown.pose, tree, shown.state.joints);
    }
    render::pose_avatar(*model.avatar->rig, shown.pose, shown.face, 1.0F, shown.state);
}

render::Camera camera_before(render::Camera camera,
                             const std::vector<glm::vec3>& points,
                             float aspect) {
    constexpr float kMargin = 1.08F;
    glm::vec3 low = points.front();
    glm::vec3 high = points.front();
    for (const glm::vec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    camera.target = 0.5F * (low + high);
    const glm::mat4 view = camera.view_from_world();
    const glm::mat4 clip = camera.clip_from_view(aspect);
    float distance = render::Camera::kMinDistance;
    for (const glm::vec3& point : points) {
        const glm::vec3 seen(view * glm::vec4(point, 1.0F));
        const float nearer = seen.z + camera.distance;
        distance = std::max(distance,
                            nearer + kMargin * std::max(std::abs(seen.x) * clip[0][0],
                                                        std::abs(seen.y) * clip[1][1]));
    }
    camera.distance = std::min(distance, render::Camera::kMaxDistance);
    return camera;
}

render::Camera camera_of_view(std::string_view view) {
    render::Camera camera =
        render::find_camera(view).value_or(render::find_camera("front").value_or(render::Camera{}));
    camera.pitch = view == "top" ? render::Camera::kMaxPitch : render::Camera::kMinPitch;
    return camera;
}

std::vector<glm::vec3> reached_places(const ShownModel& model, const ShownPose& shown) {
    std::vector<glm::vec3> points;
    float largest = std::numeric_limits<float>::infinity();
    if (const auto box = render::rest_box(model.figure.model)) {
        // Where the body is now, as large as at rest, with its soles on the floor.
        const float scale = model.figure.options.scale;
        const float turned = model.figure.model.character.faces_minus_z ? -1.0F : 1.0F;
        const glm::vec3 size(turned * scale, scale, turned * scale);
        const glm::vec3 moved = shown.pose.hips_position - model.avatar->skeleton.offsets[0] -
                                glm::vec3(0.0F, model.avatar->soles, 0.0F);
        const auto corners = corners_of(box->low * size + moved, box->high * size + moved);
        points.insert(points.end(), corners.begin(), corners.end());
        largest = glm::distance(corners.front(), corners.back());
    }
    if (render::missing_bones(model.figure.model.character.humanoid).empty()) {
        add_bones(model, shown, points);
    } else {
        add_joints(shown, largest, points);
    }
    return points;
}

render::Camera camera_before(const ShownModel& model,
                             const ShownPose& shown,
                             std::string_view view,
                             float aspect) {
    const render::Camera camera = camera_of_view(view);
    const std::vector<glm::vec3> points = reached_places(model, shown);
    return points.empty() ? camera : camera_before(camera, points, aspect);
}

void set_look(const ModelLook& look, ShownModel& model) {
    model.avatar = std::make_shared<const render::Avatar>(render::build_avatar_with(
        model.avatar->surface.images, looked(model.figure.model, look), model.figure.options));
}

std::vector<glm::vec3> branch_places(const ShownModel& model, const ShownPose& shown, int node) {
    const render::Model& standing = model.figure.model;
    const render::JointTree& tree = model.avatar->rig->tree;
    std::vector<glm::vec3> places;
    for (std::size_t i = 0; i < standing.nodes.size(); ++i) {
        const int one = static_cast<int>(i);
        const int joint = tree.joint_of(one);
        const bool is_in = node < 0 || one == node || render::is_below(standing, one, node);
        if (is_in && joint >= 0) {
            places.emplace_back(shown.state.joints.world[static_cast<std::size_t>(joint)][3]);
        }
    }
    return places;
}

}  // namespace raks::apps
