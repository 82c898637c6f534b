#include "render/scene/stick_figure.hpp"

#include "render/scene/stick_builder.hpp"

#include <cstddef>

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

}  // namespace raks::render
