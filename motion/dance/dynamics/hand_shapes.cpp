#include "motion/dance/dynamics/hand_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

constexpr std::size_t kFingerBones = 15;
using Fingers = std::array<glm::quat, kFingerBones>;  // of a left hand, in the order of Bone

/// A hand as a teacher would say it; degrees.
struct Drawn {
    /// Bend of the three joints of index, middle, ring and little finger
    std::array<std::array<float, 3>, 4> bends;
    std::array<float, 4> spread;  ///< of them, away from the thumb
    float close;                  ///< of the thumb to the index finger
    float oppose;                 ///< of the thumb before the palm
    float thumb;                  ///< bend of its two outer joints
};

constexpr Drawn kRelaxed{
    {{{15, 18, 15}, {18, 22, 16}, {21, 24, 17}, {23, 25, 17}}}, {-2, 0, 1, 3}, 15, 6, 18};
// As ballet holds it: the middle finger and the thumb in, the others long.
constexpr Drawn kLong{
    {{{3, 8, 5}, {15, 16, 9}, {11, 12, 7}, {4, 9, 6}}}, {-5, 0, 1, 5}, 30, 22, 14};
constexpr Drawn kFist{
    {{{72, 95, 55}, {76, 97, 58}, {78, 96, 58}, {80, 92, 58}}}, {0, 0, 0, 0}, 26, 62, 46};
constexpr Drawn kPoint{
    {{{2, 4, 3}, {74, 97, 58}, {78, 96, 58}, {80, 92, 58}}}, {0, 0, 0, 0}, 28, 64, 44};
constexpr Drawn kFlat{{{{2, 3, 2}, {3, 4, 2}, {3, 4, 2}, {3, 4, 2}}}, {2, 0, -2, -4}, 34, 6, 4};
constexpr Drawn kOpen{
    {{{-4, 2, 2}, {-4, 2, 2}, {-3, 2, 2}, {-2, 2, 2}}}, {-11, -2, 8, 17}, -8, -4, 2};
constexpr Drawn kClap{{{{8, 9, 5}, {9, 10, 5}, {9, 10, 5}, {9, 10, 5}}}, {-1, 0, 0, 1}, 20, 8, 8};
constexpr Drawn kPinch{
    {{{46, 44, 22}, {52, 50, 25}, {56, 54, 28}, {58, 56, 30}}}, {0, 0, 0, 0}, 30, 34, 22};
// Thumb and middle finger pressed together, and the finger struck into the palm.
constexpr Drawn kSnapBefore{
    {{{28, 30, 14}, {52, 44, 18}, {60, 62, 34}, {64, 66, 36}}}, {-4, 0, 0, 2}, 28, 40, 14};
constexpr Drawn kSnapAfter{
    {{{20, 24, 12}, {82, 84, 40}, {72, 76, 40}, {72, 74, 40}}}, {-4, 0, 0, 2}, 22, 18, 8};
constexpr Drawn kZillsOpen{
    {{{4, 8, 5}, {28, 24, 10}, {12, 13, 8}, {5, 10, 7}}}, {-6, 0, 3, 8}, 18, 26, 10};
constexpr Drawn kZillsShut{
    {{{4, 8, 5}, {50, 36, 14}, {14, 15, 8}, {5, 10, 7}}}, {-6, 0, 3, 8}, 28, 40, 16};

Fingers fingers_of(const Drawn& drawn) noexcept {
    // Axes of the left hand, palm down, fingers along x, the thumb ahead.
    constexpr glm::vec3 kFingerTurn{0.0F, 0.0F, -1.0F};
    constexpr glm::vec3 kFromPalm{0.0F, 1.0F, 0.0F};
    constexpr glm::vec3 kAlongHand{1.0F, 0.0F, 0.0F};
    constexpr glm::vec3 kThumbTurn{0.0F, -0.70711F, -0.70711F};
    const auto turn = [](float degrees, const glm::vec3& axis) {
        return glm::angleAxis(glm::radians(degrees), axis);
    };
    Fingers fingers{};
    // The thumb comes first.
    fingers[0] = turn(drawn.oppose, kAlongHand) * turn(drawn.close, kFromPalm);
    fingers[1] = turn(drawn.thumb, kThumbTurn);
    fingers[2] = turn(drawn.thumb, kThumbTurn);
    for (std::size_t finger = 0; finger < drawn.bends.size(); ++finger) {
        const auto& bends = drawn.bends[finger];
        const std::size_t first = 3 + 3 * finger;
        fingers[first] = turn(drawn.spread[finger], kFromPalm) * turn(bends[0], kFingerTurn);
        fingers[first + 1] = turn(bends[1], kFingerTurn);
        fingers[first + 2] = turn(bends[2], kFingerTurn);
    }
    return fingers;
}

/// A shape and, where it works by the beat, the one that it strikes.
struct Shape {
    Fingers fingers;
    Fingers struck;
    double every = 0.0;  // beats; 0: it does not strike
    double at = 0.0;     // a beat on which it does
};

Shape still(const Drawn& drawn) noexcept { return {fingers_of(drawn), fingers_of(drawn)}; }

// In the order of HandShape.
const std::array<Shape, kHandShapeNames.size()> kShapes = {
    still(kRelaxed),  // as danced: not used
    still(kRelaxed),
    still(kLong),
    still(kFist),
    still(kPoint),
    still(kFlat),
    still(kOpen),
    Shape{fingers_of(kSnapBefore), fingers_of(kSnapAfter), 2.0, 1.0},
    still(kClap),
    Shape{fingers_of(kZillsOpen), fingers_of(kZillsShut), 1.0, 0.0},
    still(kPinch),
};

Fingers mixed(const Fingers& from, const Fingers& to, float share) noexcept {
    Fingers result{};
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = interpolate(from[i], to[i], share);
    }
    return result;
}

/// [0, 1]: how far fingers have struck. They are there on the beat.
float struck_at(double beat, const Shape& shape) noexcept {
    constexpr double kStrikes = 0.16;  // beats
    constexpr double kOpens = 0.45;
    const double since = beat - shape.at;
    const double into = since - shape.every * std::floor(since / shape.every);
    const double before = shape.every - into;
    const auto strikes = static_cast<float>(1.0 - before / kStrikes);
    const auto opens = static_cast<float>(1.0 - into / kOpens);
    return smootherstep(std::max(strikes, opens));
}

Fingers fingers_at(HandShape shape, double beat) noexcept {
    const Shape& own = kShapes[static_cast<std::size_t>(shape)];
    return own.every > 0.0 ? mixed(own.fingers, own.struck, struck_at(beat, own)) : own.fingers;
}

std::size_t first_finger(Side side) noexcept {
    return index_of(on_side(Bone::left_thumb_metacarpal, side));
}

/// From the one side to the other.
glm::quat on_hand(const glm::quat& q, Side side) noexcept {
    return side == Side::left ? q : glm::quat(q.w, q.x, -q.y, -q.z);
}

}  // namespace

void set_hand_shape(Side side, HandShape shape, double beat, Pose& pose) noexcept RAKS_NONBLOCKING {
    if (shape == HandShape::danced) {
        return;
    }
    const Fingers fingers = fingers_at(shape, beat);
    const std::size_t first = first_finger(side);
    for (std::size_t i = 0; i < fingers.size(); ++i) {
        pose.local_rotations[first + i] = on_hand(fingers[i], side);
    }
}

void HandShapes::take(Side side,
                      HandShape shape,
                      StreamTime now,
                      const Pose& shown) noexcept RAKS_NONBLOCKING {
    Hand& hand = hands_[static_cast<std::size_t>(side)];
    if (hand.shape == shape) {
        return;
    }
    hand.shape = shape;
    hand.since = now;
    std::copy_n(shown.local_rotations.begin() + static_cast<std::ptrdiff_t>(first_finger(side)),
                hand.from.size(),
                hand.from.begin());
}

void HandShapes::apply(StreamTime time, double beat, Pose& pose) const noexcept RAKS_NONBLOCKING {
    for (const Side side : kSides) {
        const Hand& hand = hands_[static_cast<std::size_t>(side)];
        set_hand_shape(side, hand.shape, beat, pose);
        const auto share =
            static_cast<float>(to_seconds(time - hand.since) / to_seconds(Nanos(kEase)));
        if (share >= 1.0F) {
            continue;
        }
        const std::size_t first = first_finger(side);
        for (std::size_t i = 0; i < hand.from.size(); ++i) {
            glm::quat& finger = pose.local_rotations[first + i];
            finger = interpolate(hand.from[i], finger, smootherstep(share));
        }
    }
}

}  // namespace raks::motion
