#include "motion/capture/solving/body_size.hpp"

namespace raks::capture {
namespace {

using motion::Bone;

/// The left bone of a pair.
Bone on_left(Bone bone) { return bone >= Bone::right_upper_leg ? motion::mirrored(bone) : bone; }

}  // namespace

BodyPart part_before(Bone bone) noexcept {
    switch (on_left(bone)) {
        case Bone::hips:
        case Bone::left_upper_leg:
            return BodyPart::pelvis;
        case Bone::left_lower_leg:
            return BodyPart::thigh;
        case Bone::left_foot:
            return BodyPart::shin;
        case Bone::left_toes:
            return BodyPart::foot;
        case Bone::spine:
        case Bone::chest:
        case Bone::upper_chest:
        case Bone::neck:
            return BodyPart::trunk;
        case Bone::head:
            return BodyPart::neck;
        case Bone::left_shoulder:
        case Bone::left_upper_arm:
            return BodyPart::shoulder;
        case Bone::left_lower_arm:
            return BodyPart::upper_arm;
        case Bone::left_hand:
            return BodyPart::forearm;
        default:
            return BodyPart::hand;
    }
}

BodyPart part_of(Bone bone) noexcept {
    switch (on_left(bone)) {
        case Bone::hips:
            return BodyPart::pelvis;
        case Bone::left_upper_leg:
            return BodyPart::thigh;
        case Bone::left_lower_leg:
            return BodyPart::shin;
        case Bone::left_foot:
        case Bone::left_toes:
            return BodyPart::foot;
        case Bone::spine:
        case Bone::chest:
        case Bone::upper_chest:
            return BodyPart::trunk;
        case Bone::neck:
        case Bone::head:
            return BodyPart::neck;
        case Bone::left_shoulder:
            return BodyPart::shoulder;
        case Bone::left_upper_arm:
            return BodyPart::upper_arm;
        case Bone::left_lower_arm:
            return BodyPart::forearm;
        default:
            return BodyPart::hand;
    }
}

BodyShape shape_of(const BodySize& size, const MarkerSet& markers) {
    const motion::Skeleton& mannequin = motion::mannequin_skeleton();
    BodyShape shape;
    for (std::size_t i = 0; i < shape.offsets.size(); ++i) {
        shape.offsets[i] =
            size.bone_factor(static_cast<Bone>(i)) * glm::dvec3(mannequin.offsets[i]);
    }
    const double foot = size.factor(BodyPart::foot);
    shape.sole = {
        foot * glm::dvec3(mannequin.toe_tip - mannequin.offsets[index_of(Bone::left_toes)]),
        foot * glm::dvec3(mannequin.ball),
        foot * glm::dvec3(mannequin.heel)};
    for (std::size_t i = 0; i < markers.markers.size(); ++i) {
        const Marker& marker = markers.markers[i];
        shape.marker_places.push_back(size.factor(part_of(marker.bone)) * marker.place);
        if (i < size.marker_shifts.size()) {
            shape.marker_places.back() += size.marker_shifts[i];
        }
    }
    return shape;
}

motion::Skeleton skeleton_of(const BodySize& size) {
    motion::Skeleton skeleton =
        motion::scaled(motion::mannequin_skeleton(), static_cast<float>(size.whole));
    for (std::size_t i = 1; i < skeleton.offsets.size(); ++i) {
        const BodyPart part = part_before(static_cast<Bone>(i));
        skeleton.offsets[i] *=
            static_cast<float>(size.parts[static_cast<std::size_t>(part)] * size.bones[i]);
    }
    const auto foot = static_cast<float>(size.parts[static_cast<std::size_t>(BodyPart::foot)]);
    for (glm::vec3* point : {&skeleton.ball, &skeleton.toe_tip, &skeleton.heel}) {
        *point *= foot;
    }
    skeleton.sole_half *= foot;
    // Standing on its soles.
    skeleton.offsets[0].y = -(skeleton.offsets[index_of(Bone::left_upper_leg)].y +
                              skeleton.offsets[index_of(Bone::left_lower_leg)].y +
                              skeleton.offsets[index_of(Bone::left_foot)].y + skeleton.ball.y);
    return skeleton;
}

}  // namespace raks::capture
