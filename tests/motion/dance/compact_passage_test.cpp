// A passage in half the memory is the same dance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>

#include "base/packer.hpp"
#include "motion/dance/baking/figure_passage.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

constexpr int kFigureBeats = 4;

// All bones turn, each about an axis and at a pace of its own, while the hips go aside.
FreeFigure turning() {
    FreeFigure figure;
    const int poses = (kFigureBeats + 2 * kBeatsAround) * figure.samples_per_beat;
    for (int i = 0; i < poses; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(figure.samples_per_beat);
        Pose pose;
        for (std::size_t bone = 0; bone < FigurePassage::kBones.size(); ++bone) {
            const float own = 0.3F + 0.1F * static_cast<float>(bone);
            pose.rotation(FigurePassage::kBones[bone]) = glm::angleAxis(
                0.8F * std::sin(own * t), glm::normalize(glm::vec3(own, 1.0F, 1.0F - own)));
        }
        pose.hips_position = {0.2F * std::sin(t), 0.9F, 0.1F * t};
        pose.foot_contact = {i % 40 < 20, i % 40 >= 20};
        figure.poses.push_back(pose);
    }
    return figure;
}

TEST(CompactPassage, moves_no_limb_by_a_tenth_of_a_millimetre) {
    const FigurePassage whole(turning());
    const FigurePassage small = whole.compact();
    float farthest = 0.0F;
    for (double beat = -FigurePassage::kMargin; beat < kFigureBeats + FigurePassage::kMargin;
         beat += 0.013) {
        Pose a;
        Pose b;
        whole.at(beat, a);
        small.at(beat, b);
        EXPECT_EQ(a.hips_position, b.hips_position);
        EXPECT_EQ(a.foot_contact, b.foot_contact);
        const WorldPose world_a = world_pose(mannequin_skeleton(), a);
        const WorldPose world_b = world_pose(mannequin_skeleton(), b);
        for (const Bone bone :
             {Bone::head, Bone::left_toes, Bone::right_toes, Bone::left_hand, Bone::right_hand}) {
            farthest =
                std::max(farthest, glm::distance(world_a.position(bone), world_b.position(bone)));
        }
        Pose arms;
        small.arms_at(beat, arms);
        EXPECT_EQ(arms.rotation(Bone::left_hand), b.rotation(Bone::left_hand));
    }
    EXPECT_LT(farthest, 1e-4F);
    EXPECT_GT(farthest, 0.0F);
}

TEST(CompactPassage, takes_half_the_bytes_and_is_unpacked_to_the_bit) {
    const FigurePassage whole(turning());
    const FigurePassage small = whole.compact();
    EXPECT_TRUE(small.covers(kFigureBeats));
    EXPECT_FALSE(small.covers(kFigureBeats + 1));
    Packer of_whole("12345678");
    whole.pack(of_whole);
    Packer of_small("12345678");
    small.pack(of_small);
    const auto bytes = std::make_shared<const std::string>(of_small.take());
    EXPECT_LT(static_cast<double>(bytes->size()),
              0.53 * static_cast<double>(of_whole.take().size()));
    Unpacker unpacker(std::string_view(*bytes).substr(8));
    const FigurePassage again = FigurePassage::unpack(unpacker, bytes);
    ASSERT_TRUE(unpacker.is_good());
    EXPECT_TRUE(again.covers(kFigureBeats));
    Pose a;
    Pose b;
    small.at(1.37, a);
    again.at(1.37, b);
    EXPECT_EQ(a.local_rotations, b.local_rotations);
}

}  // namespace
}  // namespace raks::motion
