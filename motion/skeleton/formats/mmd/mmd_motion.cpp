#include "motion/skeleton/formats/mmd/mmd_motion.hpp"

#include <algorithm>
#include <cmath>

namespace raks::motion {
namespace {

// The last key at or before a frame, from a key that was it before.
template <typename Key>
std::size_t advanced(const std::vector<Key>& keys, std::size_t at, std::uint32_t frame) {
    while (at + 1 < keys.size() && keys[at + 1].frame <= frame) {
        ++at;
    }
    return at;
}

// How far a frame lies between two keys; 0 before the first of them.
double share_of(std::uint32_t from, std::uint32_t to, std::uint32_t frame) {
    return frame <= from ? 0.0 : static_cast<double>(frame - from) / static_cast<double>(to - from);
}

// A bone between two keys.
void put_between(const MmdBoneKey& from,
                 const MmdBoneKey& to,
                 double share,
                 glm::dvec3& place,
                 glm::dquat& turn) {
    const glm::dvec3 start(from.place);
    const glm::dvec3 way = glm::dvec3(to.place) - start;
    if (from.place != to.place) {
        for (int axis = 0; axis < 3; ++axis) {
            place[axis] =
                start[axis] +
                way[axis] * mmd_progress(to.curves[static_cast<std::size_t>(axis)], share);
        }
    } else {
        place = start;
    }
    // glm goes the shorter way.
    turn = glm::normalize(
        glm::slerp(glm::dquat(from.turn), glm::dquat(to.turn), mmd_progress(to.curves[3], share)));
}

bool switch_at(const std::vector<MmdSwitchKey>& keys, std::uint32_t frame) {
    if (keys.empty()) {
        return true;
    }
    const auto behind = std::upper_bound(
        keys.begin(), keys.end(), frame, [](std::uint32_t at, const MmdSwitchKey& key) {
            return at < key.frame;
        });
    return behind == keys.begin() ? keys.front().is_on : std::prev(behind)->is_on;
}

}  // namespace

double mmd_progress(const MmdCurve& curve, double share) {
    const bool is_straight = curve.x1 == curve.y1 && curve.x2 == curve.y2;
    if (is_straight || share <= 0.0 || share >= 1.0) {
        return share;
    }
    const auto at = [](double first, double second, double t) {
        const double rest = 1.0 - t;
        return 3.0 * rest * rest * t * first + 3.0 * rest * t * t * second + t * t * t;
    };
    constexpr double kEnd = 127.0;  // of the curve, in both directions
    const auto handle = [](std::uint8_t value) {
        return std::min(static_cast<double>(value) / kEnd, 1.0);
    };
    // x grows with t, so that halving finds the moment.
    constexpr int kHalvings = 24;  // 6e-8 of the time
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        (at(handle(curve.x1), handle(curve.x2), middle) < share ? low : high) = middle;
    }
    return at(handle(curve.y1), handle(curve.y2), 0.5 * (low + high));
}

bool MmdMotion::has_body() const {
    return std::any_of(bones.begin(), bones.end(), [](const auto& keys) { return !keys.empty(); });
}

std::uint32_t MmdMotion::last_frame() const {
    std::uint32_t last = 0;
    for (const auto& keys : bones) {
        last = std::max(last, keys.empty() ? 0U : keys.back().frame);
    }
    for (const auto& keys : morphs) {
        last = std::max(last, keys.empty() ? 0U : keys.back().frame);
    }
    return last;
}

MmdPose MmdSampler::pose_at(std::uint32_t frame) {
    MmdPose pose;
    for (std::size_t bone = 0; bone < kMmdBones; ++bone) {
        const std::vector<MmdBoneKey>& keys = motion_->bones[bone];
        if (keys.empty()) {
            continue;
        }
        const std::size_t at = bone_keys_[bone] = advanced(keys, bone_keys_[bone], frame);
        const std::size_t next = std::min(at + 1, keys.size() - 1);
        const double share = next == at ? 0.0 : share_of(keys[at].frame, keys[next].frame, frame);
        put_between(keys[at], keys[next], share, pose.places[bone], pose.turns[bone]);
    }
    for (std::size_t side = 0; side < 2; ++side) {
        pose.leg_ik[side] = switch_at(motion_->leg_ik[side], frame);
        pose.toe_ik[side] = switch_at(motion_->toe_ik[side], frame);
    }
    return pose;
}

std::array<float, kMmdMorphs> MmdSampler::morphs_at(std::uint32_t frame) {
    std::array<float, kMmdMorphs> weights{};
    for (std::size_t morph = 0; morph < kMmdMorphs; ++morph) {
        const std::vector<MmdMorphKey>& keys = motion_->morphs[morph];
        if (keys.empty()) {
            continue;
        }
        const std::size_t at = morph_keys_[morph] = advanced(keys, morph_keys_[morph], frame);
        const std::size_t next = std::min(at + 1, keys.size() - 1);
        const double share = next == at ? 0.0 : share_of(keys[at].frame, keys[next].frame, frame);
        weights[morph] = static_cast<float>(
            std::lerp(static_cast<double>(keys[at].weight), keys[next].weight, share));
    }
    return weights;
}

}  // namespace raks::motion
