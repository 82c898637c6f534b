#include "motion/dance/baking/feature_pose.hpp"

#include <algorithm>
#include <cmath>

#include "motion/dance/body/limb_ik.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

namespace raks::motion {
namespace {

constexpr glm::vec3 kLeft{1.0F, 0.0F, 0.0F};
constexpr glm::vec3 kUp{0.0F, 1.0F, 0.0F};
constexpr glm::vec3 kAhead{0.0F, 0.0F, 1.0F};
// Sine of a limb's bend below which its plane is more noise than posture. Below it the direction
// carried over from the parent bone is mixed in, the more the straighter the limb is.
constexpr float kKnownBend = 0.3F;
constexpr float kCarriedFoot = 0.1F;  // weight of the shin's sideways axis against a level sole

constexpr float kPointsNowhere = 1e-5F;  // metres; shorter vectors have no direction

/// Unit vector; `otherwise` where there is none.
glm::vec3 unit(const glm::vec3& vector, const glm::vec3& otherwise) noexcept {
    const float length = glm::length(vector);
    return length > kPointsNowhere ? vector / length : otherwise;
}

// Right-handed orthonormal frame: x along `first`, y in the plane of both towards `second`.
glm::mat3 frame_of(const glm::vec3& first, const glm::vec3& second) noexcept {
    const glm::vec3 x = unit(first, kLeft);
    const glm::vec3 across = glm::normalize(glm::cross(x, std::abs(x.y) < 0.9F ? kUp : kLeft));
    const glm::vec3 z = unit(glm::cross(x, second), across);
    return {x, glm::cross(z, x), z};
}

/// A direction of a bone at rest, in its own frame, and its wanted direction in the world.
struct Pointing {
    glm::vec3 at_rest;
    glm::vec3 wanted;
};

/// The rotation that turns the first direction exactly, and the second as nearly as that allows.
glm::quat turned_to(const Pointing& first, const Pointing& second) noexcept {
    return glm::normalize(glm::quat_cast(frame_of(first.wanted, second.wanted) *
                                         glm::transpose(frame_of(first.at_rest, second.at_rest))));
}

/// Soft limit of a joint's turn against its parent, radians: free up to `free`, then approaching
/// `most`. Places that vary independently may ask for more than a neck can turn.
struct JointReach {
    float free;
    float most;
};
constexpr JointReach kAnywhere{glm::radians(360.0F), glm::radians(360.0F)};
constexpr JointReach kNeck{glm::radians(45.0F), glm::radians(70.0F)};
constexpr JointReach kCollarbone{glm::radians(35.0F), glm::radians(55.0F)};

// `wanted` drawn back to `parent` along the shorter arc until the limit is kept (tanh).
glm::quat held(const glm::quat& parent, const glm::quat& wanted, const JointReach& reach) noexcept {
    const float angle = 2.0F * std::acos(std::min(1.0F, std::abs(glm::dot(parent, wanted))));
    if (angle <= reach.free) {
        return wanted;
    }
    const float span = reach.most - reach.free;
    const float given = reach.free + span * std::tanh((angle - reach.free) / span);
    return glm::slerp(parent, wanted, given / angle);
}

/// Builds a body from the hips outward: each joint is placed by its parent, then its bone is
/// turned.
class Body {
 public:
    Body(const Skeleton& skeleton, const JointPlaces& places) noexcept
        : skeleton_(skeleton), places_(places) {}

    Pose built() noexcept {
        set_hips();
        set_trunk();
        for (const Side side : kSides) {
            set_arm(side);
            set_leg(side);
        }
        return pose_;
    }

 private:
    [[nodiscard]] const glm::vec3& wanted(Bone bone) const noexcept {
        return places_[index_of(bone)];
    }
    [[nodiscard]] const glm::vec3& offset(Bone bone) const noexcept {
        return skeleton_.offsets[index_of(bone)];
    }
    [[nodiscard]] static Bone parent_of(Bone bone) noexcept {
        return static_cast<Bone>(kBoneParents[index_of(bone)]);
    }
    [[nodiscard]] const glm::quat& rotation(Bone bone) const noexcept {
        return world_.rotations[index_of(bone)];
    }
    /// Place of the bone's joint in the world, once its parent is turned.
    const glm::vec3& place(Bone bone) noexcept {
        glm::vec3& at = world_.positions[index_of(bone)];
        at = world_.position(parent_of(bone)) + rotation(parent_of(bone)) * offset(bone);
        return at;
    }
    /// Sets the bone's world rotation, and the local one that gives it.
    void turn(Bone bone, const glm::quat& in_world) noexcept {
        world_.rotations[index_of(bone)] = in_world;
        pose_.rotation(bone) = glm::normalize(glm::conjugate(rotation(parent_of(bone))) * in_world);
    }
    /// Points the bone at the place of `end` without turning it about itself.
    void swing(Bone bone, Bone end, const JointReach& reach = kAnywhere) noexcept {
        const glm::quat& before = rotation(parent_of(bone));
        const glm::vec3 own = before * offset(end);
        const glm::vec3 line = unit(wanted(end) - place(bone), own);
        turn(bone, held(before, glm::normalize(rotation_between(own, line) * before), reach));
    }

    /// Hips: their x axis along the line of the leg sockets, their up axis towards the spine.
    void set_hips() noexcept {
        const glm::vec3 rest_middle =
            0.5F * (offset(Bone::left_upper_leg) + offset(Bone::right_upper_leg));
        const glm::vec3 middle =
            0.5F * (wanted(Bone::left_upper_leg) + wanted(Bone::right_upper_leg));
        const glm::quat hips =
            turned_to({kLeft, wanted(Bone::left_upper_leg) - wanted(Bone::right_upper_leg)},
                      {offset(Bone::spine) - rest_middle, wanted(Bone::spine) - middle});
        pose_.rotation(Bone::hips) = world_.rotations[0] = hips;
        pose_.hips_position = world_.positions[0] = middle - hips * rest_middle;
    }

    /// Spine, chest and neck; the spine takes half of the twist between hips and shoulders.
    void set_trunk() noexcept {
        const glm::vec3 shoulders =
            unit(wanted(Bone::left_upper_arm) - wanted(Bone::right_upper_arm),
                 rotation(Bone::hips) * kLeft);
        const glm::vec3 between = rotation(Bone::hips) * kLeft + shoulders;  // half the twist
        turn(Bone::spine,
             turned_to({offset(Bone::chest), wanted(Bone::chest) - place(Bone::spine)},
                       {kLeft, between}));
        turn(Bone::chest,
             turned_to({offset(Bone::upper_chest) + offset(Bone::neck),
                        wanted(Bone::neck) - place(Bone::chest)},
                       {kLeft, shoulders}));
        place(Bone::upper_chest);
        turn(Bone::upper_chest, rotation(Bone::chest));
        turn(Bone::neck,
             held(rotation(Bone::upper_chest),
                  turned_to({offset(Bone::head), wanted(Bone::head) - place(Bone::neck)},
                            {kLeft, shoulders}),
                  kNeck));
    }

    /// Points the upper and lower bone of a limb. `bends_to`: direction at rest in which the lower
    /// bone moves when the limb bends.
    void point_limb(Bone upper, Bone lower, Bone end, const glm::vec3& bends_to) noexcept {
        const glm::quat parent = rotation(parent_of(upper));
        const glm::vec3 own = glm::normalize(parent * offset(lower));
        const glm::vec3 line = unit(wanted(lower) - place(upper), own);
        const glm::quat carried = rotation_between(own, line) * parent;
        const glm::vec3 rest = (wanted(end) - wanted(lower)) / glm::length(offset(end));
        // The lower bone's part across the upper one: its length is the sine of the bend.
        const glm::vec3 aside = rest - line * glm::dot(rest, line);
        const float unknown = std::max(0.0F, 1.0F - glm::length(aside) / kKnownBend);
        const glm::vec3 guessed = kKnownBend * unknown * unknown * (carried * bends_to);
        turn(upper, turned_to({offset(lower), line}, {bends_to, aside + guessed}));
        swing(lower, end);
    }

    void set_arm(Side side) noexcept {
        swing(on_side(Bone::left_shoulder, side), on_side(Bone::left_upper_arm, side), kCollarbone);
        point_limb(on_side(Bone::left_upper_arm, side),
                   on_side(Bone::left_lower_arm, side),
                   on_side(Bone::left_hand, side),
                   kAhead);
    }

    void set_leg(Side side) noexcept {
        const Bone foot = on_side(Bone::left_foot, side);
        const Bone toes = on_side(Bone::left_toes, side);
        const Bone thigh = on_side(Bone::left_upper_leg, side);
        const Bone lower = on_side(Bone::left_lower_leg, side);
        point_limb(thigh, lower, foot, -kAhead);
        const glm::quat& hips = rotation(Bone::hips);
        const Limb leg{thigh, lower, foot, world_.position(thigh), hips, hips * kAhead};
        // Bones that keep their lengths miss the ankle, so the leg is solved for it once more.
        const glm::quat shin = solve_limb(skeleton_, leg, wanted(foot), pose_);
        const glm::vec3 ahead = unit(wanted(toes) - wanted(foot), shin * kAhead);
        const glm::vec3 level = glm::cross(kUp, ahead);
        const glm::quat in_world =
            turned_to({offset(toes), ahead}, {kLeft, level + kCarriedFoot * (shin * kLeft)});
        pose_.rotation(foot) = glm::normalize(glm::conjugate(shin) * in_world);
    }

    const Skeleton& skeleton_;
    const JointPlaces& places_;
    Pose pose_;
    WorldPose world_;
};

// Shares of the bend at a source's lower and upper spine joint that a joint further up takes.
constexpr float kLowerUp = 0.5F;
constexpr float kUpperUp = 0.9F;

/// Spreads the bends of a trunk that was learnt from two joints over three. The two of captured
/// skeletons lie at 0.38 and 0.59 of the way from hips to neck, where the mannequin's second and
/// third joint are (0.39, 0.63): bent at the first and second, its spine looked half as supple as
/// people's. How the shoulders are turned stays the same.
void spread_trunk(const FigureModel& model, Pose& pose) noexcept {
    if (!is_captured(model)) {
        return;
    }
    const glm::quat lower = pose.rotation(Bone::spine);
    const glm::quat upper = pose.rotation(Bone::chest);
    const glm::quat lower_up = interpolate(kNoRotation, lower, kLowerUp);
    const glm::quat upper_up = interpolate(kNoRotation, upper, kUpperUp);
    pose.rotation(Bone::spine) = glm::normalize(lower * glm::conjugate(lower_up));
    pose.rotation(Bone::chest) = glm::normalize(lower_up * upper * glm::conjugate(upper_up));
    pose.rotation(Bone::upper_chest) = upper_up;
}

// Collects the parts' local places as world places, then builds the body from them.
Pose pose_of_positions(const FigureModel& model,
                       const FigureTracks& tracks,
                       std::size_t row,
                       const RootPlace& place,
                       double scale,
                       const Skeleton& skeleton) noexcept {
    JointPlaces places{};
    for (const PartModel& part : model.parts) {
        const std::span<const double> values =
            tracks[static_cast<std::size_t>(part.part)].row(row).subspan(part.root_features());
        for (std::size_t j = 0; j < part.joints.size(); ++j) {
            places[index_of(part.joints[j].bone)] =
                glm::vec3(world_place(values.subspan(3 * j, 3), place, scale));
        }
    }
    return pose_at(skeleton, places);
}

}  // namespace

const FeatureTrack& root_of(const FigureModel& model, const FigureTracks& tracks) noexcept {
    return tracks[static_cast<std::size_t>(model.root_part().part)];
}

Pose pose_of_features(const FigureModel& model,
                      const FigureTracks& tracks,
                      std::size_t row,
                      const RootPlace& place,
                      double scale,
                      const Skeleton& skeleton) noexcept {
    if (model.features == FigureFeatures::positions) {
        return pose_of_positions(model, tracks, row, place, scale, skeleton);
    }
    Pose pose;
    for (const PartModel& part : model.parts) {
        apply_features(
            tracks[static_cast<std::size_t>(part.part)].row(row), part, place, scale, pose);
    }
    spread_trunk(model, pose);
    return pose;
}

Pose pose_at(const Skeleton& skeleton, const JointPlaces& places) noexcept {
    return Body(skeleton, places).built();
}

}  // namespace raks::motion
