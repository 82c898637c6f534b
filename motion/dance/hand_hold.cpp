#include "motion/dance/hand_hold.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr float kStage = 0.08F;  // seconds; time constant of each stage of the filter
constexpr float kStep = static_cast<float>(to_seconds(kHop)) / kStage;
// The filter's delay is made up for, in part, by looking ahead in the figure; seconds.
constexpr double kLookAhead = 0.2;
// Shares of the way that heads turn to the partner, and of that past the other's shoulder.
constexpr float kLook = 0.7F;
constexpr float kClosedLook = 0.8F;
// Hops ahead at which the follow's place is looked up: as late as it is filtered.
constexpr HopIndex kPlaceAhead = 18;
// Share of what their knees must go aside that each of the two does at once.
constexpr float kKneeShare = 0.7F;
constexpr int kKneeRounds = 2;
constexpr float kClose = 0.6F;  // metres between hips within which knees may meet
// Seconds; time constant of each stage of the filter of the ways of arms, and hops ahead among
// which the longest way is taken, so that a hand is out of the way in time.
constexpr float kWayStage = 0.03F;
constexpr float kWayStep = static_cast<float>(to_seconds(kHop)) / kWayStage;
constexpr HopIndex kWaysAhead = 16;

void keep_longer(const ArmWays& one, ArmWays& longest) noexcept {
    for (std::size_t side = 0; side < one.size(); ++side) {
        if (glm::length(one[side].wrist) > glm::length(longest[side].wrist)) {
            longest[side].wrist = one[side].wrist;
        }
        if (glm::length(one[side].elbow) > glm::length(longest[side].elbow)) {
            longest[side].elbow = one[side].elbow;
        }
    }
}
constexpr float kLookStep = 0.03F;  // a hop; reached within half a second or so

/// What the figure wants held at a moment, [0, 1].
GripWeights wanted_at(const HoldMoment& moment, double seconds) noexcept {
    GripWeights wanted{};
    if (moment.hold == CoupleHold::closed) {
        wanted[index_of(Grip::left_right)] = 1.0F;
        for (std::size_t role = 0; role < moment.frame.laid.size(); ++role) {
            for (const Side side : kSides) {
                const bool lies =
                    moment.frame.laid[role][static_cast<std::size_t>(side)].has_value();
                wanted[index_of(laid(role, side))] = lies ? 1.0F : 0.0F;
            }
        }
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

/// Both as they are shown.
struct HandHold::Two {
    Pose lead;
    Pose follow;
};

void HandHold::prepare(const Skeleton& lead, const Skeleton& follow) {
    lead_ = scaled(lead, lead.shown_size);
    follow_ = scaled(follow, follow.shown_size);
    sizes_ = {lead.shown_size, follow.shown_size};
    grips_ = CoupleGrips(lead_, follow_);
    reset();
}

void HandHold::reset() noexcept RAKS_NONBLOCKING {
    stages_ = Stages{};
    ways_ = WayStages{};
    place_ = PartnerPlace();
    look_ = 0.0F;
    is_closed_ = false;
    newest_ = -1;
}

void HandHold::go_on_from(const HandHold& before) noexcept RAKS_NONBLOCKING {
    stages_ = before.stages_;
    ways_ = before.ways_;
    place_ = before.place_;
    look_ = before.look_;
    is_closed_ = before.is_closed_;
    frame_ = before.frame_;
    newest_ = before.newest_;
}

GripWeights HandHold::held() const noexcept RAKS_NONBLOCKING { return stages_.back(); }

HandHold::Two HandHold::shown(const PoseTrack& lead,
                              const PoseTrack& follow,
                              HopIndex hop) const noexcept {
    Two two{lead.at_hop(hop), follow.at_hop(hop)};
    two.lead.hips_position *= sizes_.lead;
    two.follow.hips_position *= sizes_.follow;
    return two;
}

std::array<ArmWays, 2> HandHold::ways_apart(const GripWeights& held,
                                            const Two& two) const noexcept {
    const auto lying = [&](std::size_t role) {
        return std::array<float, 2>{held[index_of(laid(role, Side::left))],
                                    held[index_of(laid(role, Side::right))]};
    };
    const PartnerBody follow(follow_.girth, world_body(follow_, two.follow));
    const PartnerBody lead(lead_.girth, world_body(lead_, two.lead));
    return {follow.ways_off(lead_, lying(0), two.lead),
            lead.ways_off(follow_, lying(1), two.follow)};
}

void HandHold::turn_knees(Two& two) const noexcept {
    // Whose knees go aside first leaves the other one less to do, but may meet the other leg.
    for (int round = 0; round < kKneeRounds; ++round) {
        if (glm::distance(two.lead.hips_position, two.follow.hips_position) > kClose) {
            return;
        }
        const WorldPose follow = world_body(follow_, two.follow);
        const WorldPose lead = world_body(lead_, two.lead);
        PartnerBody(follow_.girth, follow).turn_knees(lead_, lead, kKneeShare, two.lead);
        PartnerBody(lead_.girth, lead).turn_knees(follow_, follow, kKneeShare, two.follow);
    }
}

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
        frame_ = moment.frame;
    }
    const ClosedFrame* const frame = is_closed_ ? &frame_ : nullptr;
    const ClosedFrame* const danced = moment.hold == CoupleHold::closed ? &frame_ : nullptr;
    const bool stands = moment.hold == CoupleHold::none && moment.rate <= 0.0;
    const float look = stands ? 0.0F : danced != nullptr ? kClosedLook : kLook;
    look_ += kLookStep * (look - look_);
    Stages stages = stages_;
    PartnerPlace place = place_;
    WantedWays wanted_ways{};
    const HopIndex last = std::min(lead.newest(), follow.newest());
    // What becomes uncomfortable within the predicted time is let go now: the filter is as slow.
    const Two at_last = shown(lead, follow, last);
    const GripWeights coming =
        grips_.comfort(frame, world_body(lead_, at_last.lead), world_body(follow_, at_last.follow));
    for (HopIndex hop = now; hop <= last; ++hop) {
        const Two ahead = shown(lead, follow, std::min(hop + kPlaceAhead, last));
        Two two = shown(lead, follow, hop);
        place.advance(missing_way(danced, sizes_, ahead.lead, ahead.follow), two.follow);
        place.apply(follow_, two.follow);
        const WorldPose lead_world = world_body(lead_, two.lead);
        const WorldPose follow_world = world_body(follow_, two.follow);
        const GripWeights wanted = wanted_at(moment, to_seconds((hop - now) * kHop));
        const GripWeights comfort = grips_.comfort(frame, lead_world, follow_world);
        for (std::size_t grip = 0; grip < kGrips; ++grip) {
            float input = wanted[grip] * std::min(comfort[grip], coming[grip]);
            for (GripWeights& stage : stages) {
                stage[grip] += kStep * (input - stage[grip]);
                input = stage[grip];
            }
        }
        if (hop == now) {
            stages_ = stages;
            place_ = place;
        }
        grips_.hold(stages.back(), frame, lead_world, follow_world, two.lead, two.follow);
        look_at_one_another({look_, danced}, lead_world, follow_world, two.lead, two.follow);
        turn_knees(two);
        wanted_ways[static_cast<std::size_t>(hop - now)] = ways_apart(stages.back(), two);
        two.lead.hips_position /= sizes_.lead;
        two.follow.hips_position /= sizes_.follow;
        lead.replace(hop, two.lead);
        follow.replace(hop, two.follow);
    }
    keep_off(wanted_ways, last, lead, follow);
}

void HandHold::keep_off(const WantedWays& wanted,
                        HopIndex last,
                        PoseTrack& lead,
                        PoseTrack& follow) noexcept {
    WayStages stages = ways_;
    for (HopIndex hop = newest_; hop <= last; ++hop) {
        const HopIndex first = hop - newest_;
        std::array<ArmWays, 2> input = wanted[static_cast<std::size_t>(first)];
        for (HopIndex ahead = first; ahead <= std::min(first + kWaysAhead, last - newest_);
             ++ahead) {
            keep_longer(wanted[static_cast<std::size_t>(ahead)][0], input[0]);
            keep_longer(wanted[static_cast<std::size_t>(ahead)][1], input[1]);
        }
        for (std::array<ArmWays, 2>& stage : stages) {
            for (std::size_t role = 0; role < stage.size(); ++role) {
                for (std::size_t side = 0; side < stage[role].size(); ++side) {
                    ArmWay& way = stage[role][side];
                    way.wrist += kWayStep * (input[role][side].wrist - way.wrist);
                    way.elbow += kWayStep * (input[role][side].elbow - way.elbow);
                }
            }
            input = stage;
        }
        if (hop == newest_) {
            ways_ = stages;
        }
        Two two = shown(lead, follow, hop);
        move_arms(lead_, input[0], two.lead);
        move_arms(follow_, input[1], two.follow);
        two.lead.hips_position /= sizes_.lead;
        two.follow.hips_position /= sizes_.follow;
        lead.replace(hop, two.lead);
        follow.replace(hop, two.follow);
    }
}

}  // namespace raks::motion
