#include "render/avatar_arrival.hpp"

namespace raks::render {

AvatarArrival::AvatarArrival(std::shared_ptr<const Avatar> avatar,
                             const BodyPrograms& body_programs,
                             SurfacePrograms& surface_programs)
    : avatar_(std::move(avatar)),
      painter_(std::make_unique<AvatarPainter>(*avatar_, body_programs)) {
    if (avatar_->rig != nullptr) {
        upload_.emplace(avatar_->surface, surface_programs);
    }
}

Expected<bool> AvatarArrival::next() {
    if (!upload_) {
        return true;
    }
    Expected<bool> is_done = upload_->next();
    if (is_done && *is_done) {
        painter_->set_surface(std::move(*upload_).finished(), avatar_->rig);
        upload_.reset();
    }
    return is_done;
}

void AvatarArrival::warm_up() {
    if (!upload_) {
        is_warm_ = !painter_->warm_up(warmed_up_++);
    }
}

}  // namespace raks::render
