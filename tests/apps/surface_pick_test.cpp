#include "apps/xbody/surface_pick.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "apps/xbody/skeleton_view.hpp"
#include "base/pending_file.hpp"
#include "tests/render/import/tiny_tds.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/common.hpp>

namespace raks::apps {
namespace {

using motion::Bone;

constexpr render::Box kView{30.0F, 40.0F, 400.0F, 300.0F};

/// A figure of rigid parts, seen from the front.
class SurfacePick : public ::testing::Test {
 protected:
    void SetUp() override {
        ASSERT_TRUE(write_file(folder_ / "me.3ds", test::tds::figure()));
        auto model = load_shown_model(
            {.file = folder_ / "me.3ds", .options = {}, .motion = {}, .joints = {}});
        ASSERT_TRUE(model) << model.error().message;
        model_.emplace(std::move(*model));
        shown_.emplace(*model_);
        camera_ = camera_before(*model_, *shown_, "front", kView.width / kView.height);
        seen_ = seen_skeleton(*model_, *shown_, humanoid(), {}, camera_, kView);
    }
    [[nodiscard]] const render::HumanoidMap& humanoid() const {
        return model_->figure.model.character.humanoid;
    }
    [[nodiscard]] int node(Bone bone) const { return humanoid().nodes[motion::index_of(bone)]; }
    [[nodiscard]] glm::vec2 joint(Bone bone) const {
        const auto found = std::find_if(seen_.begin(), seen_.end(), [&](const SeenNode& one) {
            return one.node == node(bone);
        });
        return found->at;
    }
    [[nodiscard]] std::optional<int> at(const glm::vec2& place,
                                        const std::vector<bool>& is_hidden = {}) const {
        return node_at(place, *model_, *shown_, is_hidden, camera_, kView);
    }

    test::TemporaryFolder folder_;
    std::optional<ShownModel> model_;
    std::optional<ShownPose> shown_;
    render::Camera camera_;
    std::vector<SeenNode> seen_;
};

TEST_F(SurfacePick, finds_the_part_between_two_joints) {
    for (const auto& [bone, next] : {std::pair{Bone::left_lower_arm, Bone::left_hand},
                                     {Bone::right_lower_arm, Bone::right_hand},
                                     {Bone::left_lower_leg, Bone::left_foot},
                                     {Bone::right_upper_leg, Bone::right_lower_leg}}) {
        EXPECT_EQ(at(glm::mix(joint(bone), joint(next), 0.5F)), node(bone))
            << motion::kBoneNames[motion::index_of(bone)];
    }
}

TEST_F(SurfacePick, finds_nothing_beside_the_figure_and_where_it_is_hidden) {
    EXPECT_EQ(at({kView.x + 2.0F, kView.y + 2.0F}), std::nullopt);
    std::vector<bool> is_hidden(model_->figure.model.nodes.size(), false);
    const glm::vec2 place = glm::mix(joint(Bone::left_lower_arm), joint(Bone::left_hand), 0.5F);
    is_hidden[static_cast<std::size_t>(node(Bone::left_lower_arm))] = true;
    EXPECT_EQ(at(place, is_hidden), std::nullopt);
}

TEST_F(SurfacePick, goes_by_where_the_parts_are_now) {
    const glm::vec2 place = glm::mix(joint(Bone::left_lower_arm), joint(Bone::left_hand), 0.5F);
    shown_->pose.rotation(Bone::left_upper_arm) =
        glm::angleAxis(glm::radians(-80.0F), glm::vec3(0.0F, 0.0F, 1.0F));
    constexpr float kOwnBody = 1.0F;
    render::pose_avatar(*model_->avatar->rig, shown_->pose, {}, kOwnBody, shown_->state);
    EXPECT_NE(at(place), node(Bone::left_lower_arm));
    seen_ = seen_skeleton(*model_, *shown_, humanoid(), {}, camera_, kView);
    EXPECT_EQ(at(glm::mix(joint(Bone::left_lower_arm), joint(Bone::left_hand), 0.5F)),
              node(Bone::left_lower_arm));
}

TEST_F(SurfacePick, of_two_parts_in_a_line_finds_the_nearer) {
    // From the left side, the left leg hides the right one.
    camera_ = camera_before(*model_, *shown_, "side", kView.width / kView.height);
    seen_ = seen_skeleton(*model_, *shown_, humanoid(), {}, camera_, kView);
    const glm::vec2 place = glm::mix(joint(Bone::left_lower_leg), joint(Bone::left_foot), 0.5F);
    const auto first = at(place);
    ASSERT_TRUE(first);
    std::vector<bool> is_hidden(model_->figure.model.nodes.size(), false);
    is_hidden[static_cast<std::size_t>(*first)] = true;
    const auto second = at(place, is_hidden);
    ASSERT_TRUE(second);
    EXPECT_EQ(std::minmax(*first, *second),
              std::minmax(node(Bone::left_lower_leg), node(Bone::right_lower_leg)));
}

}  // namespace
}  // namespace raks::apps
