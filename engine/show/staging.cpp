#include "engine/show/staging.hpp"

#include <algorithm>
#include <cmath>

#include "motion/skeleton/skeleton.hpp"

#include <glm/common.hpp>

namespace raks::engine {
namespace {

render::Camera between(const render::Camera& from, const render::Camera& to, float share) noexcept {
    render::Camera camera = from;
    camera.orbit(share * std::remainder(to.yaw - from.yaw, 2.0F * 3.14159265F),
                 share * (to.pitch - from.pitch));
    camera.distance = glm::mix(from.distance, to.distance, share);
    camera.target = glm::mix(from.target, to.target, share);
    camera.vertical_fov = glm::mix(from.vertical_fov, to.vertical_fov, share);
    return camera;
}

}  // namespace

void Staging::set_picture(float aspect, float size) noexcept {
    aspect_ = aspect;
    size_ = size;
    director_.set_picture(aspect, size);
}

void Staging::advance(const MusicState& music, std::span<const motion::PoseTrack> tracks) {
    bodies_.clear();
    for (const motion::PoseTrack& track : tracks) {
        bodies_.push_back(
            motion::world_pose(motion::mannequin_skeleton(), track.at_hop(music.hop)));
    }
    if (!last_hop_ || music.hop != *last_hop_ + 1) {
        first_hop_ = music.hop;
    }
    last_hop_ = music.hop;
    cues_[static_cast<std::size_t>(music.hop) % kKept] = {
        music.hop, director_.advance(music, bodies_), light_.advance(music)};
}

const Staging::Cue& Staging::cue_of(HopIndex hop) const noexcept {
    const HopIndex oldest = std::max(*first_hop_, *last_hop_ - static_cast<HopIndex>(kKept) + 1);
    const HopIndex known = std::clamp(hop, oldest, *last_hop_);
    return cues_[static_cast<std::size_t>(known) % kKept];
}

Staging::Cue Staging::at(StreamTime time) const noexcept {
    if (!last_hop_) {
        return {};
    }
    const double hops = to_seconds(time) / to_seconds(kHop);
    const double whole = std::floor(hops);
    const auto hop = static_cast<HopIndex>(whole);
    Cue cue = cue_of(hop);
    const Cue& next = cue_of(hop + 1);
    const auto share = static_cast<float>(hops - whole);
    cue.light = render::between(cue.light, next.light, share);
    if (next.view.cuts == cue.view.cuts) {
        cue.view.camera = between(cue.view.camera, next.view.camera, share);
    }
    return cue;
}

void Staging::set(render::Scene& scene,
                  const CameraChoice& choice,
                  const Moment& moment,
                  std::span<const motion::PoseTrack> tracks) {
    const Nanos since = moment.time - last_moment_;
    last_moment_ = moment.time;
    scene.light = at(moment.time).light;
    if (choice.is_held) {
        return;
    }
    const Cue cue = at(moment.time + moment.lead);
    if (choice.name == kDirector && cue.hop >= 0) {
        scene.camera = cue.view.camera;
        return;
    }
    if (!framing_ || !(framed_preset_ == choice.preset) || framed_aspect_ != aspect_ ||
        framed_size_ != size_) {
        framing_.emplace(choice.preset, aspect_, size_);
        framed_preset_ = choice.preset;
        framed_aspect_ = aspect_;
        framed_size_ = size_;
    }
    poses_.clear();
    for (const motion::PoseTrack& track : tracks) {
        motion::Pose pose = track.at(moment.time + moment.lead);
        pose.hips_position *= size_;
        poses_.push_back(pose);
    }
    scene.camera = framing_->follow(poses_, to_seconds(since));
}

}  // namespace raks::engine
