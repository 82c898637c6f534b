// Joints of real clips: of suits, data sets and our own motion under other names and rest poses.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "motion/skeleton/body/joint_finder.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "tests/support/shared_data.hpp"

namespace raks::motion {
namespace real_clips_test {

namespace fs = std::filesystem;

class RealClips : public ::testing::Test {
 protected:
    void SetUp() override {
        if (!fs::exists(raks::test::shared_data() / "cases")) {
            GTEST_SKIP() << "no clips in " << raks::test::shared_data();
        }
    }
    static MotionClip clip_of(const std::string& name) {
        auto clip = read_bvh(raks::test::shared_data() / name);
        EXPECT_TRUE(clip) << clip.error().message;
        return clip ? std::move(*clip) : MotionClip{};
    }
    /// What is found, with no word about it.
    static FoundJoints joints_of(const MotionClip& clip) {
        const auto found = find_joints(clip);
        EXPECT_TRUE(found) << found.error().message;
        EXPECT_TRUE(!found || found->notes.empty()) << found->notes.front();
        return found ? *found : FoundJoints{};
    }
    static MotionClip without_names(MotionClip clip) {
        for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
            clip.joints[joint].name = "joint_" + std::to_string(joint * 37 % 101);
        }
        return clip;
    }
};

TEST_F(RealClips, one_motion_under_other_names_and_rest_poses_is_one_body) {
    const auto expected = joints_of(clip_of("cases/V01-flat-rest/n_cmu.bvh")).mapping.joints;
    for (const char* const name : {"V01-flat-rest/rest_alongx.bvh",
                                   "V02-names/n_rokoko.bvh",
                                   "V02-names/n_smpl.bvh",
                                   "V02-names/n_vroid.bvh",
                                   "V02-names/n_xsens.bvh",
                                   "V03-a-pose/rest_apose45.bvh",
                                   "V04-z-up/zup.bvh"}) {
        const MotionClip clip = clip_of(std::string("cases/") + name);
        EXPECT_EQ(joints_of(clip).mapping.joints, expected) << name;
        const auto nameless = find_joints(without_names(clip));
        ASSERT_TRUE(nameless) << name << nameless.error().message;
        EXPECT_EQ(nameless->mapping.joints, expected) << name;
    }
}

TEST_F(RealClips, a_suit_without_names_has_the_same_limbs) {
    const MotionClip clip = clip_of("cases/V01b-rokoko-flat/rokoko_dance60.bvh");
    const FoundJoints named = joints_of(clip);
    const auto nameless = find_joints(without_names(clip));
    ASSERT_TRUE(nameless) << nameless.error().message;
    for (const Bone left : {Bone::left_upper_leg,
                            Bone::left_lower_leg,
                            Bone::left_foot,
                            Bone::left_toes,
                            Bone::left_shoulder,
                            Bone::left_upper_arm,
                            Bone::left_lower_arm,
                            Bone::left_hand}) {
        for (const Side side : kSides) {
            const Bone bone = on_side(left, side);
            EXPECT_EQ(nameless->mapping.joint(bone), named.mapping.joint(bone))
                << kBoneNames[index_of(bone)];
        }
    }
}

/// The shipped figures are learnt from these: lButtock is folded into lThigh, eyes are no bones.
TEST_F(RealClips, salsa_has_the_bones_that_figures_were_learnt_with) {
    const MotionClip clip = clip_of("mocap/salsa/60_03_973_1679.bvh");
    const FoundJoints found = joints_of(clip);
    const std::map<Bone, std::string> expected = {
        {Bone::hips, "hip"},
        {Bone::spine, "abdomen"},
        {Bone::chest, "chest"},
        {Bone::neck, "neck"},
        {Bone::head, "head"},
        {Bone::left_upper_leg, "lThigh"},
        {Bone::left_lower_leg, "lShin"},
        {Bone::left_foot, "lFoot"},
        {Bone::left_shoulder, "lCollar"},
        {Bone::left_upper_arm, "lShldr"},
        {Bone::left_lower_arm, "lForeArm"},
        {Bone::left_hand, "lHand"},
        {Bone::left_thumb_proximal, "lThumb1"},
        {Bone::left_thumb_distal, "lThumb2"},
        {Bone::left_index_proximal, "lIndex1"},
        {Bone::left_index_intermediate, "lIndex2"},
        {Bone::left_middle_proximal, "lMid1"},
        {Bone::left_middle_intermediate, "lMid2"},
        {Bone::left_ring_proximal, "lRing1"},
        {Bone::left_ring_intermediate, "lRing2"},
        {Bone::left_little_proximal, "lPinky1"},
        {Bone::left_little_intermediate, "lPinky2"},
    };
    for (int i = 0; i < kBoneCount; ++i) {
        const Bone bone = static_cast<Bone>(i);
        const auto joint = found.mapping.joint(bone);
        const auto name = expected.find(std::min(bone, mirrored(bone)));
        std::string is = name != expected.end() ? name->second : "-";
        if (bone > mirrored(bone) && is != "-") {
            is.front() = 'r';
        }
        EXPECT_EQ(joint ? clip.joints[*joint].name : "-", is) << kBoneNames[index_of(bone)];
    }
}

}  // namespace real_clips_test
}  // namespace raks::motion
