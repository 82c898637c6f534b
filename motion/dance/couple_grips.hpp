// Couple grips: where the hands of a couple hold, and the arms that bring them there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/realtime.hpp"
#include "motion/figures/couple_form.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// What a hand can hold of the partner: four pairs of palms, named by the lead's and the follow's
/// hand, and for each of the four hands the place of the partner that it lies on (LaidHand).
enum class Grip : std::uint8_t {
    left_left,
    left_right,
    right_left,
    right_right,
    lead_left,     ///< the lead's left hand lies on the follow
    lead_right,    ///< his right one
    follow_left,   ///< the follow's left hand lies on the lead
    follow_right,  ///< her right one
};
inline constexpr std::size_t kPalmPairs = 4;  ///< the first of Grip
inline constexpr std::size_t kGrips = 8;      ///< all of Grip

/// How firmly each is held, [0, 1]; by Grip.
using GripWeights = std::array<float, kGrips>;

/// Index into GripWeights.
[[nodiscard]] constexpr std::size_t index_of(Grip grip) noexcept {
    return static_cast<std::size_t>(grip);
}
/// The pair of these palms.
[[nodiscard]] constexpr Grip palms(Side lead, Side follow) noexcept {
    return static_cast<Grip>(2 * static_cast<int>(lead) + static_cast<int>(follow));
}

/// The grip of a hand that lies on the partner. `role`: 0 the lead's, 1 the follow's.
[[nodiscard]] constexpr Grip laid(std::size_t role, Side side) noexcept {
    return static_cast<Grip>(kPalmPairs + 2 * role + static_cast<std::size_t>(side));
}

/// Brings the hands of a couple to one another.
///
/// Palms that are held meet half-way between where both dance, as far as both arms reach
/// comfortably; in the closed frame they meet beside the couple, at the height of the follow's
/// eyes, and other hands lie on their contact points. Only arms, hands and fingers move: of a hand
/// that only holds another one the elbow keeps its side, a wrist turns by 60 degrees at most.
/// Threads: any, once it is made. Real-time: yes (some 6 microseconds for two poses).
class CoupleGrips {
 public:
    /// Of two bodies.
    CoupleGrips(const Skeleton& lead, const Skeleton& follow);

    /// How comfortably each grip can be held in these poses, [0, 1]: less where the arms would be
    /// stretched, sweep round a shoulder, or reach behind their owner's back. `frame`: of a closed
    /// hold, whose joined hands are clear of the shoulders wherever they dance; null: of others.
    [[nodiscard]] GripWeights comfort(const ClosedFrame* frame,
                                      const WorldPose& lead,
                                      const WorldPose& follow) const noexcept RAKS_NONBLOCKING;

    /// Holds with these weights. `lead_world`, `follow_world`: of the two poses as they come.
    /// `frame`: of a closed hold, whose left_right is the frame's; null: of others, where no hand
    /// lies on the partner.
    void hold(const GripWeights& weights,
              const ClosedFrame* frame,
              const WorldPose& lead_world,
              const WorldPose& follow_world,
              Pose& lead,
              Pose& follow) const noexcept RAKS_NONBLOCKING;

 private:
    /// A body, as far as its arms need to know.
    struct Body {
        Skeleton skeleton;
        float arm_length = 0.0F;  // shoulder to wrist

        explicit Body(const Skeleton& of);
    };
    struct Hand;
    struct Couple;
    struct Spot;
    void reach(Hand& hand) const noexcept;
    void join(const GripWeights& weights, const ClosedFrame* frame, Couple& couple) const noexcept;
    [[nodiscard]] glm::vec3 frame_point(const ClosedFrame& frame,
                                        const Couple& couple) const noexcept;

    Body lead_;
    Body follow_;
    Pose clasp_;  // fingers round another hand
    Pose rest_;   // a hand that lies on the partner
};

/// Where a couple's heads turn to.
struct CoupleLook {
    float share = 0.0F;                  ///< [0, 1] of the way
    const ClosedFrame* frame = nullptr;  ///< past one another, as it says; null: at one another
};

/// Turns heads and necks towards the partner, as far as necks turn, but not towards one who is
/// behind; or as the frame of a closed hold has them. Threads: any. Real-time: yes.
void look_at_one_another(const CoupleLook& look,
                         const WorldPose& lead_world,
                         const WorldPose& follow_world,
                         Pose& lead,
                         Pose& follow) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
