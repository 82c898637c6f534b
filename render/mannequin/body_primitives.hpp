#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "motion/skeleton/humanoid.hpp"

#include <glm/vec3.hpp>

/// The mannequin's body as numbers: solids in the T-pose, in metres, left half and middle. Each
/// rides on one bone into the bind pose. `body_field.hpp` says how they are joined.
namespace raks::render {

/// Who blends with whom; fingers are groups of their own, so that they never grow together.
enum class Group : std::uint8_t {
    core,
    carve,   // taken away from core
    detail,  // added to core after carving
    leg,
    arm,
    palm,
    thumb,
    index,
    middle,
    ring,
    little,
};
inline constexpr int kGroupCount = 11;

/// Unit vectors of a solid: across, along, to the front. Left- or right-handed.
struct SolidFrame {
    glm::vec3 side{};
    glm::vec3 axis{};
    glm::vec3 front{};
};
inline constexpr SolidFrame kUpright{{1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}};
inline constexpr SolidFrame kAlongArm{{0.0F, 1.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}};
inline constexpr SolidFrame kAlongFoot{{1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {0.0F, 1.0F, 0.0F}};

/// Cross-section of a loft at `t` along its axis: half-axes of a superellipse and its centre.
struct Station {
    float t;
    float half_width;
    float half_front;
    float half_back;
    float shift_side;
    float shift_front;
};

/// A limb or trunk with a profile: stations joined by cubics, rounded beyond both ends.
struct Loft {
    std::span<const Station> stations;
    glm::vec3 origin;
    SolidFrame frame;
    float exponent;  ///< of the superellipse: 2 is an ellipse, more is squarer
    float cap_start;
    float cap_end;
};

struct RoundCone {
    glm::vec3 a;
    glm::vec3 b;
    float radius_a;
    float radius_b;
};

struct Ellipsoid {
    glm::vec3 center;
    glm::vec3 radii;  ///< along side, axis, front
    SolidFrame frame;
};

/// `both_sides`: joined with its own mirror image before the other half is reached, so that no
/// cleft is left in the middle.
enum class Fold : std::uint8_t { one_side, both_sides };

struct Primitive {
    std::string_view name;
    Group group;
    motion::Bone bone;
    float blend;  ///< radius in which it melts into those before it
    std::variant<Loft, RoundCone, Ellipsoid> shape;
    Fold fold = Fold::one_side;
};

/// In the order in which they are joined.
[[nodiscard]] std::span<const Primitive> trunk_primitives() noexcept;
[[nodiscard]] std::span<const Primitive> head_primitives() noexcept;
[[nodiscard]] std::span<const Primitive> leg_primitives() noexcept;
[[nodiscard]] std::span<const Primitive> arm_primitives() noexcept;

}  // namespace raks::render
