// Gestures: small movements of one who stands, as keys between which the body eases.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/realtime.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/figures/dance_habits.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// How a body that stands differs from standing: everything 0 is standing. Radians, metres. To the
/// left and up are positive.
struct BodyShape {
    float weight = 0.0F;       ///< -1 to 1: on the right leg, on the left one
    float drop = 0.0F;         ///< that the hips are lower
    float ahead = 0.0F;        ///< that the hips are ahead
    float hips_turn = 0.0F;    ///< of the hips about up
    float lean = 0.0F;         ///< of the spine forward
    float side = 0.0F;         ///< of the spine to the left
    float twist = 0.0F;        ///< of the shoulders against the hips
    float chest = 0.0F;        ///< of the chest up and out
    float bow = 0.0F;          ///< [0, 1]: bent from the hips
    float head_turn = 0.0F;    ///< about up
    float head_nod = 0.0F;     ///< forward
    float head_tilt = 0.0F;    ///< to the left shoulder
    float shoulders = 0.0F;    ///< that both are lifted
    float left_out = 0.0F;     ///< of the left arm to its side
    float right_out = 0.0F;    ///< of the right arm to its side
    float left_fore = 0.0F;    ///< of the left arm forward
    float right_fore = 0.0F;   ///< of the right arm forward
    float left_bend = 0.0F;    ///< of the left elbow
    float right_bend = 0.0F;   ///< of the right elbow
    float left_toes = 0.0F;    ///< of the left foot up about its heel
    float right_toes = 0.0F;   ///< of the right foot up about its heel
    float left_heel = 0.0F;    ///< of the left foot up about its ball
    float right_heel = 0.0F;   ///< of the right foot up about its ball
    float left_shake = 0.0F;   ///< of the left hand to and fro, at the gesture's rate
    float right_shake = 0.0F;  ///< of the right hand to and fro
    float right_wave = 0.0F;   ///< of the right forearm to and fro
    float left_wave = 0.0F;    ///< of the left forearm to and fro
};

/// The mirror image.
[[nodiscard]] BodyShape mirrored(const BodyShape& shape) noexcept RAKS_NONBLOCKING;
/// `from` as far as `share` on the way to `to`.
[[nodiscard]] BodyShape mix(const BodyShape& from,
                            const BodyShape& to,
                            float share) noexcept RAKS_NONBLOCKING;

/// Where the body comes to, and when.
struct GestureKey {
    float seconds = 0.0F;  ///< from the gesture's beginning; ascending
    BodyShape shape;
};
/// A hand that is led to a place meanwhile.
struct GestureHand {
    Side side = Side::left;
    HandPlace place = HandPlace::thigh;
    double from = 0.0;  ///< seconds from the gesture's beginning
    double to = 1.0;    ///< then it is let go
};

/// A movement of one who stands. It begins from any shape.
struct Gesture {
    std::span<const GestureKey> keys;
    std::span<const GestureHand> hands;
    float rate = 4.0F;  ///< of what goes to and fro; a second

    /// Seconds until the last key.
    [[nodiscard]] double seconds() const noexcept {
        return keys.empty() ? 0.0 : static_cast<double>(keys.back().seconds);
    }
};

/// The gesture of an ending. Real-time: yes.
[[nodiscard]] const Gesture& gesture_of(Ending ending) noexcept RAKS_NONBLOCKING;
/// The gesture of what one does who waits: 2.5 to 4 s. Real-time: yes.
[[nodiscard]] const Gesture& gesture_of(IdleMove move) noexcept RAKS_NONBLOCKING;

/// The shape `seconds` into a gesture that began in the shape `from`. Real-time: yes.
[[nodiscard]] BodyShape shape_at(const Gesture& gesture,
                                 const BodyShape& from,
                                 double seconds) noexcept RAKS_NONBLOCKING;

/// Gives the shape to the body of one who stands. Feet turn about heel or ball and do not slide;
/// arms and hands are left as they are but for what the shape says. Real-time: yes.
void apply_shape(const Skeleton& skeleton,
                 const BodyShape& shape,
                 Pose& pose) noexcept RAKS_NONBLOCKING;
/// Shakes hands and forearms, wherever they are. `turns`: of to and fro. Real-time: yes.
void shake_hands(const BodyShape& shape, double turns, Pose& pose) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
