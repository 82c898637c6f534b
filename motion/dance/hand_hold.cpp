#include "motion/dance/hand_hold.hpp"

#include <algorithm>

#include "motion/dance/partner_clearance.hpp"

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
constexpr float kClose = 0.6F;      // metres between hips within which knees are looked at again
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
    place_ = PartnerPlace();
    look_ = 0.0F;
    is_closed_ = false;
    newest_ = -1;
}

void HandHold::go_on_from(const HandHold& before) noexcept RAKS_NONBLOCKING {
    stages_ = before.stages_;
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

void HandHold::keep_apart(const GripWeights& held, Two& two) const noexcept {
    const auto lying = [&](std::size_t role) {
        return std::array<float, 2>{held[index_of(laid(role, Side::left))],
                                    held[index_of(laid(role, Side::right))]};
    };
    const WorldPose follow_world = world_body(follow_, two.follow);
    const PartnerBody follow(follow_.girth, follow_world);
    follow.keep_off(lead_, lying(0), two.lead);
    const WorldPose lead_world = world_body(lead_, two.lead);
    const PartnerBody lead(lead_.girth, lead_world);
    lead.keep_off(follow_, lying(1), two.follow);
    // Whose knees go aside first leaves the other one less to do, but may meet the other leg.
    follow.turn_knees(lead_, lead_world, kKneeShare, two.lead);
    lead.turn_knees(follow_, follow_world, kKneeShare, two.follow);
    const bool is_close = glm::distance(two.lead.hips_position, two.follow.hips_position) < kClose;
    if (is_close) {
        const WorldPose now = world_body(follow_, two.follow);
        const WorldPose own = world_body(lead_, two.lead);
        PartnerBody(follow_.girth, now).turn_knees(lead_, own, kKneeShare, two.lead);
        PartnerBody(lead_.girth, own).turn_knees(follow_, now, kKneeShare, two.follow);
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
        keep_apart(stages.back(), two);
        two.lead.hips_position /= sizes_.lead;
        two.follow.hips_position /= sizes_.follow;
        lead.replace(hop, two.lead);
        follow.replace(hop, two.follow);
    }
}

}  // namespace raks::motion
