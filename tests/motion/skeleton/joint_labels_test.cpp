// Joint maps and --joint lines.
#include "motion/skeleton/joint_labels.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace raks::motion {
namespace joint_labels_test {

const std::string kHead = "format = \"raks-joint-map\"\nversion = 1\n";

TEST(JointLabels, read_a_map) {
    const auto labels =
        read_joint_map(kHead + "[joints]\nhips = \"a b\"\nleftHand = \"\"\nhead = \"x:y\"\n", "m");
    ASSERT_TRUE(labels) << labels.error().message;
    ASSERT_EQ(labels->joints.size(), 2U);
    EXPECT_EQ(labels->source, "m");
    EXPECT_EQ(labels->joints[0].bone, Bone::head);
    EXPECT_EQ(labels->joints[0].joint, "x:y");
    EXPECT_EQ(labels->joints[1].joint, "a b");
}

TEST(JointLabels, faults_of_a_map_are_one_line) {
    const std::pair<std::string, std::string> table[] = {
        {"", "m: format must be \"raks-joint-map\""},
        {"format = \"raks-joint-map\"\nversion = 2\n[joints]\n",
         "m: version must be a number up to 1; is Raks older than the file?"},
        {kHead, "m: needs a table [joints] with lines like hips = \"Pelvis\""},
        {kHead + "[joints]\nleftUperArm = \"x\"\n",
         "m: line 4: key \"leftUperArm\" is unknown; did you mean \"leftUpperArm\"?"},
        {kHead + "[joints]\nhips = 3\n", "m: line 4: hips must be a text in quotes"},
        {kHead + "[joints]\nhips = \"x\"\nhead = \"x\"\n",
         "m: line 4: joint \"x\" is said to be head and hips; one joint is one bone"},
    };
    for (const auto& [text, message] : table) {
        const auto labels = read_joint_map(text, "m");
        ASSERT_FALSE(labels) << text;
        EXPECT_EQ(labels.error().message, message);
    }
}

TEST(JointLabels, a_line_takes_the_place_of_the_maps) {
    JointLabels labels{.joints = {{Bone::hips, "a"}, {Bone::head, "b"}}, .source = "m"};
    ASSERT_TRUE(add_joint_label("hips=c=d", labels));
    ASSERT_EQ(labels.joints.size(), 2U);
    EXPECT_EQ(labels.joints[1].joint, "c=d");
    EXPECT_EQ(add_joint_label("hips", labels).error().message,
              "\"hips\" must be BONE=JOINT, as leftUpperArm=bip_l_arm");
    EXPECT_EQ(add_joint_label("hip=c", labels).error().message,
              "bone \"hip\" is unknown; did you mean \"hips\"?");
    EXPECT_EQ(add_joint_label("=c", labels).error().message,
              "\"=c\" must be BONE=JOINT, as leftUpperArm=bip_l_arm");
    EXPECT_EQ(add_joint_label("neck=b", labels).error().message,
              "joint \"b\" is said to be head and neck; one joint is one bone");
}

TEST(JointLabels, a_bone_is_given_once) {
    const std::vector<std::string> lines = {"hips=a", "head=b", "hips=c"};
    const auto labels = joint_labels({}, lines);
    ASSERT_FALSE(labels);
    EXPECT_EQ(labels.error().message,
              "--joint: bone \"hips\" is given twice; one bone is one joint");
}

}  // namespace joint_labels_test
}  // namespace raks::motion
