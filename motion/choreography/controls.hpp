#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "motion/skeleton/humanoid.hpp"

/// What a written dance can move: 34 controls, each a number over time.
/// docs/reference/choreography.md explains them; values are in centimetres and degrees, as dancers
/// give them.
namespace raks::motion {

/// The controls of the trunk, then those of the left side, then those of the right side in the same
/// order.
enum class Control : std::uint8_t {
    hip_x,
    hip_y,
    hip_z,
    hip_roll,
    hip_tilt,
    hip_yaw,
    chest_x,
    chest_z,
    chest_roll,
    chest_tilt,
    chest_yaw,
    lean_x,
    lean_z,
    head_tilt,
    head_yaw,
    knee,
    left_shoulder_up,
    left_arm_up,
    left_arm_front,
    left_arm_bend,
    left_arm_elbow,
    left_hand_bend,
    left_hand_turn,
    left_hand_fist,
    left_heel,
    right_shoulder_up,
    right_arm_up,
    right_arm_front,
    right_arm_bend,
    right_arm_elbow,
    right_hand_bend,
    right_hand_turn,
    right_hand_fist,
    right_heel,
};
inline constexpr std::size_t kControlCount = 34;  ///< number of controls

/// Index in arrays by control.
[[nodiscard]] constexpr std::size_t index_of(Control control) noexcept {
    return static_cast<std::size_t>(control);
}

/// The same control of the other side; a control of the trunk is its own mirror image.
[[nodiscard]] constexpr Control mirrored(Control control) noexcept {
    constexpr int kFirstLeft = static_cast<int>(Control::left_shoulder_up);
    constexpr int kFirstRight = static_cast<int>(Control::right_shoulder_up);
    const int i = static_cast<int>(control);
    if (i < kFirstLeft) {
        return control;
    }
    const int shift = kFirstRight - kFirstLeft;
    return static_cast<Control>(i < kFirstRight ? i + shift : i - shift);
}

/// `left` on Side::left, its mirror on Side::right.
[[nodiscard]] constexpr Control on_side(Control left, Side side) noexcept {
    return side == Side::left ? left : mirrored(left);
}

/// Controls that share a lag and a size of noise.
enum class ControlGroup : std::uint8_t {
    hip,
    chest,
    lean,
    head,
    knee,
    shoulder,
    arm,
    elbow,
    hand,
    fist,
    heel
};

/// Unit in which a control is written.
enum class ControlUnit : std::uint8_t { centimetres, degrees, share };

/// Names and range of one control.
struct ControlInfo {
    std::string_view name;       ///< as written: "arm.l.up"
    std::string_view both_name;  ///< name that sets both sides: "arms.up"; empty for the trunk's
    ControlGroup group = ControlGroup::hip;   ///< which lag and noise it has
    ControlUnit unit = ControlUnit::degrees;  ///< of its values
    double lowest = 0.0;       ///< limit of what bodies can do, for the sum of a control's tracks
    double highest = 0.0;      ///< the upper limit
    double rest = 0.0;         ///< value where nothing is written (knee: the style's)
    double mirror_sign = 1.0;  ///< -1: a mirrored figure has the opposite value
};

/// The table's entry of a control. Threads: any. Real-time: yes.
[[nodiscard]] const ControlInfo& info_of(Control control) noexcept;

/// The controls that a name sets: one, or one of each side; empty for an unknown name.
struct NamedControls {
    std::array<Control, 2> controls{};  ///< the first `count` are valid
    std::size_t count = 0;              ///< 0 to 2
    /// The valid ones.
    [[nodiscard]] std::span<const Control> all() const noexcept { return {controls.data(), count}; }
};
/// Looks a name up. Threads: any. Real-time: yes.
[[nodiscard]] NamedControls controls_named(std::string_view name) noexcept;

/// Every name that a file can use, for one side and for both. Threads: any.
[[nodiscard]] std::span<const std::string_view> control_names() noexcept;

}  // namespace raks::motion
