#include "render/scene/stick_figure.hpp"

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>

#include <glm/ext/scalar_constants.hpp>
#include <glm/geometric.hpp>

namespace raks::render {
namespace {

using motion::Bone;

constexpr float kEndRadius = 0.022F;  // metres; hands, feet, clavicles

/// Bones are ordered: middle, then left, then right.
StickPart part_of(Bone bone) noexcept {
    if (bone < Bone::left_upper_leg) {
        return StickPart::middle;
    }
    return bone < Bone::right_upper_leg ? StickPart::left : StickPart::right;
}

/// A builder for pieces fixed to `bone`, in its side's colour.
StickBuilder builder_for(Shape<StickVertex>& shape, Bone bone) {
    return {shape, static_cast<std::uint8_t>(bone), part_of(bone)};
}

bool is_finger(Bone bone) noexcept {
    return (bone >= Bone::left_thumb_metacarpal && bone <= Bone::left_little_distal) ||
           (bone >= Bone::right_thumb_metacarpal && bone <= Bone::right_little_distal);
}

/// The last bone of a finger, which has no child joint to draw a stick to.
bool is_fingertip(Bone bone) noexcept {
    return is_finger(bone) && motion::kBoneNames[motion::index_of(bone)].ends_with("Distal");
}

/// Joints at the ends of limbs and at the neck are smaller, those of fingers much smaller.
float joint_radius(Bone bone) noexcept {
    switch (bone) {
        case Bone::left_shoulder:
        case Bone::right_shoulder:
        case Bone::left_toes:
        case Bone::right_toes:
        case Bone::left_hand:
        case Bone::right_hand:
        case Bone::left_foot:
        case Bone::right_foot:
        case Bone::neck:
        case Bone::head:
            return kEndRadius;
        default:
            return is_finger(bone) ? kStickFingerRadius : kStickJointRadius;
    }
}

/// The sphere of a joint in the full colour of its side.
void add_joint(Shape<StickVertex>& shape, Bone bone) {
    StickBuilder builder = builder_for(shape, bone);
    builder.set_tint(1.0F);
    const float radius = joint_radius(bone);
    const bool is_small = radius == kStickFingerRadius;
    builder.add_ellipsoid(glm::vec3(0.0F), glm::vec3(radius), is_small ? 6 : 10, is_small ? 8 : 18);
}

/// From a bone's joint to `end` in its frame, with a sphere there when nothing follows.
enum class End { joint, free };
void add_bone(Shape<StickVertex>& shape, Bone bone, glm::vec3 end, Bone colour_of, End kind) {
    StickBuilder builder = builder_for(shape, bone);
    builder.set_tint(part_of(colour_of) == StickPart::middle ? 0.0F : kStickBoneTint);
    const float radius = is_finger(colour_of) ? kStickFingerBoneRadius : kStickBoneRadius;
    builder.add_cone(glm::vec3(0.0F), end, radius, kStickTaper * radius);
    if (kind == End::free) {
        builder.add_ellipsoid(end, glm::vec3(kStickTaper * radius), 6, 10);
    }
}

/// The egg stands on the head's joint, which keeps its own sphere.
void add_head(Shape<StickVertex>& shape) { builder_for(shape, Bone::head).add_head(); }

/// Heel and toes: the skeleton gives their places as points, not as joints. They are given for the
/// left foot and mirrored for the right.
void add_foot(Shape<StickVertex>& shape, const motion::Skeleton& skeleton, motion::Side side) {
    const float sign = side == motion::Side::left ? 1.0F : -1.0F;
    const glm::vec3 mirror{sign, 1.0F, 1.0F};
    const Bone foot = motion::on_side(Bone::left_foot, side);
    const Bone toes = motion::on_side(Bone::left_toes, side);
    const glm::vec3 lifted{
        0.0F, kStickTaper * kStickBoneRadius, 0.0F};  // stands on the floor, not in it
    add_bone(shape, foot, mirror * (skeleton.heel + lifted), foot, End::free);
    const glm::vec3 tip = mirror * (skeleton.toe_tip + lifted);
    add_bone(shape, toes, tip - skeleton.offsets[motion::index_of(toes)], toes, End::free);
}

}  // namespace

Shape<StickVertex> stick_figure(const motion::Skeleton& skeleton) {
    Shape<StickVertex> shape;
    for (std::size_t i = 0; i < motion::kBoneParents.size(); ++i) {
        const auto bone = static_cast<Bone>(i);
        add_joint(shape, bone);
        if (i > 0) {
            // A stick turns with the bone it lies along, the parent, but has the colour of its
            // lower end.
            const auto parent = static_cast<Bone>(motion::kBoneParents[i]);
            add_bone(shape, parent, skeleton.offsets[i], bone, End::joint);
        }
        if (is_fingertip(bone)) {
            constexpr float kTipAgainstMiddle = 0.85F;  // lengths of a finger's last two bones
            add_bone(shape, bone, kTipAgainstMiddle * skeleton.offsets[i], bone, End::free);
        }
    }
    add_head(shape);
    for (const motion::Side side : motion::kSides) {
        add_foot(shape, skeleton, side);
    }
    return shape;
}

namespace {

// Metres, from the head's joint at the top of the neck.
constexpr glm::vec3 kHeadRadii{0.073F, 0.099F, 0.088F};
constexpr glm::vec3 kHeadMiddle{0.0F, 0.095F, 0.012F};
constexpr float kNoseRadius = 0.014F;

float ratio(std::size_t i, std::size_t count) noexcept {
    return static_cast<float>(i) / static_cast<float>(count);
}

}  // namespace

/// A part of the middle has neither side's colour.
void StickBuilder::set_tint(float tint) noexcept {
    const auto share = static_cast<std::uint8_t>(std::lround(255.0F * tint));
    left_ = part_ == StickPart::left ? share : std::uint8_t{0};
    right_ = part_ == StickPart::right ? share : std::uint8_t{0};
}

void StickBuilder::add_ellipsoid(glm::vec3 middle,
                                 glm::vec3 radii,
                                 std::size_t rows,
                                 std::size_t columns) {
    const std::size_t first = shape_.vertices.size();
    for (std::size_t row = 0; row <= rows; ++row) {
        const float polar = glm::pi<float>() * ratio(row, rows);
        for (std::size_t column = 0; column <= columns; ++column) {
            const float around = 2.0F * glm::pi<float>() * ratio(column, columns);
            const glm::vec3 unit{std::sin(polar) * std::cos(around),
                                 std::cos(polar),
                                 -std::sin(polar) * std::sin(around)};
            // The normal of an ellipsoid is the unit sphere's, divided by the radii.
            add_vertex(middle + radii * unit, glm::normalize(unit / radii));
        }
    }
    connect(first, rows, columns);
}

void StickBuilder::add_cone(
    glm::vec3 from, glm::vec3 to, float from_radius, float to_radius, std::size_t sides) {
    const float length = glm::length(to - from);
    // Joints in one place have no axis between them.
    if (length < 1e-4F) {
        return;
    }
    const glm::vec3 axis = (to - from) / length;
    const glm::vec3 other =
        std::abs(axis.y) < 0.9F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
    const glm::vec3 u = glm::normalize(glm::cross(axis, other));
    const glm::vec3 v = glm::cross(axis, u);
    // A taper tilts the normals toward the thin end.
    const float slope = (from_radius - to_radius) / length;
    const std::size_t first = shape_.vertices.size();
    // From the far ring to the near one: so that the triangles face outward.
    for (const auto& [centre, radius] : {std::pair{to, to_radius}, std::pair{from, from_radius}}) {
        for (std::size_t side = 0; side <= sides; ++side) {
            const float angle = 2.0F * glm::pi<float>() * ratio(side, sides);
            const glm::vec3 out = std::cos(angle) * u + std::sin(angle) * v;
            add_vertex(centre + radius * out, glm::normalize(out + slope * axis));
        }
    }
    connect(first, 1, sides);
}

void StickBuilder::add_head() {
    add_ellipsoid(kHeadMiddle, kHeadRadii, 18, 28);
    const glm::vec3 nose = kHeadMiddle + glm::vec3(0.0F, -0.008F, kHeadRadii.z);
    add_ellipsoid(nose, glm::vec3(kNoseRadius), 8, 12);
}

void StickBuilder::add_vertex(glm::vec3 position, glm::vec3 normal) {
    shape_.vertices.push_back({.position = position,
                               .normal = normal,
                               .bone = bone_,
                               .left = left_,
                               .right = right_,
                               .occlusion = 230});
}

/// Two triangles for each cell of a grid whose rows have one point more than cells: the last column
/// repeats the first.
void StickBuilder::connect(std::size_t first, std::size_t rows, std::size_t columns) {
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t a = first + row * (columns + 1) + column;
            const std::size_t b = a + columns + 1;
            for (const std::size_t corner : {a, b, b + 1, a, b + 1, a + 1}) {
                shape_.indices.push_back(static_cast<std::uint16_t>(corner));
            }
        }
    }
}

}  // namespace raks::render
