// Couple form: how two dance a dance together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "motion/skeleton/humanoid.hpp"

#include <glm/vec2.hpp>

namespace raks::motion {

/// How a couple holds one another.
enum class CoupleHold : std::uint8_t {
    none,    ///< not at all
    hands,   ///< by the hands, as each figure says (HeldHands)
    closed,  ///< the ballroom's frame: her right hand in his left one, and hands that lie on the
             ///< partner (ClosedFrame)
};
/// Names in files, by CoupleHold.
inline constexpr std::array<std::string_view, 3> kCoupleHoldNames = {"none", "hands", "closed"};

/// Where a hand can lie on the partner.
enum class HoldPlace : std::uint8_t {
    shoulder_blade,  ///< on the back
    upper_arm,       ///< on its outside, half-way to the elbow
    shoulder,        ///< on its top
    waist,           ///< at the flank, over the hip
};
/// Names in files, by HoldPlace.
inline constexpr std::array<std::string_view, 4> kHoldPlaceNames = {
    "shoulder_blade", "upper_arm", "shoulder", "waist"};

/// A contact point: what the palm of a hand lies on.
struct LaidHand {
    HoldPlace on = HoldPlace::shoulder_blade;  ///< of the partner
    Side side = Side::left;                    ///< which one, the partner's left or right
};

/// The frame of a closed hold.
struct ClosedFrame {
    /// By role (lead, follow) and Side: what that hand lies on, if anything. The lead's left and
    /// the follow's right one are joined.
    std::array<std::array<std::optional<LaidHand>, 2>, 2> laid{{
        {{std::nullopt, LaidHand{HoldPlace::shoulder_blade, Side::left}}},
        {{LaidHand{HoldPlace::upper_arm, Side::right}, std::nullopt}},
    }};
    /// The follow's hips seen from the lead's while they dance: left, forward; metres. None: where
    /// the figures have them.
    std::optional<glm::dvec2> hips;
    double clasp = 1.0;  ///< height of the joined hands, of that of the follow's eyes
    /// Radians by which the heads of lead and follow are turned to the left
    std::array<double, 2> look{0.2, 0.6};
};

/// How a dance is danced by two.
struct CoupleForm {
    CoupleHold hold = CoupleHold::none;  ///< how they hold one another
    /// The follow's place seen from the lead's as figures start: left, forward; metres. None: the
    /// grammar's places say it.
    std::optional<glm::dvec2> apart;
    ClosedFrame frame{};  ///< of a closed hold
};

/// A hand of the lead and one of the follow that hold one another during a part of a figure.
struct HeldHands {
    Side lead = Side::left;     ///< the lead's hand
    Side follow = Side::right;  ///< the follow's
    double from = 0.0;          ///< beats of the figure
    double to = 0.0;            ///< beats of the figure; greater than `from`
};

}  // namespace raks::motion
