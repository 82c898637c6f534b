// MMD body: a standard body of MikuMikuDance that dances of it are performed on.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "motion/skeleton/formats/mmd/mmd_bones.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {

/// Metres of a unit of MikuMikuDance: its first body is 20 units and 1.6 m tall.
inline constexpr double kMmdMetres = 0.08;
inline constexpr double kMmdHeight = 1.6;  ///< metres, of bodies that dances are made for
/// How far the arms of usual bodies hang at rest, degrees below the horizon: 27 to 38.
inline constexpr double kMmdArmAngle = 35.0;

/// What moves at a moment, as keys have it, but in our axes (y up, facing +z, its left is +x) and
/// in metres. All at rest unless set.
struct MmdPose {
    std::array<glm::dvec3, kMmdBones> places{};  ///< from rest, in the parent's frame
    std::array<glm::dquat, kMmdBones> turns = all_at_rest();
    /// By Side, whether the inverse kinematics of the leg and of the toes is on.
    std::array<bool, 2> leg_ik{true, true};
    std::array<bool, 2> toe_ik{true, true};

 private:
    static constexpr std::array<glm::dquat, kMmdBones> all_at_rest() {
        std::array<glm::dquat, kMmdBones> turns{};
        for (glm::dquat& turn : turns) {
            turn = glm::dquat(1.0, 0.0, 0.0, 0.0);
        }
        return turns;
    }
};

/// Where every bone is in the world.
struct MmdWorld {
    std::array<glm::dvec3, kMmdBones> places{};  ///< metres
    std::array<glm::dquat, kMmdBones> turns{};   ///< from rest, where a bone has the world's axes

    [[nodiscard]] const glm::dvec3& place(MmdBone bone) const { return places[index_of(bone)]; }
    [[nodiscard]] const glm::dquat& turn(MmdBone bone) const { return turns[index_of(bone)]; }
};

/// A bone of the table.
struct MmdBoneRow {
    MmdBone bone;
    std::optional<MmdBone> parent;  ///< none: the world
    glm::dvec3 offset;              ///< from the parent at rest, with the arms stretched aside
    /// The bone that hands its turn on to this one, and which part of it; 0: none does.
    MmdBone source = MmdBone::mother;
    double share = 0.0;
    bool turns_about_arm = false;  ///< its turn is one about the arm, whatever axis it has
    std::uint8_t level = 0;        ///< those of higher levels are placed later
};

/// The table: our own, with the legs of the mannequin's proportions, 1.6 m tall. Legs of the
/// humanoid are the D bones, which the inverse kinematics has turned.
[[nodiscard]] const std::array<MmdBoneRow, kMmdBones>& mmd_bone_rows();

/// The standard body. Threads: any. Real-time: no.
class MmdBody {
 public:
    /// `arm_angle`: degrees that the arms hang below the horizon at rest, 0 to 90.
    explicit MmdBody(double arm_angle = kMmdArmAngle);

    /// From the parent's place at rest, arms hanging as they do there; metres.
    [[nodiscard]] const glm::dvec3& offset(MmdBone bone) const { return offsets_[index_of(bone)]; }
    /// Turns the T-pose's arm of a side down to the resting one.
    [[nodiscard]] const glm::dquat& arm_at_rest(Side side) const {
        return arms_[static_cast<std::size_t>(side)];
    }
    /// Poses it as MikuMikuDance does: the bones in order, turns that are handed on, inverse
    /// kinematics of legs and toes where it is on, then the bones that follow the legs.
    [[nodiscard]] MmdWorld world(const MmdPose& pose) const;

 private:
    std::array<glm::dquat, 2> arms_{};
    std::array<glm::dvec3, kMmdBones> offsets_{};
};

/// Whether a bone belongs to the arm, from its root to the tips of the fingers.
[[nodiscard]] bool is_of_arm(MmdBone bone);
/// Whether keys of its place mean anything: the trunk's roots and the goals of the legs.
[[nodiscard]] bool has_mmd_place(MmdBone bone);

}  // namespace raks::motion
