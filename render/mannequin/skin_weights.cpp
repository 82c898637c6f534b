#include "render/mannequin/skin_weights.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/smooth_steps.hpp"
#include "render/mannequin/body_field.hpp"

namespace raks::render {
namespace {

using motion::Bone;

constexpr float kShoulderLift = 0.030F;  // metres, by eye

// A helper of the left side; the right one has another name and mirrored bones.
struct LeftHelper {
    std::string_view left_name;
    std::string_view right_name;
    HelperKind kind;
    Bone parent;
    Bone source;
    glm::vec3 roll_axis;
};

// Roll axes: in the T-pose the arm's bones lie along x, the leg's along y.
constexpr glm::vec3 kAlongArmAxis{1.0F, 0.0F, 0.0F};
constexpr glm::vec3 kAlongLegAxis{0.0F, 1.0F, 0.0F};

constexpr std::array kLeftHelpers = {
    LeftHelper{"leftShoulderHalf",
               "rightShoulderHalf",
               HelperKind::half_swing,
               Bone::left_shoulder,
               Bone::left_upper_arm,
               kAlongArmAxis},
    LeftHelper{"leftUpperArmTwist",
               "rightUpperArmTwist",
               HelperKind::swing_half_roll,
               Bone::left_shoulder,
               Bone::left_upper_arm,
               kAlongArmAxis},
    LeftHelper{"leftElbowHalf",
               "rightElbowHalf",
               HelperKind::half_rotation,
               Bone::left_upper_arm,
               Bone::left_lower_arm,
               kAlongArmAxis},
    LeftHelper{"leftLowerArmTwist",
               "rightLowerArmTwist",
               HelperKind::half_roll,
               Bone::left_lower_arm,
               Bone::left_hand,
               kAlongArmAxis},
    LeftHelper{"leftHipHalf",
               "rightHipHalf",
               HelperKind::half_swing,
               Bone::hips,
               Bone::left_upper_leg,
               kAlongLegAxis},
    LeftHelper{"leftUpperLegTwist",
               "rightUpperLegTwist",
               HelperKind::swing_half_roll,
               Bone::hips,
               Bone::left_upper_leg,
               kAlongLegAxis},
    LeftHelper{"leftKneeHalf",
               "rightKneeHalf",
               HelperKind::half_rotation,
               Bone::left_upper_leg,
               Bone::left_lower_leg,
               kAlongLegAxis},
};
static_assert(2 * kLeftHelpers.size() == kHelperCount);

/// The helper on one side of the body, placed by the skeleton's rest offsets.
HelperJoint on_side(const LeftHelper& left,
                    motion::Side side,
                    const motion::Skeleton& skeleton) noexcept {
    HelperJoint helper;
    helper.name = side == motion::Side::left ? left.left_name : left.right_name;
    helper.kind = left.kind;
    helper.parent = motion::on_side(left.parent, side);
    helper.source = motion::on_side(left.source, side);
    helper.roll_axis = left.roll_axis;
    // The forearm's helper turns about the elbow, all others about their source's joint.
    helper.offset = left.kind == HelperKind::half_roll
                        ? glm::vec3{0.0F}
                        : skeleton.offsets[motion::index_of(helper.source)];
    // Only the armpit's helper is lifted under a raised arm.
    const bool is_shoulder =
        left.kind == HelperKind::half_swing && left.source == Bone::left_upper_arm;
    helper.lift = is_shoulder ? kShoulderLift : 0.0F;
    return helper;
}

}  // namespace

std::array<HelperJoint, kHelperCount> mannequin_helpers(const motion::Skeleton& skeleton) noexcept {
    std::array<HelperJoint, kHelperCount> helpers{};
    for (std::size_t i = 0; i < kLeftHelpers.size(); ++i) {
        helpers[i] = on_side(kLeftHelpers[i], motion::Side::left, skeleton);
        helpers[i + kLeftHelpers.size()] = on_side(kLeftHelpers[i], motion::Side::right, skeleton);
    }
    return helpers;
}

namespace {

constexpr int kSmoothingPasses = 3;
constexpr float kTowardNeighbours = 0.5F;

/// One pass of Laplacian smoothing: half of every vertex's weights, half the mean of its
/// neighbours'.
std::vector<JointShares> smoothed(const std::vector<JointShares>& shares,
                                  const Neighbours& neighbours) {
    std::vector<JointShares> result(shares.size());
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const auto around = neighbours.of(i);
        const float each = kTowardNeighbours / static_cast<float>(around.size());
        JointShares& mixed = result[i];
        for (std::size_t j = 0; j < mixed.size(); ++j) {
            mixed[j] = (1.0F - kTowardNeighbours) * shares[i][j];
        }
        for (const std::uint32_t neighbour : around) {
            const JointShares& other = shares[neighbour / 2];
            for (std::size_t j = 0; j < mixed.size(); ++j) {
                // A neighbour on the right half has the weights of its left image with the sides
                // exchanged.
                mixed[neighbour % 2 == 0 ? j : mirrored_joint(j)] += each * other[j];
            }
        }
    }
    return result;
}

/// Takes the other side's joints off the skin away from the middle, where smoothing brought them.
void keep_sides_apart(glm::vec3 p, JointShares& shares) noexcept {
    constexpr float kShared = 0.008F;  // metres from the middle
    constexpr float kApart = 0.020F;
    const float kept = 1.0F - smootherstep(kShared, kApart, p.x);
    const auto fade = [&](std::size_t joint) { shares[joint] *= kept; };
    // The right side's bones, and helpers, are last in their order.
    for (std::size_t bone = motion::index_of(motion::Bone::right_upper_leg);
         bone < motion::kBoneNames.size();
         ++bone) {
        fade(bone);
    }
    for (auto helper = static_cast<std::size_t>(Helper::right_shoulder_half); helper < kPaletteSize;
         ++helper) {
        fade(helper);
    }
}

/// The four largest, rounded so that they sum to 255: the rest goes to the largest.
PackedWeights pack(const JointShares& shares) noexcept {
    std::array<std::uint8_t, kPaletteSize> order{};
    std::iota(order.begin(), order.end(), std::uint8_t{0});
    std::partial_sort(
        order.begin(), order.begin() + 4, order.end(), [&](std::uint8_t a, std::uint8_t b) {
            // Equal weights are ordered by joint, so that the result does not depend on the sort.
            return shares[a] != shares[b] ? shares[a] > shares[b] : a < b;
        });
    float sum = 0.0F;
    for (std::size_t k = 0; k < 4; ++k) {
        sum += shares[order[k]];
    }
    PackedWeights packed;
    int left = 255;
    for (std::size_t k = 0; k < 4; ++k) {
        // The four kept ones are scaled up to a sum of 1 before rounding.
        const float exact = 255.0F * shares[order[k]] / sum;
        const auto rounded = static_cast<std::uint8_t>(std::lround(exact));
        packed.weights[k] = rounded;
        packed.joints[k] = rounded > 0 ? order[k] : order[0];
        left -= rounded;
    }
    packed.weights[0] = static_cast<std::uint8_t>(packed.weights[0] + left);
    return packed;
}

}  // namespace

std::vector<PackedWeights> skin_weights(const BodyField& field,
                                        const BindFrames& frames,
                                        const MirroredMesh& mesh,
                                        const Neighbours& neighbours) {
    const SkinRule rule(field, frames);
    std::vector<JointShares> shares;
    shares.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions) {
        shares.push_back(rule.at(p));
    }
    for (int pass = 0; pass < kSmoothingPasses; ++pass) {
        shares = smoothed(shares, neighbours);
    }
    std::vector<PackedWeights> packed;
    packed.reserve(shares.size());
    for (std::size_t i = 0; i < shares.size(); ++i) {
        // Behind the smoothing, which is what carries the other side's joints over.
        keep_sides_apart(mesh.positions[i], shares[i]);
        packed.push_back(pack(shares[i]));
    }
    return packed;
}

}  // namespace raks::render
