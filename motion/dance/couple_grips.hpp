// Couple grips: where the hands of a couple hold, and the arms that bring them there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/realtime.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// What a hand can hold of the partner: four pairs of palms, named by the lead's and the follow's
/// hand, and the two further places of the ballroom's closed frame.
enum class Grip : std::uint8_t {
    left_left,
    left_right,
    right_left,
    right_right,
    back,  ///< the lead's right palm at the follow's left shoulder blade
    arm,   ///< the follow's left palm on the lead's right upper arm
};
inline constexpr std::size_t kPalmPairs = 4;  ///< the first of Grip
inline constexpr std::size_t kGrips = 6;      ///< all of Grip

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

/// Brings the hands of a couple to one another.
///
/// Palms that are held meet half-way between where both dance, as far as both arms reach
/// comfortably; in the closed frame they meet at a fixed height beside the couple. Only arms, hands
/// and fingers move: an elbow keeps its side, a wrist turns by 60 degrees at most.
/// Threads: any, once it is made. Real-time: yes (some 6 microseconds for two poses).
class CoupleGrips {
 public:
    /// Of two bodies.
    CoupleGrips(const Skeleton& lead, const Skeleton& follow);

    /// How comfortably each grip can be held in these poses, [0, 1]: less where the arms would be
    /// stretched, sweep round a shoulder, or reach behind their owner's back.
    [[nodiscard]] GripWeights comfort(const WorldPose& lead,
                                      const WorldPose& follow) const noexcept RAKS_NONBLOCKING;

    /// Holds with these weights. `lead_world`, `follow_world`: of the two poses as they come.
    /// `is_closed`: left_right is that of the closed frame.
    void hold(const GripWeights& weights,
              bool is_closed,
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
    void reach(Hand& hand) const noexcept;
    [[nodiscard]] glm::vec3 frame_point(const Couple& couple) const noexcept;

    Body lead_;
    Body follow_;
    float shoulder_height_;  // standing, mean of both; metres
    Pose clasp_;             // fingers round another hand
    Pose rest_;              // a hand that lies on the partner
};

/// Turns heads and necks towards the partner by the share `look`, as far as necks turn; not towards
/// one who is behind. Threads: any. Real-time: yes.
void look_at_one_another(float look,
                         const WorldPose& lead_world,
                         const WorldPose& follow_world,
                         Pose& lead,
                         Pose& follow) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
