#include "render/avatar_painter.hpp"

#include <utility>

#include "render/avatar/avatar.hpp"

namespace raks::render {

AvatarPainter::AvatarPainter(const Avatar& avatar, const BodyPrograms& programs)
    : size_(size_of(avatar)), skeleton_(avatar.skeleton), body_(avatar, programs) {}

Expected<void> AvatarPainter::add_surface(const Surface& surface, SurfacePrograms& programs) {
    if (surface.parts.empty()) {
        return {};
    }
    Expected<SurfacePainter> painter = SurfacePainter::create(surface, programs);
    if (!painter) {
        return fail(std::move(painter.error()));
    }
    surface_.emplace(std::move(*painter));
    return {};
}

std::size_t AvatarPainter::take(const Dancer& dancer, View view) {
    const std::size_t number = states_.size();
    view_ = view;
    states_.push_back(dancer.state);
    if (is_surface(view)) {
        surface_->set_joints(number, dancer.state->joints.world);
    } else {
        body_.set_pose(number, dancer.pose, view);
    }
    return number;
}

/// The vertices of faces are one set for all dancers of an avatar.
void AvatarPainter::prepare(std::size_t number) {
    surface_->set_face(states_[number]->face);
}

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
