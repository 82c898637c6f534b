#include "motion/evaluate/couple_measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace raks::motion {
namespace {

/// In T-pose on the floor, `ahead` metres towards +z, facing `heading`.
Pose standing(float aside, float ahead, float heading) {
    Pose pose;
    pose.hips_position = {aside, mannequin_skeleton().hips_height(), ahead};
    pose.rotation(Bone::hips) = glm::angleAxis(heading, glm::vec3(0, 1, 0));
    return pose;
}

constexpr float kHalfTurn = 3.14159265F;

TEST(CoupleMeasures, clearance_is_what_lies_between_the_trunks) {
    const Pose one = standing(0.0F, 0.0F, 0.0F);
    double before = -1.0;
    for (const float apart : {0.3F, 0.4F, 0.6F, 0.8F}) {
        const double clearance =
            body_clearance(mannequin_skeleton(), one, standing(0.0F, apart, kHalfTurn));
        // Feet stand out further than trunks are deep (0.17 m).
        EXPECT_LE(clearance, static_cast<double>(apart) - 0.17 + 1e-3) << apart;
        EXPECT_GT(clearance, before) << apart;
        before = clearance;
    }
    const double side_by_side =
        body_clearance(mannequin_skeleton(), one, standing(0.5F, 0.0F, 0.0F));
    EXPECT_NEAR(side_by_side, 0.5 - 0.29, 0.03) << "trunks are 0.29 m wide";
}

TEST(CoupleMeasures, bodies_that_pass_through_one_another_have_no_clearance) {
    const Pose one = standing(0.0F, 0.0F, 0.0F);
    EXPECT_LT(body_clearance(mannequin_skeleton(), one, standing(0.05F, 0.1F, 1.0F)), -0.05);
}

TEST(CoupleMeasures, facing_and_hands_are_those_of_lead_and_follow) {
    const std::vector<Pose> lead = {standing(0.0F, 0.0F, 0.0F), standing(0.0F, 0.0F, 0.5F)};
    const std::vector<Pose> follow = {standing(0.0F, 0.8F, kHalfTurn),
                                      standing(0.0F, 0.8F, kHalfTurn + 0.2F)};
    const CoupleMeasures measures = measure_couple(mannequin_skeleton(), lead, follow);
    ASSERT_EQ(measures.facing.size(), 2U);
    EXPECT_NEAR(measures.facing[0], 0.0, 1e-5);
    EXPECT_NEAR(measures.facing[1], 0.5, 1e-5);
    // Arms in T-pose: the lead's left hand and the follow's right are on the same side, the wrists
    // 2.4 cm behind the hips.
    EXPECT_NEAR(measures.hands[0], 0.848, 0.001);
}

}  // namespace
}  // namespace raks::motion
