// Dance habits: what the dancers of a dance do beside its figures.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace raks::motion {

/// Where a hand can be, beside the dance.
enum class HandPlace : std::uint8_t {
    thigh,    ///< hangs beside the thigh, a little off it
    hip,      ///< on the hip bone, the elbow out
    waist,    ///< before the waist
    chest,    ///< before the chest, the forearm level
    wide,     ///< out to the side at the height of the shoulder, softly bent
    high,     ///< up and out, over the head
    low,      ///< down and out, away from the body
    offered,  ///< ahead and out, the hand offered
};
/// Names in files, in the order of HandPlace.
inline constexpr std::array<std::string_view, 8> kHandPlaceNames = {
    "thigh", "hip", "waist", "chest", "wide", "high", "low", "offered"};

/// What the dancers of a dance do beside its figures.
struct DanceHabits {
    double pauses = 0.45;  ///< share of the phrases of eight bars that end in a pause; [0, 1]
    double rests = 0.30;   ///< share of the figures in which a hand rests; [0, 1]
    /// Share of the changes of figure at which a dancer goes over to the other side, left for
    /// right, where the feet allow it; [0, 1]
    double mirror = 0.0;
    /// Where hands rest; at least one
    std::vector<HandPlace> rest_at{HandPlace::hip, HandPlace::thigh, HandPlace::chest};
};

}  // namespace raks::motion
