#include "apps/xbody/shown_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "apps/xbody/skeleton_view.hpp"
#include "base/pending_file.hpp"
#include "render/import/standing_body.hpp"
#include "tests/render/import/tiny_tds.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

constexpr render::Box kBox{100.0F, 50.0F, 400.0F, 300.0F};

class ShownModels : public ::testing::Test {
 protected:
    ShownModels() { EXPECT_TRUE(write_file(folder_ / "me.3ds", test::tds::figure())); }
    [[nodiscard]] Expected<ShownModel> load() const {
        return load_shown_model(
            {.file = folder_ / "me.3ds", .options = {}, .motion = motion_, .joints = {}});
    }

    test::TemporaryFolder folder_;
    std::string motion_;
};

TEST(NamedNodes, are_the_chosen_one_and_those_next_to_it_else_the_bones_that_a_figure_needs) {
    const auto node = [](int number, int parent, bool is_needed) {
        SeenNode one;
        one.node = number;
        one.parent = parent;
        one.is_needed = is_needed;
        return one;
    };
    // Arm, hand, two fingers, the tip of one.
    const std::vector<SeenNode> nodes = {node(1, -1, true),
                                         node(2, 1, true),
                                         node(3, 2, false),
                                         node(4, 2, false),
                                         node(5, 3, false)};
    const auto named = [&](const SkeletonLook& look) {
        std::string names;
        const std::vector<bool> is_named = named_nodes(nodes, look);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            names += is_named[i] ? std::to_string(nodes[i].node) : "";
        }
        return names;
    };
    EXPECT_EQ(named({}), "");
    EXPECT_EQ(named({.chosen = 3}), "3");
    EXPECT_EQ(named({.chosen = 3, .pointed = 4}), "34");
    EXPECT_EQ(named({.has_names = true}), "12");
    EXPECT_EQ(named({.has_names = true, .pointed = 5}), "125");
    EXPECT_EQ(named({.has_names = true, .chosen = 2}), "1234");
    EXPECT_EQ(named({.has_names = true, .chosen = 5}), "35");
    // A thing has no bones.
    EXPECT_EQ(named_nodes({node(7, -1, false), node(8, 7, false)}, {.has_names = true}),
              (std::vector<bool>{true, true}));
}

TEST_F(ShownModels, a_figure_fills_the_picture_from_every_side_and_no_bone_is_cut_off) {
    const auto model = load();
    ASSERT_TRUE(model) << model.error().message;
    const ShownPose shown(*model);
    for (const char* const view : {"front", "side", "back", "top"}) {
        const render::Camera camera = camera_before(*model, shown, view, kBox.width / kBox.height);
        const auto seen =
            seen_skeleton(*model, shown, model->figure.model.character.humanoid, {}, camera, kBox);
        ASSERT_EQ(seen.size(), 15U) << view;
        float lowest = kBox.bottom();
        float highest = kBox.y;
        float leftmost = kBox.right();
        float rightmost = kBox.x;
        for (const SeenNode& node : seen) {
            lowest = std::min(lowest, node.at.y);
            highest = std::max(highest, node.at.y);
            leftmost = std::min(leftmost, node.at.x);
            rightmost = std::max(rightmost, node.at.x);
        }
        EXPECT_GT(lowest, kBox.y) << view;
        EXPECT_LT(highest, kBox.bottom()) << view;
        EXPECT_GT(leftmost, kBox.x) << view;
        EXPECT_LT(rightmost, kBox.right()) << view;
        EXPECT_GT(std::max((highest - lowest) / kBox.height, (rightmost - leftmost) / kBox.width),
                  0.4F)
            << view;
    }
}

TEST_F(ShownModels, things_of_any_size_anywhere_fill_the_picture) {
    for (const auto& [size, place] : {std::pair{1.0F, glm::vec3(0.0F)},
                                      {360.0F, glm::vec3(0.0F)},
                                      {1e6F, glm::vec3(0.0F)},
                                      {1e-9F, glm::vec3(0.0F)},
                                      {10.0F, glm::vec3(2000.0F, -500.0F, 1000.0F)}}) {
        SCOPED_TRACE(size);
        const std::string thing = test::tds::file(test::tds::object(
            test::tds::box("bar", place, size * glm::vec3(0.1F, 0.1F, 0.5F), glm::vec3(0.0F))));
        ASSERT_TRUE(write_file(folder_ / "bar.3ds", thing));
        const auto model = load_shown_model(
            {.file = folder_ / "bar.3ds", .options = {}, .motion = {}, .joints = {}});
        ASSERT_TRUE(model) << model.error().message;
        const ShownPose shown(*model);
        const render::Camera camera = camera_before(*model, shown, "front", 1.0F);
        // It is as tall as a figure, and stands in the middle.
        EXPECT_NEAR(camera.target.y, 0.5F * render::kUsualHeight, 0.01F);
        EXPECT_NEAR(camera.target.x, 0.0F, 0.01F);
        EXPECT_GT(camera.distance, 1.0F);
        EXPECT_LT(camera.distance, 5.0F);
    }
}

TEST_F(ShownModels, from_the_front_the_left_hand_is_on_the_right_of_the_picture) {
    const auto model = load();
    ASSERT_TRUE(model) << model.error().message;
    const ShownPose shown(*model);
    const auto hands = [&](const char* view) {
        const auto seen = seen_skeleton(*model,
                                        shown,
                                        model->figure.model.character.humanoid,
                                        {},
                                        camera_before(*model, shown, view, 1.0F),
                                        kBox);
        const auto place_of = [&](std::string_view name) {
            return std::find_if(seen.begin(),
                                seen.end(),
                                [&](const SeenNode& node) { return node.name == name; })
                ->at.x;
        };
        return place_of("leftHand") - place_of("rightHand");
    };
    EXPECT_GT(hands("front"), 50.0F);
    EXPECT_LT(hands("back"), -50.0F);
}

TEST_F(ShownModels, hidden_nodes_are_not_drawn) {
    const auto model = load();
    ASSERT_TRUE(model) << model.error().message;
    const ShownPose shown(*model);
    std::vector<bool> is_hidden(model->figure.model.nodes.size(), false);
    is_hidden[3] = true;
    const auto seen = seen_skeleton(*model,
                                    shown,
                                    model->figure.model.character.humanoid,
                                    is_hidden,
                                    camera_before(*model, shown, "front", 1.0F),
                                    kBox);
    EXPECT_TRUE(std::none_of(
        seen.begin(), seen.end(), [](const SeenNode& node) { return node.node == 3; }));
}

TEST_F(ShownModels, labels_that_make_no_figure_are_said_and_the_model_is_shown) {
    ASSERT_TRUE(write_file(folder_ / "me.labels.toml",
                           "format = \"raks-avatar-labels\"\nversion = 1\n[bones]\n"
                           "hips = \"HandL\"\n"));
    const auto model = load();
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_TRUE(model->labels);
    EXPECT_EQ(model->labels_file, folder_ / "me.labels.toml");
    EXPECT_TRUE(std::any_of(model->notes.begin(), model->notes.end(), [](const auto& note) {
        return note.find("it cannot dance") != std::string::npos;
    })) << model->notes.size();
}

TEST_F(ShownModels, a_label_file_that_cannot_be_read_is_a_fault) {
    ASSERT_TRUE(write_file(folder_ / "me.labels.toml", "[bones\n"));
    const auto model = load();
    ASSERT_FALSE(model);
    EXPECT_NE(model.error().message.find("me.labels.toml"), std::string::npos)
        << model.error().message;
}

TEST_F(ShownModels, other_labels_move_it_at_once_and_its_motion_goes_and_comes_with_its_bones) {
    const std::string clip = std::string(RAKS_SOURCE_DIR) + "/tests/data/bvh/dance/own_dance.bvh";
    auto model = load();
    ASSERT_TRUE(model) << model.error().message;
    auto read = load_motion(clip, wearer_of(*model));
    ASSERT_TRUE(read) << read.error().message;
    wear(clip, std::move(*read), *model);
    const std::size_t frames = model->frame_count();
    const std::vector<std::string> notes = model->notes;
    EXPECT_GT(frames, 1U);

    stand_by_labels({{.bone = motion::Bone::hips, .node = "HandL"}}, *model);
    EXPECT_EQ(model->frame_count(), 1U) << "hips on a hand make no figure";
    EXPECT_FALSE(load_motion(clip, wearer_of(*model)));
    EXPECT_TRUE(std::any_of(model->notes.begin(), model->notes.end(), [](const auto& note) {
        return note.find("it cannot dance") != std::string::npos;
    }));

    stand_by_labels({}, *model);
    EXPECT_EQ(model->frame_count(), frames);
    EXPECT_EQ(model->notes, notes);
    EXPECT_FALSE(load_motion((folder_ / "none.bvh").string(), wearer_of(*model)));
}

TEST_F(ShownModels, a_clip_that_is_not_there_is_a_fault) {
    motion_ = (folder_ / "none.bvh").string();
    const auto model = load();
    ASSERT_FALSE(model);
    EXPECT_NE(model.error().message.find("none.bvh"), std::string::npos) << model.error().message;
}

}  // namespace
}  // namespace raks::apps
