#include "motion/capture/markerless/dancer_limbs.hpp"

#include "motion/capture/solving/body_size.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

using motion::Bone;

// By index in kMainPoints; lengths by index in limb_lengths().
constexpr std::array<DancerLimb, 12> kLimbs = {{{0, 2, 0},
                                                {1, 3, 0},
                                                {2, 4, 1},
                                                {3, 5, 1},
                                                {6, 8, 2},
                                                {7, 9, 2},
                                                {8, 10, 3},
                                                {9, 11, 3},
                                                {0, 1, 4},
                                                {6, 7, 5},
                                                {0, 6, 6},
                                                {1, 7, 6}}};

// Limbs of people of one height differ by some per cent. Where hips and shoulders are, networks
// take more freely than where a limb ends.
constexpr double kLimbDeviation = 0.05;
constexpr double kTrunkDeviation = 0.12;
constexpr double kLimbBends = 0.05;
constexpr double kTrunkBends = 0.10;

std::array<LimbLength, kLimbLengths> measured_on_the_mannequin() {
    const motion::Skeleton& body = motion::mannequin_skeleton();
    const motion::WorldPose rest = motion::world_pose(body, motion::Pose{});
    const auto share = [&rest](Bone one, Bone other) {
        return static_cast<double>(glm::distance(rest.position(one), rest.position(other))) /
               kMannequinHeight;
    };
    const auto limb = [](double length) { return LimbLength{length, kLimbDeviation, kLimbBends}; };
    const auto trunk = [](double length) {
        return LimbLength{length, kTrunkDeviation, kTrunkBends};
    };
    return {limb(share(Bone::left_upper_arm, Bone::left_lower_arm)),
            limb(share(Bone::left_lower_arm, Bone::left_hand)),
            limb(share(Bone::left_upper_leg, Bone::left_lower_leg)),
            limb(share(Bone::left_lower_leg, Bone::left_foot)),
            trunk(share(Bone::left_upper_arm, Bone::right_upper_arm)),
            trunk(share(Bone::left_upper_leg, Bone::right_upper_leg)),
            trunk(share(Bone::left_upper_arm, Bone::left_upper_leg))};
}

}  // namespace

const std::array<LimbLength, kLimbLengths>& limb_lengths() {
    static const std::array<LimbLength, kLimbLengths> lengths = measured_on_the_mannequin();
    return lengths;
}

std::span<const DancerLimb> dancer_limbs() noexcept { return kLimbs; }

}  // namespace raks::capture
