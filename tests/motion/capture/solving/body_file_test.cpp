#include "motion/capture/solving/body_file.hpp"

#include <gtest/gtest.h>

#include <string>

namespace raks::capture {
namespace {

const std::string kHead = "format = \"raks-joints\"\nversion = 1\n";
const std::string kRoot = "[[joint]]\nname = \"hips\"\nbones = [\"hips\"]\n";

std::string joint(const std::string& name, const std::string& parent, const std::string& rest) {
    return "[[joint]]\nname = \"" + name + "\"\nparent = \"" + parent + "\"\n" + rest + "\n";
}

std::string error_of(const std::string& joints) {
    const auto model = read_body_model(kHead + joints, "b.toml");
    return model ? std::string() : model.error().message;
}

TEST(BodyFile, reads_joints_in_any_order_with_parents_first) {
    const std::string elbow = joint(
        "elbow", "shoulder", "bones = [\"leftLowerArm\"]\naxis = [0, -2, 0]\nlimits = [0, 150]");
    const std::string shoulder =
        joint("shoulder", "hips", "bones = [\"leftUpperArm\"]\nlimit = 160\nusual = [0, 0, -50]");
    const auto model = read_body_model(kHead + elbow + kRoot + shoulder, "b.toml");
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_EQ(model->joints().size(), 3U);
    EXPECT_EQ(model->joints()[0].name, "hips");
    EXPECT_EQ(model->joints()[1].name, "shoulder");
    EXPECT_EQ(model->joints()[2].name, "elbow");
    EXPECT_EQ(model->parent_of(2), 1U);
    EXPECT_EQ(model->variables(), 3U + 3U + 3U + 1U);
    EXPECT_NEAR(model->joints()[2].highest, 150.0 * M_PI / 180.0, 1e-12);
    EXPECT_NEAR(model->joints()[2].axis.y, -1.0, 1e-12);
}

TEST(BodyFile, the_bodies_that_are_shipped_read_back) {
    for (const BodyKind kind : {BodyKind::paper, BodyKind::dance}) {
        const BodyModel model(kind);
        const auto again = read_body_model(body_model_text(model), "b.toml");
        ASSERT_TRUE(again) << again.error().message;
        ASSERT_EQ(again->joints().size(), model.joints().size());
        EXPECT_EQ(again->variables(), model.variables());
        for (std::size_t i = 0; i < model.joints().size(); ++i) {
            const TurningJoint& one = model.joints()[i];
            const TurningJoint& other = again->joints()[i];
            EXPECT_EQ(other.name, one.name);
            EXPECT_EQ(other.bones, one.bones);
            EXPECT_EQ(other.is_hinge, one.is_hinge);
            EXPECT_NEAR(other.lowest, one.lowest, 1e-9);
            EXPECT_EQ(other.acceleration, one.acceleration);
            EXPECT_NEAR(other.usual_angle, one.usual_angle, 1e-9);
        }
    }
}

TEST(BodyFile, says_in_one_line_what_is_no_body) {
    const std::string bone = "bones = [\"leftUpperArm\"]";
    const struct {
        std::string joints;
        std::string error;
    } cases[] = {
        {"", "b.toml: needs [[joint]] with name and bones, 1 to 24"},
        {kRoot + joint("a", "b", bone) + joint("b", "a", "bones = [\"leftLowerArm\"]"),
         "b.toml: line 6: joint \"a\" hangs on itself, in a loop by way of \"b\""},
        {joint("a", "b", bone) + joint("b", "a", "bones = [\"leftLowerArm\"]"),
         "b.toml: no joint is the root: one has no parent, and bones = [\"hips\"]"},
        {kRoot + joint("a", "nobody", bone),
         "b.toml: line 6: joint \"a\" hangs on \"nobody\", which there is not"},
        {kRoot + "[[joint]]\nname = \"x\"\n" + bone,
         "b.toml: line 6: joint \"x\" is a second root; give it a parent"},
        {"[[joint]]\nname = \"x\"\n" + bone,
         "b.toml: line 3: the root, the joint without parent, must have bones = [\"hips\"]"},
        {kRoot + joint("a", "hips", bone) + joint("b", "a", "bones = [\"rightHand\"]"),
         "b.toml: line 10: joint \"b\" cannot hang on \"a\": rightHand does not hang on "
         "leftUpperArm"},
        {kRoot + joint("a", "hips", bone) + joint("b", "hips", "bones = [\"leftHand\"]"),
         "b.toml: line 10: joint \"a\" turns leftUpperArm between \"hips\" and \"b\"; hang one on "
         "the other"},
        {kRoot + joint("a", "hips", bone + "\naxis = [0, 0, 0]"),
         "b.toml: line 6: axis has no length; [1, 0, 0] is the left"},
        {kRoot + joint("a", "hips", bone + "\naxis = [1, 0, 0]\nlimits = [10, 5]"),
         "b.toml: line 11: limits must rise: [lowest, highest], degrees"},
        {kRoot + joint("a", "hips", bone + "\nlimits = [0, 5]"),
         "b.toml: line 10: limits are those of a hinge, which has an axis; else limit = the whole "
         "turn"},
        {kRoot + joint("a", "hips", "bones = [\"leftUperArm\"]"),
         "b.toml: line 9: bone \"leftUperArm\" is unknown; did you mean \"leftUpperArm\"?"},
        {kRoot + joint("hips", "hips", bone), "b.toml: line 6: two joints are called \"hips\""},
    };
    for (const auto& one : cases) {
        EXPECT_EQ(error_of(one.joints), one.error);
    }
}

}  // namespace
}  // namespace raks::capture
