#include "engine/trials/trunk_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/statistics.hpp"

namespace raks::engine {
namespace {

using motion::Bone;

constexpr std::array<Bone, 4> kTrunk = {Bone::hips, Bone::spine, Bone::chest, Bone::upper_chest};
constexpr std::size_t kLeastPoints = 3;
constexpr double kOuter = 0.9;  // a few vertices may stand out

std::size_t sector_of(float x, float z, std::size_t sectors) noexcept {
    const float turn = std::atan2(z, x) / (2.0F * std::numbers::pi_v<float>)+0.5F;
    return std::min(static_cast<std::size_t>(turn * static_cast<float>(sectors)), sectors - 1);
}

}  // namespace

TrunkProfile::TrunkProfile(const render::SkinnedMesh& mesh,
                           std::span<const glm::vec3> at_rest,
                           const motion::WorldPose& bones)
    : bones_(bones),
      low_(bones.position(Bone::hips).y),
      high_(bones.position(Bone::left_upper_arm).y) {
    // Below the armpits, where the arms begin.
    high_ -= 0.25F * (high_ - low_);
    const float within = 2.0F * std::abs(bones.position(Bone::left_upper_arm).x);
    std::array<std::vector<glm::vec3>, kSlices> slices;
    for (std::size_t i = 0; i < at_rest.size(); ++i) {
        const float share = (at_rest[i].y - low_) / std::max(high_ - low_, 1e-3F);
        if (mesh.bone(i) <= index_of(Bone::upper_chest) && share >= 0.0F && share < 1.0F &&
            std::abs(at_rest[i].x) < within) {
            slices[static_cast<std::size_t>(share * static_cast<float>(kSlices))].push_back(
                at_rest[i]);
        }
    }
    for (std::size_t s = 0; s < kSlices; ++s) {
        std::vector<double> ahead;
        for (const glm::vec3& place : slices[s]) {
            ahead.push_back(static_cast<double>(place.z));
        }
        middle_[s] =
            static_cast<float>(0.5 * (percentile(ahead, kOuter) + percentile(ahead, 1.0 - kOuter)));
        std::array<std::vector<double>, kSides> reaches;
        for (const glm::vec3& place : slices[s]) {
            const float z = place.z - middle_[s];
            reaches[sector_of(place.x, z, kSides)].push_back(
                static_cast<double>(std::hypot(place.x, z)));
        }
        for (std::size_t side = 0; side < kSides; ++side) {
            if (reaches[side].size() >= kLeastPoints) {
                reach_[s][side] = static_cast<float>(percentile(std::move(reaches[side]), kOuter));
            }
        }
    }
}

float TrunkProfile::depth_at_rest(const glm::vec3& place) const noexcept {
    const float share = (place.y - low_) / std::max(high_ - low_, 1e-3F);
    if (!(share >= 0.0F && share < 1.0F)) {
        return 0.0F;
    }
    const auto slice = static_cast<std::size_t>(share * static_cast<float>(kSlices));
    const float z = place.z - middle_[slice];
    return std::max(reach_[slice][sector_of(place.x, z, kSides)] - std::hypot(place.x, z), 0.0F);
}

float TrunkProfile::depth(const glm::vec3& place, const motion::WorldPose& bones) const noexcept {
    float deepest = 0.0F;
    for (std::size_t i = 0; i < kTrunk.size(); ++i) {
        const Bone bone = kTrunk[i];
        const glm::vec3 at_rest = bones_.position(bone) + glm::conjugate(bones.rotation(bone)) *
                                                              (place - bones.position(bone));
        const bool is_last = i + 1 == kTrunk.size();
        const bool is_above = at_rest.y >= bones_.position(bone).y;
        if (is_above && (is_last || at_rest.y < bones_.position(kTrunk[i + 1]).y)) {
            deepest = std::max(deepest, depth_at_rest(at_rest));
        }
    }
    return deepest;
}

}  // namespace raks::engine
