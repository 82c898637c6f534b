#include "motion/dance/baking/figure_size.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/dance/body/curves.hpp"
#include "motion/dance/body/limb_ik.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// Index of the first arm bone in kBones
constexpr std::size_t kArms = FigurePassage::kBones.size() - FigurePassage::kArmBones;
constexpr std::size_t kTrunk = 6;  // bones from hips to head, which come first in kBones

/// Below this height of the lower sole there is no jump: one foot steps while the other's heel
/// rolls.
constexpr float kLeastFlight = 0.01F;  // metres

// `rotation` scaled about `middle` (nlerp that may extrapolate), the shorter way round.
glm::quat about(const glm::quat& middle, const glm::quat& rotation, float size) noexcept {
    const float sign = glm::dot(middle, rotation) < 0.0F ? -1.0F : 1.0F;
    return glm::normalize(middle * (1.0F - size) + rotation * (sign * size));
}

// Both feet of a pose, and how far it is off the floor.
struct Feet {
    std::array<FootTarget, 2> targets;
    float flight = 0.0F;  // of the lower sole over the floor
};

Feet feet_of(const Skeleton& skeleton, const Pose& pose) noexcept {
    const WorldPose world = world_body(skeleton, pose);
    Feet feet;
    std::array<float, 2> soles{};
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        const Bone foot = on_side(Bone::left_foot, side);
        feet.targets[s] = {world.position(foot), world.rotation(foot)};
        soles[s] =
            feet.targets[s].ankle.y + lowest_of_sole(skeleton,
                                                     side,
                                                     feet.targets[s].rotation,
                                                     pose.rotation(on_side(Bone::left_toes, side)));
    }
    // The soft limit begins at kLeastFlight; the second term takes off its value at height zero.
    feet.flight = soft_max(0.0F, std::min(soles[0], soles[1]) - kLeastFlight, 2.0F * kLeastFlight) -
                  soft_max(0.0F, -kLeastFlight, 2.0F * kLeastFlight);
    return feet;
}

}  // namespace

FigureMiddle middle_of(const FigurePassage& passage,
                       int beats,
                       bool comes_back,
                       const Skeleton& skeleton) {
    constexpr int kPerBeat = 16;
    // Cosine of half of 120 degrees, the dot product of two quaternions
    constexpr float kFar = 0.5F;
    std::vector<Pose> poses(static_cast<std::size_t>(beats) * kPerBeat);
    FigureMiddle middle;
    middle.comes_back = comes_back;
    std::array<glm::quat, FigurePassage::kBones.size()> sums{};
    for (std::size_t i = 0; i < poses.size(); ++i) {
        Pose& pose = poses[i];
        passage.at(static_cast<double>(i) / kPerBeat, pose);
        const Feet feet = feet_of(skeleton, pose);
        const float share = 1.0F / static_cast<float>(poses.size());
        middle.pose.hips_position +=
            share * (pose.hips_position - glm::vec3(0.0F, feet.flight, 0.0F));
        for (std::size_t s = 0; s < middle.ankles.size(); ++s) {
            middle.ankles[s] += share * feet.targets[s].ankle;
        }
        for (std::size_t bone = 0; bone < sums.size(); ++bone) {
            const glm::quat& rotation = pose.rotation(FigurePassage::kBones[bone]);
            // Summed with one sign: q and -q are the same rotation.
            const bool is_other = i > 0 && glm::dot(sums[bone], rotation) < 0.0F;
            sums[bone] = (i > 0 ? sums[bone] : 0.0F * rotation) + (is_other ? -rotation : rotation);
        }
    }
    for (std::size_t bone = 0; bone < sums.size(); ++bone) {
        const Bone which = FigurePassage::kBones[bone];
        middle.pose.rotation(which) = glm::normalize(sums[bone]);
        middle.turns_about_it[index_of(which)] =
            std::all_of(poses.begin(), poses.end(), [&](const Pose& pose) {
                return std::abs(glm::dot(middle.pose.rotation(which), pose.rotation(which))) > kFar;
            });
    }
    return middle;
}

FigureSize figure_size(const SizeByTempo& law, Bpm learnt, Bpm tempo) noexcept RAKS_NONBLOCKING {
    constexpr double kLowestFlight = 0.5;    // lower limit: half
    constexpr double kHighestFlight = 1.15;  // no higher than a casual leap
    FigureSize size;
    size.body = std::min(1.0F, static_cast<float>(size_at(law.body, learnt, tempo)));
    size.steps = {size.body, size.body};
    size.arms = std::min(1.0F, static_cast<float>(size_at(law.arms, learnt, tempo)));
    // Height of a jump goes with the square of its time, g t^2 / 8.
    if (law.body > 0.0) {
        const double time = learnt.bpm() / tempo.bpm();
        size.flight = static_cast<float>(std::clamp(time * time, kLowestFlight, kHighestFlight));
    }
    return size;
}

void resize(const FigureMiddle& middle,
            const FigureSize& size,
            const Skeleton& skeleton,
            Pose& pose) noexcept RAKS_NONBLOCKING {
    Feet feet = feet_of(skeleton, pose);
    for (std::size_t i = 0; i < FigurePassage::kBones.size(); ++i) {
        const Bone bone = FigurePassage::kBones[i];
        const bool is_leg = i >= kTrunk && i < kArms;
        if (!is_leg && middle.turns_about_it[index_of(bone)]) {
            pose.rotation(bone) = about(middle.pose.rotation(bone),
                                        pose.rotation(bone),
                                        i < kTrunk ? size.body : size.arms);
        }
    }
    const float flown = size.flight * feet.flight;
    // A figure that travels keeps its way: scaled, it would not end where the next one begins.
    const auto sized = [&](const glm::vec3& place, const glm::vec3& centre, float steps) {
        return middle.comes_back ? glm::mix(centre, place, steps) : place;
    };
    const glm::vec3& centre = middle.pose.hips_position;
    const float height = glm::mix(centre.y, pose.hips_position.y - feet.flight, size.body);
    pose.hips_position = sized(pose.hips_position, centre, 0.5F * (size.steps[0] + size.steps[1]));
    pose.hips_position.y = height + flown - size.bend;
    std::array<glm::vec3, 2> ankles{};
    for (std::size_t s = 0; s < ankles.size(); ++s) {
        const float own = feet.targets[s].ankle.y - feet.flight;
        ankles[s] = sized(feet.targets[s].ankle, middle.ankles[s], size.steps[s]);
        ankles[s].y = own + flown;
    }
    // Longer steps and straighter knees than learnt may reach too far.
    lower_to_reach(skeleton, ankles, pose);
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        solve_leg(skeleton, side, {ankles[s], feet.targets[s].rotation}, pose);
    }
}

}  // namespace raks::motion
