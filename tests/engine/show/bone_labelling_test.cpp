#include "engine/show/bone_labelling.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

using motion::Bone;
using render::BoneLabel;

render::Model model_of(const std::vector<std::string>& names) {
    render::Model model;
    for (const std::string& name : names) {
        model.nodes.emplace_back().name = name;
    }
    return model;
}

TEST(BoneLabelling, a_node_is_one_bone_and_a_bone_one_node) {
    const render::Model model = model_of({"a", "b"});
    BoneLabelling labels = bone_labelling({});
    ASSERT_TRUE(label_bone(model, Bone::head, 0, labels));
    ASSERT_TRUE(label_bone(model, Bone::hips, 1, labels));
    ASSERT_TRUE(label_bone(model, Bone::spine, 0, labels));
    ASSERT_TRUE(label_bone(model, Bone::hips, 0, labels));
    const std::vector<BoneLabel> expected = {{.bone = Bone::hips, .node = "a"}};
    EXPECT_EQ(labels.now(), expected);
}

TEST(BoneLabelling, each_label_is_a_step_that_is_taken_back_and_done_again) {
    const render::Model model = model_of({"a", "b"});
    BoneLabelling labels = bone_labelling({{.bone = Bone::hips, .node = "a"}});
    EXPECT_TRUE(labels.is_saved());
    ASSERT_TRUE(label_bone(model, Bone::head, 1, labels));
    EXPECT_FALSE(labels.is_saved());
    unlabel_bone(Bone::hips, labels);
    const auto after = labels.now();
    labels.undo();
    labels.undo();
    EXPECT_TRUE(labels.is_saved());
    EXPECT_FALSE(labels.can_undo());
    labels.redo();
    labels.redo();
    EXPECT_EQ(labels.now(), after);
}

TEST(BoneLabelling, a_rest_axis_is_a_step_of_a_label_that_there_is) {
    BoneLabelling labels = bone_labelling({{.bone = Bone::hips, .node = "a"}});
    set_rest_axis(Bone::head, {1.0F, 0.0F, 0.0F}, labels);
    EXPECT_FALSE(labels.can_undo()) << "nothing is said of the head";
    set_rest_axis(Bone::hips, {0.0F, -1.0F, 0.0F}, labels);
    EXPECT_EQ(labels.now().front().axis, glm::vec3(0.0F, -1.0F, 0.0F));
    labels.undo();
    EXPECT_EQ(labels.now().front().axis, glm::vec3(0.0F));
}

TEST(BoneLabelling, rest_axes_are_offered_one_after_the_other) {
    std::vector<std::string> names;
    glm::vec3 axis(0.0F);
    do {
        axis = next_rest_axis(axis);
        names.push_back(render::name_of_axis(axis));
    } while (axis != glm::vec3(0.0F) && names.size() < 10);
    EXPECT_EQ(names, (std::vector<std::string>{"x", "y", "z", "-x", "-y", "-z", ""}));
}

TEST(BoneLabelling, a_name_that_does_not_tell_the_node_is_refused) {
    const render::Model model = model_of({"twice", "twice", "", "\xFF"});
    BoneLabelling labels = bone_labelling({});
    for (int node = 0; node < 4; ++node) {
        const auto done = label_bone(model, Bone::hips, node, labels);
        ASSERT_FALSE(done) << node;
        EXPECT_NE(done.error().message.find("cannot be labelled"), std::string::npos);
    }
    EXPECT_TRUE(labels.now().empty());
}

TEST(BoneLabelling, what_is_saved_is_read_again_whatever_the_names_are) {
    const test::TemporaryFolder folder;
    const auto file = folder / "me.labels.toml";
    const render::Model model = model_of({"say \"hips\"", "back\\slash", "ü#1"});
    BoneLabelling labels = bone_labelling(
        {{.bone = Bone::left_upper_arm, .node = "arm", .axis = {0.0F, -1.0F, 0.0F}}});
    ASSERT_TRUE(label_bone(model, Bone::hips, 0, labels));
    ASSERT_TRUE(label_bone(model, Bone::spine, 1, labels));
    ASSERT_TRUE(label_bone(model, Bone::head, 2, labels));
    ASSERT_TRUE(save_labels(file, labels));
    EXPECT_TRUE(labels.is_saved());
    const auto read = render::read_bone_labels(read_file(file).value_or(""), "me");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(bone_labelling(read->bones).now(), labels.now());
}

TEST(BoneLabelling, without_labels_there_is_no_file) {
    const test::TemporaryFolder folder;
    const auto file = folder / "me.labels.toml";
    BoneLabelling labels = bone_labelling({{.bone = Bone::hips, .node = "a"}});
    ASSERT_TRUE(save_labels(file, labels));
    EXPECT_TRUE(std::filesystem::exists(file));
    unlabel_bone(Bone::hips, labels);
    ASSERT_TRUE(save_labels(file, labels));
    EXPECT_TRUE(folder.is_empty());
}

}  // namespace
}  // namespace raks::engine
