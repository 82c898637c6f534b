#include "engine/show/dancer_bodies.hpp"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

namespace raks::engine {
namespace {

float largest_of(const DancerBodies::Wardrobe& wardrobe) noexcept {
    float largest = 0.0F;
    for (const DancerBodies::Builds& builds : wardrobe) {
        largest = std::max(largest, render::size_of(*builds.front().avatar));
    }
    return largest;
}

std::vector<motion::Skeleton> dance_bodies_of(const DancerBodies::Wardrobe& wardrobe) {
    std::vector<motion::Skeleton> bodies;
    for (const DancerBodies::Builds& builds : wardrobe) {
        bodies.push_back(render::dance_body(*builds.front().avatar));
    }
    return bodies;
}

/// Two who have one place between them.
bool is_couple(const DancedMoment& danced) noexcept {
    return danced.tracks.size() == 2 &&
           (danced.places.size() < 2 || danced.places[0] == danced.places[1]);
}

glm::vec2 place_of(const DancedMoment& danced, std::size_t dancer) noexcept {
    return dancer < danced.places.size() ? danced.places[dancer] : glm::vec2(0.0F);
}

}  // namespace

DancerBodies::DancerBodies(Wardrobe wardrobe, motion::Skeleton made_for, FaceHabits habits)
    : wardrobe_(std::move(wardrobe)),
      dance_bodies_(dance_bodies_of(wardrobe_)),
      size_(largest_of(wardrobe_)),
      made_for_(made_for),
      habits_(habits) {}

DancerBodies::Wardrobe DancerBodies::wear(Wardrobe wardrobe) {
    // What springs and faces remember is of the avatar before.
    bodies_.clear();
    dance_bodies_ = dance_bodies_of(wardrobe);
    size_ = largest_of(wardrobe);
    return std::exchange(wardrobe_, std::move(wardrobe));
}

render::Dancer DancerBodies::still(const motion::Pose& pose) const noexcept {
    const Worn& worn = wardrobe_.front().front();
    return {.avatar = worn.handle,
            .pose = render::retargeted(pose, made_for_, *worn.avatar),
            .state = nullptr};
}

float DancerBodies::reach_of(std::span<const glm::vec2> places) const noexcept {
    float farthest = 0.0F;
    for (const glm::vec2& place : places) {
        farthest = std::max(farthest, glm::length(place));
    }
    return size_ * farthest;
}

/// The first of a couple leads.
const DancerBodies::Worn& DancerBodies::worn_by(std::size_t dancer) const noexcept {
    const Builds& builds = wardrobe_[dancer % wardrobe_.size()];
    const std::size_t turn = is_couple_ ? 1 - dancer : dancer / wardrobe_.size();
    return builds[turn % builds.size()];
}

/// The pose on the dancer's own body. Where sizes differ, each dances as large as it is about the
/// place that it has among the largest.
motion::Pose DancerBodies::worn_pose(std::size_t dancer,
                                     const motion::Pose& danced,
                                     glm::vec2 place) const noexcept {
    const render::Avatar& avatar = *worn_by(dancer).avatar;
    if (wardrobe_.size() == 1) {
        return render::retargeted(danced, made_for_, avatar);
    }
    const glm::vec3 from_middle(place.x, 0.0F, place.y);
    motion::Pose pose = danced;
    pose.hips_position -= from_middle;
    pose = render::retargeted(pose, made_for_, avatar);
    pose.hips_position += size_ * from_middle;
    return pose;
}

/// Bodies are made anew when the number of dancers changes who wears what.
void DancerBodies::make_bodies(const DancedMoment& danced) {
    const std::size_t count = danced.tracks.size();
    const bool was_couple = std::exchange(is_couple_, is_couple(danced));
    const bool differ = wardrobe_.size() > 1 || wardrobe_.front().size() > 1;
    if ((count != made_count_ || was_couple != is_couple_) && differ) {
        bodies_.clear();
    }
    made_count_ = count;
    bodies_.resize(std::min(bodies_.size(), count));
    while (bodies_.size() < count) {
        const render::AvatarRig* const rig = worn_by(bodies_.size()).avatar->rig.get();
        bodies_.push_back(rig == nullptr
                              ? nullptr
                              : std::make_unique<Body>(Body{render::RigState(*rig),
                                                            DancerFace(bodies_.size(), habits_)}));
    }
}

std::span<const render::Dancer> DancerBodies::at(const DancedMoment& danced,
                                                 const MusicState& music,
                                                 const render::Camera& camera) {
    make_bodies(danced);
    dancers_.clear();
    // All poses first: partners look at each other.
    for (std::size_t i = 0; i < danced.tracks.size(); ++i) {
        const motion::Pose pose = danced.tracks[i].at(danced.moment + danced.lead);
        dancers_.push_back({.avatar = worn_by(i).handle,
                            .pose = worn_pose(i, pose, place_of(danced, i)),
                            .state = nullptr,
                            .outfit = static_cast<int>(is_couple_ ? 1 - i : i)});
    }
    for (std::size_t i = 0; i < dancers_.size(); ++i) {
        if (bodies_[i] != nullptr) {
            move(i, danced, music, camera);
        }
    }
    return dancers_;
}

/// Whether a hand of a couple's dancer came to one of the other's within the last moments.
bool DancerBodies::have_hands_met(std::size_t dancer, StreamTime moment) noexcept {
    if (!is_couple_) {
        return false;
    }
    constexpr float kMeet = 0.14F;  // metres
    constexpr float kPart = 0.20F;
    constexpr double kLooked = 1.2;  // seconds
    const auto world_of = [&](std::size_t one) {
        return motion::world_pose(worn_by(one).avatar->skeleton, dancers_[one].pose);
    };
    const motion::WorldPose own = world_of(dancer);
    const motion::WorldPose other = world_of(1 - dancer);
    float nearest = 10.0F;
    for (const motion::Bone mine : {motion::Bone::left_hand, motion::Bone::right_hand}) {
        for (const motion::Bone theirs : {motion::Bone::left_hand, motion::Bone::right_hand}) {
            nearest = std::min(nearest, glm::distance(own.position(mine), other.position(theirs)));
        }
    }
    Body& body = *bodies_[dancer];
    if (!body.has_hands && nearest < kMeet) {
        body.hands_met = moment;
    }
    body.has_hands = nearest < (body.has_hands ? kPart : kMeet);
    return body.hands_met && to_seconds(moment - *body.hands_met) < kLooked;
}

void DancerBodies::move(std::size_t dancer,
                        const DancedMoment& danced,
                        const MusicState& music,
                        const render::Camera& camera) {
    Body& body = *bodies_[dancer];
    const render::Avatar& avatar = *worn_by(dancer).avatar;
    const motion::Pose& pose = dancers_[dancer].pose;
    const FaceMoment moment{
        .time = danced.moment,
        .level_dbfs = music.level_dbfs,
        .loudness_lufs = music.loudness_lufs,
        .gaze_target = camera.position(),
        .head = danced.face ? HeadTurn{}
                            : head_turn_at(danced.tracks[dancer], danced.moment + danced.lead),
        .feeling = danced.tracks[dancer].feeling_at(danced.moment + danced.lead),
        .partner = is_couple_ ? std::optional(head_place(worn_by(1 - dancer).avatar->skeleton,
                                                         dancers_[1 - dancer].pose))
                              : std::nullopt,
        .has_met = have_hands_met(dancer, danced.moment)};
    constexpr float kOwnBody = 1.0F;  // the pose is on this body already
    if (danced.move_others) {
        danced.move_others(pose, avatar.rig->tree, body.state.joints);
    }
    render::advance(
        *avatar.rig,
        danced.moment,
        kOwnBody,
        [&](StreamTime time) {
            return worn_pose(
                dancer, danced.tracks[dancer].at(time + danced.lead), place_of(danced, dancer));
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

DancerBodies::Wardrobe wardrobe_of(const Costumes& costumes, const DancerBodies::Builds& added) {
    DancerBodies::Wardrobe wardrobe;
    for (const std::vector<std::size_t>& builds : costumes.builds) {
        DancerBodies::Builds& worn = wardrobe.emplace_back();
        for (const std::size_t body : builds) {
            worn.push_back(added[body]);
        }
    }
    return wardrobe;
}

std::optional<DancerBodies::Worn> find_worn(const DancerBodies::Wardrobe& wardrobe,
                                            const std::shared_ptr<const render::Avatar>& body) {
    for (const DancerBodies::Builds& builds : wardrobe) {
        for (const DancerBodies::Worn& worn : builds) {
            if (worn.avatar == body) {
                return worn;
            }
        }
    }
    return std::nullopt;
}

std::vector<render::AvatarHandle> handles_of(const DancerBodies::Wardrobe& wardrobe) {
    std::vector<render::AvatarHandle> handles;
    for (const DancerBodies::Builds& builds : wardrobe) {
        for (const DancerBodies::Worn& worn : builds) {
            const bool is_known =
                std::any_of(handles.begin(), handles.end(), [&](render::AvatarHandle known) {
                    return known.number == worn.handle.number;
                });
            if (!is_known) {
                handles.push_back(worn.handle);
            }
        }
    }
    return handles;
}

}  // namespace raks::engine
