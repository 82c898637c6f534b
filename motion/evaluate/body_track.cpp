#include "motion/evaluate/body_track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr std::array<Bone, 2> kFeet = {Bone::left_foot, Bone::right_foot};

// Tip of a foot: end site of the toes' joint, or of the foot's where there are no toes; without an
// end site the joint itself.
glm::dvec3 end_of_foot(const MotionClip& clip,
                       const HumanoidMapping& mapping,
                       const ClipWorldPose& world,
                       Side side) {
    const std::optional<std::size_t> toes = mapping.joint(on_side(Bone::left_toes, side));
    const std::size_t joint =
        toes ? *toes : mapping.joint(on_side(Bone::left_foot, side)).value_or(0);
    const glm::dvec3 tip = clip.joints[joint].end_site.value_or(glm::dvec3(0.0));
    return world.positions[joint] + world.rotations[joint] * tip;
}

}  // namespace

BodyTrack body_track(const Skeleton& skeleton,
                     std::span<const Pose> poses,
                     double frames_per_second) {
    BodyTrack track;
    track.frames_per_second = frames_per_second;
    track.joints.resize(poses.size());
    track.feet.resize(poses.size());
    for (std::size_t f = 0; f < poses.size(); ++f) {
        const WorldPose world = world_body(skeleton, poses[f]);
        for (std::size_t j = 0; j < kBodyBones.size(); ++j) {
            track.joints[f][j] = world.position(kBodyBones[j]);
        }
        for (const Side side : kSides) {
            track.feet[f][static_cast<std::size_t>(side)] = {
                glm::dvec3(world.position(on_side(Bone::left_foot, side))),
                glm::dvec3(toe_tip(skeleton, world, side))};
        }
    }
    return track;
}

Expected<BodyTrack> body_track(const MotionClip& recorded, double metres_per_unit) {
    BodyOptions options;
    options.metres_per_unit = metres_per_unit;
    const Expected<StandingClip> standing = stand(recorded, options);
    if (!standing) {
        return tl::unexpected(standing.error());
    }
    const MotionClip& clip = standing->clip;
    const HumanoidMapping& mapping = standing->body.mapping();
    // Metrics sum over all 19 joints, so none may be missing.
    for (const Bone bone : kBodyBones) {
        if (!mapping.joint(bone)) {
            return fail("the body has no " + std::string(kBoneNames[index_of(bone)]) +
                        ", which the metrics need");
        }
    }
    BodyTrack track;
    track.frames_per_second = clip.frames_per_second;
    track.joints.resize(clip.frame_count);
    track.feet.resize(clip.frame_count);
    for (std::size_t f = 0; f < clip.frame_count; ++f) {
        const ClipWorldPose world = world_pose(clip, f);
        for (std::size_t j = 0; j < kBodyBones.size(); ++j) {
            track.joints[f][j] = metres_per_unit * world.positions[*mapping.joint(kBodyBones[j])];
        }
        for (const Side side : kSides) {
            const std::size_t s = static_cast<std::size_t>(side);
            track.feet[f][s] = {metres_per_unit * world.positions[*mapping.joint(kFeet[s])],
                                metres_per_unit * end_of_foot(clip, mapping, world, side)};
        }
    }
    return track;
}

std::vector<Pose> resampled(std::span<const Pose> poses, double from, double to) {
    std::vector<Pose> result;
    if (poses.empty()) {
        return result;
    }
    const double last = static_cast<double>(poses.size() - 1);
    for (std::size_t i = 0;; ++i) {
        const double at = static_cast<double>(i) * from / to;
        // Ends at the last pose: nothing is extrapolated.
        if (at > last) {
            return result;
        }
        result.push_back(pose_between(poses, at));
    }
}

Places smoothed(const Places& places) {
    // Binomial coefficients, which sum to 1.
    constexpr std::array<double, 5> kTaps = {1.0 / 16, 4.0 / 16, 6.0 / 16, 4.0 / 16, 1.0 / 16};
    const auto last = static_cast<std::ptrdiff_t>(places.size()) - 1;
    Places result(places.size(), glm::dvec3(0.0));
    for (std::ptrdiff_t i = 0; i <= last; ++i) {
        for (std::ptrdiff_t k = 0; k < 5; ++k) {
            const std::ptrdiff_t at = std::clamp<std::ptrdiff_t>(i + k - 2, 0, last);
            result[static_cast<std::size_t>(i)] +=
                kTaps[static_cast<std::size_t>(k)] * places[static_cast<std::size_t>(at)];
        }
    }
    return result;
}

std::vector<double> speeds(const Places& places, double frames_per_second) {
    std::vector<double> result(places.size(), 0.0);
    for (std::size_t i = 0; places.size() > 1 && i < places.size(); ++i) {
        const std::size_t before = i > 0 ? i - 1 : 0;
        const std::size_t after = std::min(i + 1, places.size() - 1);
        result[i] = glm::length(places[after] - places[before]) * frames_per_second /
                    static_cast<double>(after - before);
    }
    return result;
}

Places joint_places(const BodyTrack& track, std::size_t joint) {
    Places places(track.frames());
    for (std::size_t f = 0; f < track.frames(); ++f) {
        places[f] = track.joints[f][joint];
    }
    return places;
}

Places toe_places(const BodyTrack& track, Side side) {
    Places places(track.frames());
    for (std::size_t f = 0; f < track.frames(); ++f) {
        places[f] = track.feet[f][static_cast<std::size_t>(side)].toe_tip;
    }
    return places;
}

Places foot_places(const BodyTrack& track, Side side, double from_ankle) {
    Places places = toe_places(track, side);
    for (std::size_t f = 0; f < track.frames(); ++f) {
        const glm::dvec3& ankle = track.feet[f][static_cast<std::size_t>(side)].ankle;
        const double length = glm::distance(ankle, places[f]);
        // A foot shorter than that ends at its tip.
        if (length > from_ankle) {
            places[f] = glm::mix(ankle, places[f], from_ankle / length);
        }
    }
    return places;
}

}  // namespace raks::motion
