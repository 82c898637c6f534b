// Dance habits: what the dancers of a dance do beside its figures.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
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

/// How a dancer thanks the audience, after the last posture of a song.
enum class Ending : std::uint8_t {
    bow,       ///< bends, a hand before the waist
    curtsy,    ///< sinks on one leg behind the other, hands out at the skirt
    wave,      ///< waves with a hand over the head
    heart,     ///< a hand on the chest, bends a little
    flourish,  ///< opens both arms, then bends
    stance,    ///< arms folded before the chest, the chin up
    fist,      ///< a fist into the air
    point,     ///< offers a hand to the audience
    nod,       ///< nods twice, loosely
};
/// Names in files, in the order of Ending.
inline constexpr std::array<std::string_view, 9> kEndingNames = {
    "bow", "curtsy", "wave", "heart", "flourish", "stance", "fist", "point", "nod"};

/// What one does who stands and waits.
enum class IdleMove : std::uint8_t {
    weight,     ///< goes over to one leg
    look,       ///< looks to both sides
    breathe,    ///< a deep breath
    stretch,    ///< stretches both arms over the head
    tap,        ///< taps with the toes of a foot
    shake,      ///< shakes out the hands
    shoulders,  ///< rolls the shoulders back
    neck,       ///< leans the head to both sides
    sway,       ///< sways from leg to leg
    toes,       ///< rises on the toes and comes down
    knees,      ///< bends the knees
    up,         ///< looks up at the lights
    twist,      ///< twists the trunk, the arms loose
    loosen,     ///< one heel up, then the other
    fold,       ///< folds the hands before the waist
    akimbo,     ///< a hand on the hip
    bounce,     ///< bounces in the knees
    chest,      ///< the chest out and in
    shimmy,     ///< shakes the shoulders
    circle,     ///< the hips in a circle
    arm,        ///< opens an arm to the side
    crossed,    ///< arms before the chest, leaning back
    bang,       ///< nods with the whole trunk
    nods,       ///< nods to a beat of one's own
    frame,      ///< lifts both arms as for a partner
    present,    ///< offers a hand
};
/// Names in files, in the order of IdleMove.
inline constexpr std::array<std::string_view, 26> kIdleMoveNames = {
    "weight", "look",   "breathe", "stretch", "tap",    "shake", "shoulders", "neck",   "sway",
    "toes",   "knees",  "up",      "twist",   "loosen", "fold",  "akimbo",    "bounce", "chest",
    "shimmy", "circle", "arm",     "crossed", "bang",   "nods",  "frame",     "present"};

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
    /// How they thank the audience; none: they only stand
    std::vector<Ending> endings{Ending::bow, Ending::wave, Ending::heart, Ending::flourish};
    /// What their own dancers do while they wait, beside what all do (Waiting)
    std::vector<IdleMove> idle{};
    /// What was passed over as they were read: one line each, without the file's name
    std::vector<std::string> notes{};
};

}  // namespace raks::motion
