#include "motion/dance/hand_hold.hpp"

#include <algorithm>

namespace raks::motion {
namespace {

constexpr float kStage = 0.08F;  // seconds; time constant of each stage of the filter
constexpr float kStep = static_cast<float>(to_seconds(kHop)) / kStage;
// The filter's delay is made up for, in part, by looking ahead in the figure; seconds.
constexpr double kLookAhead = 0.2;
// Shares of the way that heads turn to the partner. In the closed frame each looks past the other's
// shoulder, so that they see one another now and then.
constexpr float kLook = 0.7F;
constexpr float kClosedLook = 0.3F;
constexpr float kLookStep = 0.03F;  // a hop; reached within half a second or so

/// What the figure wants held at a moment, [0, 1].
GripWeights wanted_at(const HoldMoment& moment, double seconds) noexcept {
    GripWeights wanted{};
    if (moment.hold == CoupleHold::closed) {
        wanted[index_of(Grip::left_right)] = 1.0F;
        wanted[index_of(Grip::back)] = wanted[index_of(Grip::arm)] = 1.0F;
    } else if (moment.hold == CoupleHold::hands) {
        // Beyond its end what it ends with goes on: the next figure is not known here.
        const double last = moment.beats - 1e-6;
        const double beat = std::clamp(
            moment.beat + moment.rate * (seconds + kLookAhead), 0.0, std::max(last, 0.0));
        for (const HeldHands& held : moment.holds) {
            if (beat >= held.from && beat < held.to) {
                wanted[index_of(palms(held.lead, held.follow))] = 1.0F;
            }
        }
    }
    return wanted;
}

}  // namespace

void HandHold::prepare(const Skeleton& lead, const Skeleton& follow) {
    lead_ = lead;
    follow_ = follow;
    grips_ = CoupleGrips(lead, follow);
    reset();
}

void HandHold::reset() noexcept RAKS_NONBLOCKING {
    stages_ = Stages{};
    look_ = 0.0F;
    is_closed_ = false;
    newest_ = -1;
}

void HandHold::go_on_from(const HandHold& before) noexcept RAKS_NONBLOCKING {
    stages_ = before.stages_;
    look_ = before.look_;
    is_closed_ = before.is_closed_;
    newest_ = before.newest_;
}

GripWeights HandHold::held() const noexcept RAKS_NONBLOCKING { return stages_.back(); }

void HandHold::advance(const HoldMoment& moment,
                       PoseTrack& lead,
                       PoseTrack& follow) noexcept RAKS_NONBLOCKING {
    const HopIndex now = lead.newest_final();
    if (newest_ >= 0 && now != newest_ + 1) {
        reset();  // after a gap the grips belong to another moment
    }
    newest_ = now;
    if (moment.hold != CoupleHold::none) {
        is_closed_ = moment.hold == CoupleHold::closed;
    }
    const bool stands = moment.hold == CoupleHold::none && moment.rate <= 0.0;
    const float look = stands ? 0.0F : moment.hold == CoupleHold::closed ? kClosedLook : kLook;
    look_ += kLookStep * (look - look_);
    Stages stages = stages_;
    const HopIndex last = std::min(lead.newest(), follow.newest());
    // What becomes uncomfortable within the predicted time is let go now: the filter is as slow.
    const GripWeights coming = grips_.comfort(world_body(lead_, lead.at_hop(last)),
                                              world_body(follow_, follow.at_hop(last)));
    for (HopIndex hop = now; hop <= last; ++hop) {
        Pose one = lead.at_hop(hop);
        Pose two = follow.at_hop(hop);
        const WorldPose lead_world = world_body(lead_, one);
        const WorldPose follow_world = world_body(follow_, two);
        const GripWeights wanted = wanted_at(moment, to_seconds((hop - now) * kHop));
        const GripWeights comfort = grips_.comfort(lead_world, follow_world);
        for (std::size_t grip = 0; grip < kGrips; ++grip) {
            float input = wanted[grip] * std::min(comfort[grip], coming[grip]);
            for (GripWeights& stage : stages) {
                stage[grip] += kStep * (input - stage[grip]);
                input = stage[grip];
            }
        }
        if (hop == now) {
            stages_ = stages;
        }
        grips_.hold(stages.back(), is_closed_, lead_world, follow_world, one, two);
        look_at_one_another(look_, lead_world, follow_world, one, two);
        lead.replace(hop, one);
        follow.replace(hop, two);
    }
}

}  // namespace raks::motion
