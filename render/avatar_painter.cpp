#include "render/avatar_painter.hpp"

#include <utility>

#include "render/avatar/avatar.hpp"

namespace raks::render {

AvatarPainter::AvatarPainter(const Avatar& avatar, const BodyPrograms& programs)
    : size_(size_of(avatar)),
      skeleton_(avatar.skeleton),
      pelvis_drop_(avatar.pelvis_drop),
      body_(avatar, programs) {}

motion::Pose AvatarPainter::own(const motion::Pose& pose) const noexcept {
    return retargeted(pose, motion::mannequin_skeleton(), skeleton_, pelvis_drop_);
}

Expected<void> AvatarPainter::add_surface(const Avatar& avatar, SurfacePrograms& programs) {
    if (avatar.rig == nullptr) {
        return {};
    }
    rig_ = avatar.rig;
    Expected<SurfacePainter> painter = SurfacePainter::create(avatar.surface, programs);
    if (!painter) {
        return fail(std::move(painter.error()));
    }
    surface_.emplace(std::move(*painter));
    return {};
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
    if (is_surface(view)) {
        surface_->set_joints(number, states_.back()->joints.world);
    } else {
        body_.set_pose(number, dancer.pose, view);
    }
    return number;
}

/// The vertices of faces are one set for all dancers of an avatar.
void AvatarPainter::prepare(std::size_t number) { surface_->set_face(states_[number]->face); }

void AvatarPainter::draw_solid(std::size_t number, const Scene& scene, BodyPainter::Image image) {
    if (is_surface(view_)) {
        prepare(number);
        surface_->draw(number,
                       SurfacePainter::Layer::solid,
                       image == BodyPainter::Image::upright ? 1.0F : -1.0F,
                       scene.seconds);
    } else {
        body_.draw(number, scene.theme->dress, image);
    }
}

void AvatarPainter::draw_blended(std::size_t number, const Scene& scene) {
    if (is_surface(view_)) {
        prepare(number);
        surface_->draw(number, SurfacePainter::Layer::blended, 1.0F, scene.seconds);
    }
}

void AvatarPainter::draw_depth(std::size_t number, const glm::mat4& clip_from_light) {
    if (is_surface(view_)) {
        prepare(number);
        surface_->draw_depth(number, clip_from_light);
    } else {
        body_.draw_depth(number, clip_from_light);
    }
}

}  // namespace raks::render
