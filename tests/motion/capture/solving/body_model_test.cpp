#include "motion/capture/solving/body_model.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/dice.hpp"
#include "motion/capture/solving/body_size.hpp"
#include "motion/choreography/joint_limits.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

using motion::Bone;

BodyShape plain_shape() { return shape_of(BodySize{}, MarkerSet{}); }

/// A posture that is turned in every variable.
BodyState drawn_state(const BodyModel& model, std::uint64_t seed) {
    Dice dice(seed, 1);
    std::vector<double> change(model.variables());
    for (double& value : change) {
        value = dice.uniform(-0.6, 0.6);
    }
    return model.moved(model.usual_state(plain_shape()), change.data());
}

TEST(BodyModel, of_the_paper_has_22_degrees_of_freedom) {
    EXPECT_EQ(BodyModel(BodyKind::paper).variables(), 22U);
    EXPECT_GT(BodyModel(BodyKind::dance).variables(), 40U);
}

TEST(BodyModel, places_bones_where_the_pose_has_them) {
    for (const BodyKind kind : {BodyKind::paper, BodyKind::dance}) {
        const BodyModel model(kind);
        const BodyState state = drawn_state(model, 3);
        const PlacedBody body = model.place(plain_shape(), state);
        const motion::WorldPose world =
            motion::world_pose(skeleton_of(BodySize{}), model.pose_of(state));
        for (std::size_t i = 0; i < motion::kBoneCount; ++i) {
            EXPECT_LT(glm::distance(glm::dvec3(world.positions[i]), body.places[i]), 1e-5)
                << motion::kBoneNames[i];
        }
    }
}

TEST(BodyModel, points_move_as_small_steps_move_them) {
    constexpr double kStep = 1e-6;
    const BodyModel model(BodyKind::dance);
    const BodyShape shape = plain_shape();
    const BodyState state = drawn_state(model, 5);
    const PlacedBody body = model.place(shape, state);
    const glm::dvec3 local(0.1, -0.05, 0.07);
    for (const Bone bone : {Bone::hips,
                            Bone::chest,
                            Bone::head,
                            Bone::left_hand,
                            Bone::right_lower_arm,
                            Bone::right_toes,
                            Bone::left_foot}) {
        const PointMotion motion = model.motion_of(body, bone, body.point(bone, local));
        std::vector<glm::dvec3> moves(model.variables());
        for (std::size_t i = 0; i < motion.count; ++i) {
            moves[motion.variables[i]] += motion.moves[i];
        }
        for (std::size_t i = 0; i < moves.size(); ++i) {
            std::vector<double> change(model.variables());
            change[i] = kStep;
            const glm::dvec3 after =
                model.place(shape, model.moved(state, change.data())).point(bone, local);
            change[i] = -kStep;
            const glm::dvec3 before =
                model.place(shape, model.moved(state, change.data())).point(bone, local);
            EXPECT_LT(glm::distance((after - before) / (2.0 * kStep), moves[i]), 1e-6)
                << motion::kBoneNames[index_of(bone)] << ", variable " << i;
        }
    }
}

TEST(BodyModel, usual_postures_keep_within_the_limits_of_joints) {
    const BodyModel model(BodyKind::dance);
    EXPECT_FALSE(motion::worst_joint(model.pose_of(model.usual_state(plain_shape()))));
}

TEST(TurnVector, and_rotation_are_inverse_and_change_as_told) {
    constexpr double kStep = 1e-6;
    for (const glm::dvec3& turn : {glm::dvec3(0.0),
                                   glm::dvec3(1e-5, 0.0, -1e-5),
                                   glm::dvec3(0.4, -0.2, 0.9),
                                   glm::dvec3(1.5, 2.0, -1.2)}) {
        EXPECT_LT(glm::distance(turn_vector(turned_by(turn)), turn), 1e-12);
        const glm::dmat3 change = turn_vector_change(turn);
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            glm::dvec3 step(0.0);
            step[axis] = kStep;
            const glm::dvec3 moved = (turn_vector(turned_by(turn) * turned_by(step)) -
                                      turn_vector(turned_by(turn) * turned_by(-step))) /
                                     (2.0 * kStep);
            EXPECT_LT(glm::distance(moved, change[axis]), 1e-8);
        }
    }
}

}  // namespace
}  // namespace raks::capture
