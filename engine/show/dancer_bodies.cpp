#include "engine/show/dancer_bodies.hpp"

#include <utility>

namespace raks::engine {

DancerBodies::DancerBodies(render::AvatarHandle handle,
                           std::shared_ptr<const render::Avatar> avatar,
                           motion::Skeleton made_for,
                           FaceHabits habits)
    : worn_{{handle, std::move(avatar)}}, made_for_(made_for), habits_(habits) {}

std::vector<DancerBodies::Worn> DancerBodies::wear(std::vector<Worn> worn) {
    // What springs and faces remember is of the avatar before.
    bodies_.clear();
    return std::exchange(worn_, std::move(worn));
}

render::Dancer DancerBodies::still(const motion::Pose& pose) const noexcept {
    const Worn& worn = worn_.front();
    return {.avatar = worn.handle,
            .pose = render::retargeted(pose, made_for_, *worn.avatar),
            .state = nullptr};
}

void DancerBodies::add_partner(render::AvatarHandle handle,
                               std::shared_ptr<const render::Avatar> avatar) {
    worn_.push_back({handle, std::move(avatar)});
    bodies_.clear();
}

/// The first of a couple leads.
const DancerBodies::Worn& DancerBodies::worn_by(std::size_t dancer,
                                                std::size_t count) const noexcept {
    const std::size_t turn = count == 2 ? 1 - dancer : dancer;
    return worn_[turn % worn_.size()];
}

/// Bodies are made anew when the number of dancers changes who wears what.
void DancerBodies::make_bodies(std::size_t count) {
    if (count != made_count_ && worn_.size() > 1) {
        bodies_.clear();
    }
    made_count_ = count;
    while (bodies_.size() < count && worn_by(bodies_.size(), count).avatar->rig != nullptr) {
        const render::AvatarRig& rig = *worn_by(bodies_.size(), count).avatar->rig;
        bodies_.push_back(std::make_unique<Body>(
            Body{render::RigState(rig), DancerFace(bodies_.size(), habits_)}));
    }
}

std::span<const render::Dancer> DancerBodies::at(const DancedMoment& danced,
                                                 const MusicState& music,
                                                 const render::Camera& camera) {
    make_bodies(danced.tracks.size());
    dancers_.clear();
    // All poses first: partners look at each other.
    const std::size_t count = danced.tracks.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Worn& worn = worn_by(i, count);
        const motion::Pose pose = danced.tracks[i].at(danced.moment + danced.lead);
        dancers_.push_back({.avatar = worn.handle,
                            .pose = render::retargeted(pose, made_for_, *worn.avatar),
                            .state = nullptr,
                            .outfit = static_cast<int>(count == 2 ? 1 - i : i)});
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
    const render::Avatar& avatar = *worn_by(dancer, dancers_.size()).avatar;
    const motion::Pose& pose = dancers_[dancer].pose;
    // A couple's two look at each other, all others at who watches.
    const bool is_couple = dancers_.size() == 2;
    const FaceMoment moment{
        .time = danced.moment,
        .level_dbfs = music.level_dbfs,
        .loudness_lufs = music.loudness_lufs,
        .gaze_target =
            is_couple ? head_place(avatar.skeleton, dancers_[1 - dancer].pose) : camera.position(),
        .head = danced.face ? HeadTurn{}
                            : head_turn_at(danced.tracks[dancer], danced.moment + danced.lead)};
    constexpr float kOwnBody = 1.0F;  // the pose is on this body already
    render::advance(
        *avatar.rig,
        danced.moment,
        kOwnBody,
        [&](StreamTime time) {
            return render::retargeted(
                danced.tracks[dancer].at(time + danced.lead), made_for_, avatar);
        },
        body.state);
    render::pose_avatar(
        *avatar.rig,
        pose,
        danced.face ? *danced.face : body.face.face_at(moment, avatar.skeleton, pose),
        kOwnBody,
        body.state);
    dancers_[dancer].state = &body.state;
}

}  // namespace raks::engine
