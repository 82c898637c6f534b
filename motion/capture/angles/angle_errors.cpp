#include "motion/capture/angles/angle_errors.hpp"

#include <algorithm>
#include <cmath>

#include "motion/skeleton/skeleton.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::capture {
namespace {

using motion::Bone;

constexpr double kLostMean = 0.1;  // metres
constexpr double kDegrees = 180.0 / M_PI;

double angle_between(const glm::dquat& one, const glm::dquat& other) {
    return kDegrees * glm::length(turn_vector(glm::conjugate(one) * other));
}

/// Where bones are and how they are turned.
struct BonePlaces {
    std::array<glm::dvec3, motion::kBoneCount> places{};
    std::array<glm::dquat, motion::kBoneCount> turns{};

    [[nodiscard]] glm::dquat relative(Bone bone, Bone to) const {
        return glm::conjugate(turns[index_of(to)]) * turns[index_of(bone)];
    }
};

BonePlaces places_of(const motion::WorldPose& world) {
    BonePlaces bones;
    for (std::size_t i = 0; i < motion::kBoneCount; ++i) {
        bones.places[i] = world.positions[i];
        bones.turns[i] = glm::normalize(glm::dquat(world.rotations[i]));
    }
    return bones;
}

BonePlaces places_of(const PlacedBody& body) {
    BonePlaces bones;
    for (std::size_t i = 0; i < motion::kBoneCount; ++i) {
        bones.places[i] = body.places[i];
        bones.turns[i] = glm::quat_cast(body.frames[i]);
    }
    return bones;
}

void add_frame(const BonePlaces& found, const BonePlaces& truth, bool is_lost, AngleErrors& sum) {
    constexpr auto kJoints = static_cast<double>(kComparedJoints.size());
    double mean = 0.0;
    std::array<double, kComparedJoints.size()> apart{};
    for (std::size_t i = 0; i < apart.size(); ++i) {
        const std::size_t bone = index_of(kComparedJoints[i]);
        apart[i] = glm::distance(found.places[bone], truth.places[bone]);
        sum.joints[i] += apart[i];
        mean += apart[i] / kJoints;
    }
    for (std::size_t limb = 0; limb < sum.limbs.size(); ++limb) {
        const std::size_t first = 2 + 3 * limb;  // after hips and neck, three a limb
        const double off = 0.5 * (apart[first + 1] + apart[first + 2]);
        sum.limbs[limb] += off;
        sum.worst_limbs[limb] = std::max(sum.worst_limbs[limb], off);
    }
    sum.mean += mean;
    sum.lost += is_lost || mean > kLostMean ? 1U : 0U;
    sum.frames += 1;
    sum.root += angle_between(found.turns[0], truth.turns[0]);
    for (const Bone left : {Bone::left_upper_arm, Bone::left_upper_leg}) {
        for (const motion::Side side : motion::kSides) {
            const Bone upper = motion::on_side(left, side);
            const auto lower = static_cast<Bone>(index_of(upper) + 1);
            sum.balls += 0.25 * angle_between(found.relative(upper, Bone::hips),
                                              truth.relative(upper, Bone::hips));
            sum.hinges +=
                0.25 * angle_between(found.relative(lower, upper), truth.relative(lower, upper));
        }
    }
}

}  // namespace

AngleErrors angle_errors(const AngleTrack& track,
                         const BodyModel& model,
                         const BodyShape& shape,
                         std::span<const motion::Pose> truth,
                         double true_frames_per_second) {
    AngleErrors errors;
    for (std::size_t frame = 0; frame < track.states.size(); ++frame) {
        const double at = track.time_of(frame) * true_frames_per_second;
        if (!(at > -1e-6 && at < static_cast<double>(truth.size()) - 1.0 + 1e-6)) {
            continue;
        }
        const motion::Pose pose = motion::pose_between(truth, std::max(0.0, at));
        add_frame(places_of(model.place(shape, track.states[frame])),
                  places_of(motion::world_pose(motion::mannequin_skeleton(), pose)),
                  track.is_lost[frame],
                  errors);
    }
    const double share = errors.frames > 0 ? 1.0 / static_cast<double>(errors.frames) : 0.0;
    for (double* const sum : {&errors.mean, &errors.root, &errors.balls, &errors.hinges}) {
        *sum *= share;
    }
    for (double& sum : errors.joints) {
        sum *= share;
    }
    for (double& sum : errors.limbs) {
        sum *= share;
    }
    return errors;
}

}  // namespace raks::capture
