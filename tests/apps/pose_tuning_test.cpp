#include "apps/xbody/pose_tuning.hpp"

#include <gtest/gtest.h>

#include "base/pending_file.hpp"
#include "tests/render/import/tiny_tds.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

using motion::Bone;

class PoseTunings : public ::testing::Test {
 protected:
    PoseTunings() {
        EXPECT_TRUE(write_file(folder_ / "me.3ds", test::tds::figure()));
        auto model = load_shown_model(
            {.file = folder_ / "me.3ds", .options = {}, .motion = {}, .joints = {}});
        EXPECT_TRUE(model);
        model_ = std::move(*model);
    }
    [[nodiscard]] glm::vec3 place_of(Bone bone, const ShownPose& shown) const {
        const int node = model_.figure.model.character.humanoid.nodes[motion::index_of(bone)];
        const int joint = model_.avatar->rig->tree.joint_of(node);
        return glm::vec3(shown.state.joints.world[static_cast<std::size_t>(joint)][3]);
    }

    test::TemporaryFolder folder_;
    ShownModel model_;
};

TEST_F(PoseTunings, a_bone_is_turned_and_carries_what_hangs_on_it) {
    ShownPose shown(model_);
    const glm::vec3 shoulder = place_of(Bone::left_upper_arm, shown);
    const glm::vec3 hand = place_of(Bone::left_hand, shown);
    const float reach = glm::distance(shoulder, hand);
    PoseTuning tuning;
    // From the T-pose, its left is +x: about z by +90 the arm points up.
    tuning.turns[motion::index_of(Bone::left_upper_arm)].z = 90.0F;
    show_tuned_frame(model_, 0, tuning, shown);
    EXPECT_LT(glm::distance(place_of(Bone::left_upper_arm, shown), shoulder), 1e-4F);
    const glm::vec3 raised = place_of(Bone::left_hand, shown) - shoulder;
    EXPECT_NEAR(raised.y, reach, 0.05F * reach);
    show_tuned_frame(model_, 0, {}, shown);
    EXPECT_LT(glm::distance(place_of(Bone::left_hand, shown), hand), 1e-4F);
}

TEST_F(PoseTunings, weights_of_expressions_that_there_are_not_do_nothing) {
    ShownPose shown(model_);
    PoseTuning tuning;
    tuning.expressions = {1.0F, 0.5F};
    show_tuned_frame(model_, 0, tuning, shown);
    EXPECT_TRUE(expression_names(model_).empty());
}

}  // namespace
}  // namespace raks::apps
