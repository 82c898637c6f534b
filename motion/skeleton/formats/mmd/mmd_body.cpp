#include "motion/skeleton/formats/mmd/mmd_body.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "motion/skeleton/formats/mmd/mmd_ik.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raks::motion {
namespace {

using B = MmdBone;
const glm::dquat kNoMmdTurn(1.0, 0.0, 0.0, 0.0);

constexpr std::array<MmdBoneRow, kMmdTrunkBones> kTrunkRows = {{
    {B::mother, std::nullopt, {0.0, 0.0, 0.0}},
    {B::center, B::mother, {0.0, 0.64, 0.0}},
    {B::groove, B::center, {0.0, 0.02, 0.0}},
    {B::waist, B::groove, {0.0, 0.32, 0.0}},
    {B::upper_body, B::waist, {0.0, 0.09, 0.0}},
    {B::upper_body2, B::upper_body, {0.0, 0.10, 0.0}},
    {B::upper_body3, B::upper_body2, {0.0, 0.06, 0.0}},
    {B::neck, B::upper_body3, {0.0, 0.11, -0.01}},
    {B::head, B::neck, {0.0, 0.05, 0.01}},
    {B::lower_body, B::waist, {0.0, 0.09, 0.0}},
}};

// The left side. Thigh, shin and foot are those of the mannequin, times the ratio of the heights of
// the legs' roots, 0.900 to 0.892 m: a foot that stands on the floor there stands on it here.
constexpr std::array<MmdBoneRow, kMmdSideBones> kLeftRows = {{
    {B::left_shoulder_p, B::upper_body3, {0.02, 0.06, 0.0}},
    {B::left_shoulder, B::left_shoulder_p, {0.0, 0.0, 0.0}},
    {B::left_shoulder_c, B::left_shoulder, {0.08, -0.01, 0.0}, B::left_shoulder_p, -1.0},
    {B::left_arm, B::left_shoulder_c, {0.0, 0.0, 0.0}},
    {B::left_arm_twist, B::left_arm, {0.12, 0.0, 0.0}, B::mother, 0.0, true},
    {B::left_elbow, B::left_arm_twist, {0.09, 0.0, 0.0}},
    {B::left_wrist_twist, B::left_elbow, {0.12, 0.0, 0.0}, B::mother, 0.0, true},
    {B::left_wrist, B::left_wrist_twist, {0.08, 0.0, 0.0}},
    {B::left_thumb0, B::left_wrist, {0.018, -0.007, 0.016}},
    {B::left_thumb1, B::left_thumb0, {0.027, -0.008, 0.024}},
    {B::left_thumb2, B::left_thumb1, {0.022, -0.004, 0.015}},
    {B::left_index1, B::left_wrist, {0.070, 0.0, 0.021}},
    {B::left_index2, B::left_index1, {0.033, 0.0, 0.002}},
    {B::left_index3, B::left_index2, {0.020, 0.0, 0.001}},
    {B::left_middle1, B::left_wrist, {0.072, 0.001, 0.004}},
    {B::left_middle2, B::left_middle1, {0.036, 0.0, 0.001}},
    {B::left_middle3, B::left_middle2, {0.023, 0.0, 0.0}},
    {B::left_ring1, B::left_wrist, {0.069, 0.0, -0.013}},
    {B::left_ring2, B::left_ring1, {0.033, 0.0, -0.001}},
    {B::left_ring3, B::left_ring2, {0.022, 0.0, -0.001}},
    {B::left_little1, B::left_wrist, {0.063, -0.002, -0.028}},
    {B::left_little2, B::left_little1, {0.026, 0.0, -0.003}},
    {B::left_little3, B::left_little2, {0.016, 0.0, -0.002}},
    {B::left_waist_cancel, B::lower_body, {0.089, -0.17, 0.0}, B::waist, -1.0},
    {B::left_leg, B::left_waist_cancel, {0.0, 0.0, 0.0}},
    {B::left_knee, B::left_leg, {-0.004, -0.4096, 0.0061}},
    {B::left_ankle, B::left_knee, {-0.002, -0.4117, -0.0283}},
    {B::left_toe, B::left_ankle, {0.002, -0.0565, 0.1261}},
    {B::left_leg_ik_parent, B::mother, {0.083, 0.0, -0.0222}},
    {B::left_leg_ik, B::left_leg_ik_parent, {0.0, 0.0787, 0.0}, B::mother, 0.0, false, 1},
    {B::left_toe_ik, B::left_leg_ik, {0.002, -0.0565, 0.1261}, B::mother, 0.0, false, 2},
    {B::left_leg_d, B::left_waist_cancel, {0.0, 0.0, 0.0}, B::left_leg, 1.0, false, 3},
    {B::left_knee_d, B::left_leg_d, {-0.004, -0.4096, 0.0061}, B::left_knee, 1.0, false, 3},
    {B::left_ankle_d, B::left_knee_d, {-0.002, -0.4117, -0.0283}, B::left_ankle, 1.0, false, 3},
    {B::left_toe_ex, B::left_ankle_d, {0.002, -0.0565, 0.1261}, B::mother, 0.0, false, 3},
}};

B right_of(B left) { return side_of(left) ? on_side(left, Side::right) : left; }

std::array<MmdBoneRow, kMmdBones> all_rows() {
    std::array<MmdBoneRow, kMmdBones> rows{};
    std::copy(kTrunkRows.begin(), kTrunkRows.end(), rows.begin());
    std::copy(kLeftRows.begin(), kLeftRows.end(), rows.begin() + kMmdTrunkBones);
    for (std::size_t i = 0; i < kMmdSideBones; ++i) {
        MmdBoneRow row = kLeftRows[i];
        row.bone = right_of(row.bone);
        row.parent = right_of(*row.parent);
        row.source = right_of(row.source);
        row.offset.x = -row.offset.x;
        rows[kMmdTrunkBones + kMmdSideBones + i] = row;
    }
    return rows;
}

// As a bone that turns about one axis alone takes any turn: by its angle.
glm::dquat turn_about(const glm::dvec3& axis, const glm::dquat& turn) {
    const glm::dvec3 part(turn.x, turn.y, turn.z);
    const double sine = glm::length(part);
    const double sign = glm::dot(part, axis) < 0.0 ? -1.0 : 1.0;
    return glm::angleAxis(sign * 2.0 * std::atan2(sine, turn.w), axis);
}

// One pose under way: forward kinematics, and the solvers between.
class Posing {
 public:
    Posing(const MmdBody& body, const MmdPose& pose) : body_(body), pose_(pose) {
        given_.fill(kNoMmdTurn);
    }

    MmdWorld pose() {
        place_level(0);
        place_level(1);
        for (const Side side : kSides) {
            solve_leg(side);
        }
        place_level(2);
        for (const Side side : kSides) {
            solve_toes(side);
        }
        place_level(3);
        return world_;
    }

 private:
    [[nodiscard]] glm::dquat& given(B bone) { return given_[index_of(bone)]; }

    void place_level(std::uint8_t level) {
        for (const MmdBoneRow& row : mmd_bone_rows()) {
            if (row.level == level) {
                given(row.bone) = local_turn(row);
                place(row);
            }
        }
    }

    // The turn in the parent's frame: the key's, and what another bone hands on.
    glm::dquat local_turn(const MmdBoneRow& row) {
        const glm::dquat& key = pose_.turns[index_of(row.bone)];
        if (row.turns_about_arm) {
            const double along = side_of(row.bone) == Side::left ? 1.0 : -1.0;
            return turn_about(body_.arm_at_rest(*side_of(row.bone)) * glm::dvec3(along, 0.0, 0.0),
                              key);
        }
        if (row.share == 0.0) {
            return key;
        }
        const glm::dquat& source = given(row.source);
        return key * (row.share < 0.0 ? glm::conjugate(source) : source);
    }

    void place(const MmdBoneRow& row) {
        const std::size_t i = index_of(row.bone);
        const glm::dvec3 offset =
            body_.offset(row.bone) + (has_mmd_place(row.bone) ? pose_.places[i] : glm::dvec3(0.0));
        if (!row.parent) {
            world_.places[i] = offset;
            world_.turns[i] = given(row.bone);
            return;
        }
        const std::size_t parent = index_of(*row.parent);
        world_.places[i] = world_.places[parent] + world_.turns[parent] * offset;
        world_.turns[i] = glm::normalize(world_.turns[parent] * given(row.bone));
    }

    void place_again(B bone) { place(mmd_bone_rows()[index_of(bone)]); }

    void solve_leg(Side side) {
        const B leg = on_side(B::left_leg, side);
        const B knee = on_side(B::left_knee, side);
        const B ankle = on_side(B::left_ankle, side);
        const B toe = on_side(B::left_toe, side);
        if (!pose_.leg_ik[static_cast<std::size_t>(side)]) {
            return;
        }
        std::array<MmdIkLink, 2> links;
        links[0] = {.keyed = given(leg), .to_next = body_.offset(knee)};
        links[1] = {.keyed = given(knee), .to_next = body_.offset(ankle), .is_knee = true};
        const MmdIkGoal goal = {.place = world_.place(on_side(B::left_leg_ik, side)),
                                .rounds = 40,
                                .largest_step = 2.0};
        solve_mmd_ik(
            world_.turn(on_side(B::left_waist_cancel, side)), world_.place(leg), goal, links);
        given(leg) = links[0].turn();
        given(knee) = links[1].turn();
        for (const B bone : {leg, knee, ankle, toe}) {
            place_again(bone);
        }
    }

    void solve_toes(Side side) {
        const B ankle = on_side(B::left_ankle, side);
        const B toe = on_side(B::left_toe, side);
        if (!pose_.toe_ik[static_cast<std::size_t>(side)]) {
            return;
        }
        std::array<MmdIkLink, 1> links;
        links[0] = {.keyed = given(ankle), .to_next = body_.offset(toe)};
        const MmdIkGoal goal = {
            .place = world_.place(on_side(B::left_toe_ik, side)), .rounds = 3, .largest_step = 4.0};
        solve_mmd_ik(world_.turn(on_side(B::left_knee, side)), world_.place(ankle), goal, links);
        given(ankle) = links[0].turn();
        place_again(ankle);
        place_again(toe);
    }

    const MmdBody& body_;
    const MmdPose& pose_;
    std::array<glm::dquat, kMmdBones> given_{};  // turns in the parent's frame
    MmdWorld world_;
};

}  // namespace

const std::array<MmdBoneRow, kMmdBones>& mmd_bone_rows() {
    static const std::array<MmdBoneRow, kMmdBones> kRows = all_rows();
    return kRows;
}

bool is_of_arm(MmdBone bone) {
    const std::size_t left = index_of(left_of(bone));
    return left >= index_of(MmdBone::left_arm) && left <= index_of(MmdBone::left_little3);
}

bool has_mmd_place(MmdBone bone) {
    switch (left_of(bone)) {
        case MmdBone::mother:
        case MmdBone::center:
        case MmdBone::groove:
        case MmdBone::waist:
        case MmdBone::left_leg_ik_parent:
        case MmdBone::left_leg_ik:
        case MmdBone::left_toe_ik:
            return true;
        default:
            return false;
    }
}

MmdBody::MmdBody(double arm_angle) {
    const double down = arm_angle * glm::pi<double>() / 180.0;
    const glm::dvec3 ahead(0.0, 0.0, 1.0);
    arms_ = {glm::angleAxis(-down, ahead), glm::angleAxis(down, ahead)};
    for (const MmdBoneRow& row : mmd_bone_rows()) {
        const bool hangs = row.parent && is_of_arm(*row.parent);
        offsets_[index_of(row.bone)] =
            hangs ? arm_at_rest(*side_of(row.bone)) * row.offset : row.offset;
    }
}

MmdWorld MmdBody::world(const MmdPose& pose) const { return Posing(*this, pose).pose(); }

}  // namespace raks::motion
