#include "render/avatar_painter.hpp"

#include <utility>

#include "render/avatar/avatar.hpp"

namespace raks::render {
namespace {

/// A plain mannequin wears nothing.
bool has_costume(const Scene& scene) noexcept { return scene.dress == Dress::dancer; }

}  // namespace

AvatarPainter::AvatarPainter(const Avatar& avatar, const BodyPrograms& programs)
    : size_(size_of(avatar)),
      style_(avatar.style),
      has_skin_(!avatar.vertices.empty()),
      skeleton_(avatar.skeleton),
      pelvis_drop_(avatar.pelvis_drop),
      body_(avatar, programs) {}

motion::Pose AvatarPainter::own(const motion::Pose& pose) const noexcept {
    return retargeted(pose, motion::mannequin_skeleton(), skeleton_, pelvis_drop_);
}

void AvatarPainter::set_surface(LoadedSurface surface, std::shared_ptr<const AvatarRig> rig) {
    surface_.emplace(std::move(surface));
    rig_ = std::move(rig);
}

bool AvatarPainter::warm_up(std::size_t step) {
    if (!surface_) {
        return false;
    }
    if (step == 0) {
        begin_picture();
        take({.avatar = {}, .pose = {}, .state = nullptr}, View::skin);
        prepare(0);
    }
    return surface_->warm_up(step);
}

/// What a dancer brings, or the pose alone with face and tails at rest.
const RigState* AvatarPainter::state_of(const Dancer& dancer) {
    if (dancer.state != nullptr || rig_ == nullptr) {
        return dancer.state;
    }
    const std::size_t number = states_.size();
    while (own_states_.size() <= number) {
        own_states_.push_back(std::make_unique<RigState>(*rig_));
    }
    RigState& state = *own_states_[number];
    pose_avatar(*rig_, dancer.pose, {}, 1.0F, state);
    return &state;
}

std::size_t AvatarPainter::take(const Dancer& dancer, View view) {
    const std::size_t number = states_.size();
    view_ = view;
    states_.push_back(state_of(dancer));
    if (shows_surface()) {
        surface_->set_joints(number, states_.back()->joints.world);
    }
    if (shows_body()) {
        body_.set_pose(number, dancer.pose, view);
    }
    return number;
}

/// The vertices of faces are one set for all dancers of an avatar.
void AvatarPainter::prepare(std::size_t number) { surface_->set_face(states_[number]->face); }

void AvatarPainter::draw_solid(std::size_t number, const Scene& scene, BodyPainter::Image image) {
    if (shows_surface()) {
        prepare(number);
        surface_->draw(number,
                       {.layer = SurfaceLayer::solid,
                        .mirror = image == BodyPainter::Image::upright ? 1.0F : -1.0F,
                        .seconds = scene.seconds,
                        .has_costume = has_costume(scene)});
    }
    if (shows_body()) {
        body_.draw(number, scene.dress, image);
    }
}

void AvatarPainter::draw_blended(std::size_t number, const Scene& scene) {
    if (shows_surface()) {
        prepare(number);
        surface_->draw(number,
                       {.layer = SurfaceLayer::blended,
                        .mirror = 1.0F,
                        .seconds = scene.seconds,
                        .has_costume = has_costume(scene)});
    }
}

void AvatarPainter::draw_depth(std::size_t number,
                               const Scene& scene,
                               const glm::mat4& clip_from_light) {
    if (shows_surface()) {
        prepare(number);
        surface_->draw_depth(number, clip_from_light, has_costume(scene));
    }
    if (shows_body()) {
        body_.draw_depth(number, clip_from_light);
    }
}

}  // namespace raks::render
