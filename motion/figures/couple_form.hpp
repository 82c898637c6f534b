// Couple form: how two dance a dance together.
#pragma once

#include <array>
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
    closed,  ///< the ballroom's frame: her right hand in his left one at shoulder height, his right
             ///< hand at her back, her left one on his upper arm
};
/// Names in files, by CoupleHold.
inline constexpr std::array<std::string_view, 3> kCoupleHoldNames = {"none", "hands", "closed"};

/// How a dance is danced by two.
struct CoupleForm {
    CoupleHold hold = CoupleHold::none;  ///< how they hold one another
    /// The follow's place seen from the lead's as figures start: left, forward; metres. None: the
    /// grammar's places say it.
    std::optional<glm::dvec2> apart;
};

/// A hand of the lead and one of the follow that hold one another during a part of a figure.
struct HeldHands {
    Side lead = Side::left;     ///< the lead's hand
    Side follow = Side::right;  ///< the follow's
    double from = 0.0;          ///< beats of the figure
    double to = 0.0;            ///< beats of the figure; greater than `from`
};

}  // namespace raks::motion
