// Hand hold: the joined hands of a couple.
#pragma once

#include <array>
#include <span>

#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/dance/couple_grips.hpp"
#include "motion/dance/partner_clearance.hpp"
#include "motion/dance/partner_place.hpp"
#include "motion/figures/couple_form.hpp"
#include "motion/skeleton/pose_track.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// What a couple dances at a hop, as far as its hands need to know.
struct HoldMoment {
    CoupleHold hold = CoupleHold::none;  ///< none also while it stands
    ClosedFrame frame{};                 ///< of a closed hold
    std::span<const HeldHands> holds;    ///< of the figure
    double beat = 0.0;                   ///< of the figure
    double beats = 0.0;                  ///< length of the figure
    double rate = 0.0;                   ///< beats a second; 0 while it stands
};

/// The hold of a couple over time: hands are taken, held and let go as the figures say, where the
/// arms reach comfortably. How firmly each grip is held follows that through a low-pass filter of
/// the fourth order (0.3 s), so that a hand is reached for and released without a jerk: an arm
/// released at the 5 m/s with which a turn sweeps it away would be thrown (10,000 m/s^3). Predicted
/// poses are filtered on from the last final one. In a closed hold the follow dances where it has
/// her. Whatever is held, hands and forearms keep off the partner's trunk, head and upper arms.
/// Threads: one owner. Real-time: yes.
class HandHold {
 public:
    HandHold() = default;
    /// Of two bodies, as they are shown (Skeleton::shown_size). Real-time: no.
    void prepare(const Skeleton& lead, const Skeleton& follow);
    /// Lets go of everything.
    void reset() noexcept RAKS_NONBLOCKING;
    /// Goes on with the grips of another couple.
    void go_on_from(const HandHold& before) noexcept RAKS_NONBLOCKING;

    /// One hop: brings the follow to her place, joins the hands in the newest final poses and in
    /// all predicted ones, turns the heads to the partner, and keeps arms off the partner's body.
    void advance(const HoldMoment& moment,
                 PoseTrack& lead,
                 PoseTrack& follow) noexcept RAKS_NONBLOCKING;

    /// How firmly each grip was held in the newest final pose, [0, 1].
    [[nodiscard]] GripWeights held() const noexcept RAKS_NONBLOCKING;

 private:
    static constexpr std::size_t kOrder = 4;
    using Stages = std::array<GripWeights, kOrder>;

    struct Two;
    [[nodiscard]] Two shown(const PoseTrack& lead,
                            const PoseTrack& follow,
                            HopIndex hop) const noexcept;
    [[nodiscard]] std::array<ArmWays, 2> ways_apart(const GripWeights& held,
                                                    const Two& two) const noexcept;
    void turn_knees(Two& two) const noexcept;
    /// By hop from the newest final one.
    using WantedWays = std::array<std::array<ArmWays, 2>, PoseTrack::kPredictedPoses + 1>;
    void keep_off(const WantedWays& wanted,
                  HopIndex last,
                  PoseTrack& lead,
                  PoseTrack& follow) noexcept;
    using WayStages = std::array<std::array<ArmWays, 2>, kOrder>;  // of lead and follow

    CoupleGrips grips_{mannequin_skeleton(), mannequin_skeleton()};
    // As they are shown.
    Skeleton lead_;
    Skeleton follow_;
    CoupleSizes sizes_;
    Stages stages_{};     // of the filter, at newest_
    WayStages ways_{};    // likewise: how far arms are moved off the partner
    PartnerPlace place_;  // likewise
    float look_ = 0.0F;   // likewise: how much they look at one another
    bool is_closed_ = false;
    ClosedFrame frame_;     // of the last closed hold
    HopIndex newest_ = -1;  // latest hop
};

}  // namespace raks::motion
