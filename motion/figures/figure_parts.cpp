#include <algorithm>
#include <array>

#include "base/assert.hpp"
#include "motion/figures/figure_model.hpp"

namespace raks::motion {
namespace {

// Joint positions of the torso belong to the upper part.
constexpr std::array<Part, 2> kPositionParts = {Part::upper, Part::lower};

std::vector<Bone> bones_of_angles(Part part) {
    switch (part) {
        case Part::torso:
            return {Bone::spine, Bone::chest, Bone::neck};
        case Part::upper:
            return {Bone::left_shoulder,
                    Bone::left_upper_arm,
                    Bone::left_lower_arm,
                    Bone::right_shoulder,
                    Bone::right_upper_arm,
                    Bone::right_lower_arm};
        case Part::lower:
            return {Bone::left_upper_leg,
                    Bone::left_lower_leg,
                    Bone::left_foot,
                    Bone::right_upper_leg,
                    Bone::right_lower_leg,
                    Bone::right_foot};
    }
    return {};
}

/// Joints whose place is a feature. The hips are left out: they lie over the origin of their own
/// frame, at a height that follows from the leg sockets. They would add no information, and the
/// likelihood of a constant feature grows without bound.
std::vector<Bone> bones_of_positions(Part part) {
    switch (part) {
        case Part::torso:
            return {};
        case Part::upper:
            return {Bone::spine,
                    Bone::chest,
                    Bone::neck,
                    Bone::head,
                    Bone::left_upper_arm,
                    Bone::left_lower_arm,
                    Bone::left_hand,
                    Bone::right_upper_arm,
                    Bone::right_lower_arm,
                    Bone::right_hand};
        case Part::lower:
            return {Bone::left_upper_leg,
                    Bone::left_lower_leg,
                    Bone::left_foot,
                    Bone::left_toes,
                    Bone::right_upper_leg,
                    Bone::right_lower_leg,
                    Bone::right_foot,
                    Bone::right_toes};
    }
    return {};
}

}  // namespace

std::span<const Part> parts_of(FigureFeatures features) noexcept {
    if (features == FigureFeatures::positions) {
        return kPositionParts;
    }
    return kParts;
}

std::vector<Bone> default_joints(Part part, FigureFeatures features) {
    return features == FigureFeatures::positions ? bones_of_positions(part) : bones_of_angles(part);
}

const PartModel& FigureModel::part(Part which) const noexcept {
    const auto found = std::find_if(
        parts.begin(), parts.end(), [which](const PartModel& one) { return one.part == which; });
    // Validated models have all parts of their kind.
    RAKS_ASSERT(found != parts.end());
    return *found;
}

const PartModel& FigureModel::root_part() const noexcept {
    return part(features == FigureFeatures::positions ? Part::lower : Part::torso);
}

}  // namespace raks::motion
