#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "motion/skeleton/humanoid.hpp"

#include <glm/vec3.hpp>

/// The mannequin's body as numbers: solids of the left half and the middle, in metres, in the
/// T-pose (world space: y up, facing +z, left is +x). Each rides on one bone into the bind pose.
/// `body_field.hpp` says how they are joined.
namespace raks::render {

/// Solids of one group are joined by a smooth minimum. Each finger is a group of its own, so that
/// neighbouring fingers never grow together.
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
/// Number of values of Group.
inline constexpr int kGroupCount = 11;

/// Axes of a solid: unit vectors at right angles, left- or right-handed.
struct SolidFrame {
    /// Direction of the half width.
    glm::vec3 side{};
    /// Direction along the solid, in which a loft's `t` grows.
    glm::vec3 axis{};
    /// Direction of `half_front`; `half_back` lies against it.
    glm::vec3 front{};
};
/// The world's axes: for trunk, head and everything that is modelled standing.
inline constexpr SolidFrame kUpright{{1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}};
/// Axis along the left arm of the T-pose, side upwards.
inline constexpr SolidFrame kAlongArm{{0.0F, 1.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}};
/// Axis from heel to toes, front upwards.
inline constexpr SolidFrame kAlongFoot{{1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {0.0F, 1.0F, 0.0F}};

/// Cross-section of a loft: half-axes of a superellipse and its centre, all in metres.
struct Station {
    /// Place along the axis, from the loft's origin; strictly rising from station to station.
    float t;
    /// Half-axis along `side`, the same both ways.
    float half_width;
    /// Half-axis toward `front`.
    float half_front;
    /// Half-axis away from `front`.
    float half_back;
    /// Offset of the centre along `side`.
    float shift_side;
    /// Offset of the centre along `front`.
    float shift_front;
};

/// A limb or trunk with a profile: stations joined by cubics, rounded beyond both ends.
struct Loft {
    /// At least two.
    std::span<const Station> stations;
    /// Point of the axis with t = 0.
    glm::vec3 origin;
    /// Orthonormal axes of the solid.
    SolidFrame frame;
    float exponent;  ///< of the superellipse: 2 is an ellipse, more is squarer
    /// Length of the rounded end before the first station, metres.
    float cap_start;
    /// Length of the rounded end behind the last station, metres.
    float cap_end;
};

/// Hull of two spheres.
struct RoundCone {
    /// Centre of the first sphere.
    glm::vec3 a;
    /// Centre of the second sphere.
    glm::vec3 b;
    /// Radius of the first sphere.
    float radius_a;
    /// Radius of the second sphere.
    float radius_b;
};

/// Ellipsoid of any orientation.
struct Ellipsoid {
    /// Centre.
    glm::vec3 center;
    glm::vec3 radii;  ///< along side, axis, front
    /// Orthonormal axes to which `radii` belong.
    SolidFrame frame;
};

/// `both_sides`: the solid is joined with its own mirror image, too, so that no cleft is left where
/// the two halves meet in the middle of the body.
enum class Fold : std::uint8_t { one_side, both_sides };

/// One solid of the body: its shape in the T-pose, the bone it rides on and how it is joined.
struct Primitive {
    /// For the reader of the tables.
    std::string_view name;
    /// Group into which it is joined.
    Group group;
    /// Bone that carries it from the T-pose into the bind pose.
    motion::Bone bone;
    float blend;  ///< radius, metres, of the smooth minimum with those before it
    /// In the T-pose.
    std::variant<Loft, RoundCone, Ellipsoid> shape;
    /// Whether its mirror image takes part.
    Fold fold = Fold::one_side;
};

/// Torso, bust, back and neck, in the order in which they are joined. Static tables, like the three
/// below.
[[nodiscard]] std::span<const Primitive> trunk_primitives() noexcept;
/// Skull and face, with the carved eye sockets and the details on top.
[[nodiscard]] std::span<const Primitive> head_primitives() noexcept;
/// Left thigh, shank and foot.
[[nodiscard]] std::span<const Primitive> leg_primitives() noexcept;
/// Left arm, palm and fingers.
[[nodiscard]] std::span<const Primitive> arm_primitives() noexcept;

}  // namespace raks::render
