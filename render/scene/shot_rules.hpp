// The director's shots: what each shows, and how often it is chosen.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "render/scene/director.hpp"
#include "render/scene/shot.hpp"

namespace raks::render {

/// What a shot is, and when it is chosen.
struct ShotRule {
    std::string_view name;
    /// What is seen at its start and at its end.
    ShotSize from;
    ShotSize to;
    /// Degrees from the stage's front; an orbit goes from one to the other.
    float yaw_low;
    float yaw_high;
    /// How often it is chosen when the music is calm, as usual, full.
    std::array<float, 3> weights;
    float longest;   ///< seconds
    bool is_of_one;  ///< of one dancer or two alone: more stand beside each other
};

/// Of a shot that may stay as long as it likes, seconds.
inline constexpr float kAnyLength = 1e6F;

/// By Shot.
inline constexpr std::array<ShotRule, kShots> kShotRules = {{
    {"wide", ShotSize::wide, ShotSize::wide, 4, 16, {0.12F, 0.15F, 0.25F}, kAnyLength, false},
    {"full", ShotSize::full, ShotSize::full, 4, 30, {0.20F, 0.28F, 0.32F}, kAnyLength, false},
    {"knees up",
     ShotSize::knees_up,
     ShotSize::knees_up,
     6,
     38,
     {0.20F, 0.22F, 0.18F},
     kAnyLength,
     false},
    {"upper body",
     ShotSize::upper_body,
     ShotSize::upper_body,
     6,
     36,
     {0.18F, 0.12F, 0.08F},
     12.0F,
     true},
    {"feet", ShotSize::feet, ShotSize::feet, 10, 42, {0.02F, 0.07F, 0.08F}, 4.0F, true},
    {"side", ShotSize::full, ShotSize::full, 58, 76, {0.08F, 0.08F, 0.07F}, 10.0F, true},
    {"push", ShotSize::full, ShotSize::upper_body, 4, 20, {0.15F, 0.08F, 0.0F}, kAnyLength, true},
    {"orbit", ShotSize::full, ShotSize::full, 6, 52, {0.15F, 0.15F, 0.16F}, kAnyLength, false},
    {"low", ShotSize::low, ShotSize::low, 6, 34, {0.03F, 0.08F, 0.14F}, 12.0F, false},
    {"face", ShotSize::face, ShotSize::face, 6, 34, {0.10F, 0.07F, 0.06F}, 5.0F, false},
}};

/// The rule of a shot.
[[nodiscard]] inline const ShotRule& rule_of(Shot shot) noexcept {
    return kShotRules[static_cast<std::size_t>(shot)];
}

}  // namespace raks::render
