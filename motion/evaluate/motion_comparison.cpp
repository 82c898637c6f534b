#include "motion/evaluate/motion_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/statistics.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

/// Joints and toe tips at one moment.
struct Moment {
    std::array<glm::dvec3, kBodyBones.size()> joints{};
    std::array<glm::dvec3, 2> toes{};
};

/// The moment at a fractional frame, which the track has.
Moment moment_at(const BodyTrack& track, double frame) {
    const auto before = static_cast<std::size_t>(frame);
    const std::size_t after = std::min(before + 1, track.frames() - 1);
    const double share = frame - static_cast<double>(before);
    Moment moment;
    for (std::size_t i = 0; i < moment.joints.size(); ++i) {
        moment.joints[i] = glm::mix(track.joints[before][i], track.joints[after][i], share);
    }
    for (std::size_t side = 0; side < 2; ++side) {
        moment.toes[side] =
            glm::mix(track.feet[before][side].toe_tip, track.feet[after][side].toe_tip, share);
    }
    return moment;
}

/// By joint: the joint that its bone leads to; itself where none does. Where several do (hips,
/// chest), the one along the trunk, which comes first in kBodyBones.
std::array<std::size_t, kBodyBones.size()> next_joints() {
    std::array<std::size_t, kBodyBones.size()> next{};
    for (std::size_t i = 0; i < next.size(); ++i) {
        next[i] = i;
        for (std::size_t k = next.size(); k-- > i + 1;) {
            std::size_t parent = kBoneParents[index_of(kBodyBones[k])];
            while (std::find(kBodyBones.begin(), kBodyBones.end(), static_cast<Bone>(parent)) ==
                   kBodyBones.end()) {
                parent = kBoneParents[parent];  // the upper chest is none of the 19
            }
            next[i] = static_cast<Bone>(parent) == kBodyBones[i] ? k : next[i];
        }
    }
    return next;
}

double angle_between(const glm::dvec3& one, const glm::dvec3& other) {
    return std::atan2(glm::length(glm::cross(one, other)), glm::dot(one, other)) * 180.0 / M_PI;
}

void add(const Moment& one, const Moment& other, MotionComparison& sums) {
    static const std::array<std::size_t, kBodyBones.size()> kNext = next_joints();
    const glm::dvec3 hips = other.joints[kHips] - one.joints[kHips];
    const auto add_place = [&hips](
                               const glm::dvec3& is, const glm::dvec3& was, JointDifference& to) {
        to.world += glm::distance(is, was);
        to.from_hips += glm::distance(is + hips, was);
    };
    for (std::size_t i = 0; i < one.joints.size(); ++i) {
        add_place(one.joints[i], other.joints[i], sums.joints[i]);
        if (kNext[i] != i) {
            sums.joints[i].angle = sums.joints[i].angle.value_or(0.0) +
                                   angle_between(one.joints[kNext[i]] - one.joints[i],
                                                 other.joints[kNext[i]] - other.joints[i]);
        }
    }
    for (std::size_t side = 0; side < 2; ++side) {
        add_place(one.toes[side], other.toes[side], sums.toes[side]);
    }
}

/// Makes means over the joints of means over time.
void summarize_joints(MotionComparison& comparison) {
    double bones = 0.0;
    for (std::size_t i = 0; i < comparison.joints.size(); ++i) {
        const JointDifference& joint = comparison.joints[i];
        comparison.from_hips += joint.from_hips / static_cast<double>(kBodyBones.size() - 1);
        comparison.world += joint.world / static_cast<double>(kBodyBones.size());
        if (kBodyBones[i] == Bone::left_foot || kBodyBones[i] == Bone::right_foot) {
            comparison.feet += 0.5 * joint.from_hips;
        }
        comparison.angle += joint.angle.value_or(0.0);
        bones += joint.angle ? 1.0 : 0.0;
    }
    comparison.angle /= bones;
}

/// The frame of `other`, fractional, at a frame of `one`; nothing: it has none then.
std::optional<double> frame_of_other(const BodyTrack& one,
                                     const BodyTrack& other,
                                     double shift,
                                     std::size_t frame) {
    const double seconds = static_cast<double>(frame) / one.frames_per_second - shift;
    const double at = seconds * other.frames_per_second;
    // Rounding of a rate in a file must not lose the last frame.
    constexpr double kNearly = 1e-3;
    const double last = static_cast<double>(other.frames()) - 1.0;
    if (at < -kNearly || at > last + kNearly) {
        return std::nullopt;
    }
    return std::clamp(at, 0.0, last);
}

/// By frame, whether the toe stands.
std::vector<bool> standing(const Places& toe, double frames_per_second) {
    constexpr double kSlow = 0.12;       // m/s
    constexpr double kLowEnough = 0.03;  // metres above where it is lowest
    constexpr double kLowest = 0.05;
    std::vector<double> heights;
    heights.reserve(toe.size());
    for (const glm::dvec3& place : toe) {
        heights.push_back(place.y);
    }
    const double low = percentile(heights, kLowest) + kLowEnough;
    const std::vector<double> speed = speeds(smoothed(toe), frames_per_second);
    std::vector<bool> stands(toe.size());
    for (std::size_t frame = 0; frame < toe.size(); ++frame) {
        stands[frame] = speed[frame] < kSlow && heights[frame] < low;
    }
    return stands;
}

std::optional<double> planted_toes(const BodyTrack& one, const BodyTrack& other, double shift) {
    constexpr double kNineTenths = 0.9;
    std::vector<double> planted;
    for (const Side side : {Side::left, Side::right}) {
        const std::vector<bool> stands = standing(toe_places(one, side), one.frames_per_second);
        const std::vector<double> speed =
            speeds(smoothed(toe_places(other, side)), other.frames_per_second);
        for (std::size_t frame = 0; frame < one.frames(); ++frame) {
            const auto at = frame_of_other(one, other, shift, frame);
            if (at && stands[frame]) {
                planted.push_back(speed[static_cast<std::size_t>(std::lround(*at))]);
            }
        }
    }
    return planted.empty() ? std::nullopt : std::optional(percentile(planted, kNineTenths));
}

}  // namespace

Expected<MotionComparison> compare_motions(const BodyTrack& one,
                                           const BodyTrack& other,
                                           double shift) {
    MotionComparison comparison;
    double count = 0.0;
    for (std::size_t frame = 0; frame < one.frames(); ++frame) {
        if (const auto at = frame_of_other(one, other, shift, frame)) {
            add(moment_at(one, static_cast<double>(frame)), moment_at(other, *at), comparison);
            count += 1.0;
        }
    }
    if (count == 0.0) {
        return fail("the two motions have no moment in common; is the shift right?");
    }
    const auto divide = [count](JointDifference& joint) {
        joint.from_hips /= count;
        joint.world /= count;
        if (joint.angle) {
            *joint.angle /= count;
        }
    };
    std::for_each(comparison.joints.begin(), comparison.joints.end(), divide);
    std::for_each(comparison.toes.begin(), comparison.toes.end(), divide);
    comparison.seconds = count / one.frames_per_second;
    summarize_joints(comparison);
    comparison.planted_toes = planted_toes(one, other, shift);
    return comparison;
}

}  // namespace raks::motion
