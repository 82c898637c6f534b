#include "engine/show/dancer_bodies.hpp"

#include <utility>

namespace raks::engine {

DancerBodies::DancerBodies(render::AvatarHandle handle,
                           std::shared_ptr<const render::Avatar> avatar,
                           motion::Skeleton made_for)
    : handle_(handle), avatar_(std::move(avatar)), made_for_(made_for) {}

void DancerBodies::make_bodies(std::size_t count) {
    while (avatar_->rig != nullptr && bodies_.size() < count) {
        bodies_.push_back(std::make_unique<Body>(
            Body{render::RigState(*avatar_->rig), DancerFace(bodies_.size())}));
    }
}

std::span<const render::Dancer> DancerBodies::at(const DancedMoment& danced,
                                                 const MusicState& music,
                                                 const render::Camera& camera) {
    make_bodies(danced.tracks.size());
    dancers_.clear();
    // All poses first: partners look at each other.
    for (const motion::PoseTrack& track : danced.tracks) {
        dancers_.push_back(
            {.avatar = handle_,
             .pose = render::retargeted(track.at(danced.moment + danced.lead), made_for_, *avatar_),
             .state = nullptr});
    }
    for (std::size_t i = 0; i < bodies_.size() && i < dancers_.size(); ++i) {
        move(i, danced, music, camera);
    }
    return dancers_;
}

void DancerBodies::move(std::size_t dancer,
                        const DancedMoment& danced,
                        const MusicState& music,
                        const render::Camera& camera) {
    Body& body = *bodies_[dancer];
    const motion::Pose& pose = dancers_[dancer].pose;
    // A couple's two look at each other, all others at who watches.
    const bool is_couple = dancers_.size() == 2;
    const FaceMoment moment{
        .time = danced.moment,
        .level_dbfs = music.level_dbfs,
        .loudness_lufs = music.loudness_lufs,
        .gaze_target = is_couple ? head_place(avatar_->skeleton, dancers_[1 - dancer].pose)
                                 : camera.position()};
    constexpr float kOwnBody = 1.0F;  // the pose is on this body already
    render::advance(
        *avatar_->rig,
        danced.moment,
        kOwnBody,
        [&](StreamTime time) {
            return render::retargeted(
                danced.tracks[dancer].at(time + danced.lead), made_for_, *avatar_);
        },
        body.state);
    render::pose_avatar(
        *avatar_->rig,
        pose,
        danced.face ? *danced.face : body.face.face_at(moment, avatar_->skeleton, pose),
        kOwnBody,
        body.state);
    dancers_[dancer].state = &body.state;
}

}  // namespace raks::engine
