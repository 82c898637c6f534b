// Dance habits: what the dancers of a dance do beside its figures.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace raks::motion {

/// Where a hand can be, beside the dance.
enum class HandPlace : std::uint8_t {
    thigh,    ///< hangs beside the thigh and sways a little
    hip,      ///< on the hip bone, the elbow out
    waist,    ///< before the waist
    chest,    ///< before the chest, the forearm level
    wide,     ///< out to the side at the height of the shoulder, softly bent
    high,     ///< up and out, over the head
    low,      ///< down and out, away from the body
    offered,  ///< ahead and out, the hand offered
    swing,    ///< hangs and swings to and fro, against the other
    snap,     ///< ahead at the height of the shoulder, snaps its fingers on the off-beats
    clap,     ///< before the chest, claps into the other on the off-beats
    skirt,    ///< low at the side, holding a skirt
    head,     ///< beside the head, the elbow out: it frames the face
    frame,    ///< of the ballroom, without a partner: the left hand out at the height of the eyes
};
/// Names in files, in the order of HandPlace.
inline constexpr std::array<std::string_view, 14> kHandPlaceNames = {"thigh",
                                                                     "hip",
                                                                     "waist",
                                                                     "chest",
                                                                     "wide",
                                                                     "high",
                                                                     "low",
                                                                     "offered",
                                                                     "swing",
                                                                     "snap",
                                                                     "clap",
                                                                     "skirt",
                                                                     "head",
                                                                     "frame"};

/// What fingers do.
enum class HandShape : std::uint8_t {
    danced,   ///< as the figure has them
    relaxed,  ///< softly bent
    lengthy,  ///< long, the thumb in: a dancer's hand
    fist,     ///< closed, the thumb before it
    point,    ///< the index finger out of a fist
    flat,     ///< straight and together
    open,     ///< straight and spread
    snap,     ///< thumb against the middle finger; they snap on the off-beats
    clap,     ///< nearly flat, a little hollow
    zills,    ///< thumb and middle finger strike finger cymbals on the beats
    pinch,    ///< holds cloth
};
/// Names in files, in the order of HandShape.
inline constexpr std::array<std::string_view, 11> kHandShapeNames = {
    "danced", "relaxed", "long", "fist", "point", "flat", "open", "snap", "clap", "zills", "pinch"};

/// How often hands take each shape: weights by HandShape.
using HandShapeWeights = std::array<float, kHandShapeNames.size()>;

/// Which shapes the hands of a dance take, and when.
struct HandHabits {
    int every = 4;  ///< counts after which another shape may be taken; 1 to 64
    /// Hands of which nothing is said are as the figures have them.
    HandShapeWeights shapes{1.0F};
    /// Where the hands of one who dances alone are when they do not rest; none: where the figures
    /// have them.
    std::optional<HandPlace> keep{};
};

/// What stays where it is in the room while the hips move under it.
enum class StillPart : std::uint8_t { nothing, chest, head };
/// Names in files, in the order of StillPart.
inline constexpr std::array<std::string_view, 3> kStillPartNames = {"nothing", "chest", "head"};

/// What the dancers of a dance do beside its figures.
struct DanceHabits {
    double pauses = 0.45;  ///< share of the phrases of eight bars that end in a pause; [0, 1]
    double rests = 0.30;   ///< share of the figures in which a hand rests; [0, 1]
    /// Share of the changes of figure at which a dancer goes over to the other side, left for
    /// right, where the feet allow it; [0, 1]
    double mirror = 0.0;
    /// Where hands rest; at least one
    std::vector<HandPlace> rest_at{HandPlace::hip, HandPlace::thigh, HandPlace::chest};
    HandHabits hands;  ///< what fingers do
};

}  // namespace raks::motion
