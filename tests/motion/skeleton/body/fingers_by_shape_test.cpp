// Fingers of a hand whose joints' names say nothing.
#include "motion/skeleton/body/fingers_by_shape.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "motion/skeleton/body/joint_finder.hpp"
#include "tests/motion/skeleton/body/dancing_clip.hpp"

namespace raks::motion {
namespace fingers_by_shape_test {

using body_test::DancingClip;

constexpr std::array<Bone, 5> kFirst = {Bone::left_thumb_metacarpal,
                                        Bone::left_index_proximal,
                                        Bone::left_middle_proximal,
                                        Bone::left_ring_proximal,
                                        Bone::left_little_proximal};

struct Form {
    std::array<std::size_t, 5> order = {0, 1, 2, 3, 4};  // in which the file has the fingers
    bool has_palm = false;                               // a joint of each finger within the palm
    bool has_tips = false;                               // a joint at each tip
    std::size_t count = 5;                               // of fingers
};

/// A clip with fingers on both hands, in metres by the size of a person's; all hang straight.
struct Handed {
    DancingClip dancing;

    explicit Handed(const Form& form) {
        dancing.forget_names();
        for (const Side side : kSides) {
            const double out = side == Side::left ? 1.0 : -1.0;
            for (std::size_t i = 0; i < form.count; ++i) {
                add_finger(form, form.order[i], side, out);
            }
        }
        // The joints that came later do not turn.
        MotionClip& clip = dancing.clip;
        const std::size_t all = clip.joints.size();
        const std::size_t before = clip.rotations.size() / clip.frame_count;
        std::vector<glm::dquat> rotations;
        std::vector<glm::dvec3> positions;
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
            for (std::size_t joint = 0; joint < all; ++joint) {
                const bool is_old = joint < before;
                rotations.push_back(is_old ? clip.rotations[frame * before + joint]
                                           : glm::dquat(1, 0, 0, 0));
                positions.push_back(is_old ? clip.positions[frame * before + joint]
                                           : clip.joints[joint].offset);
            }
        }
        clip.rotations = std::move(rotations);
        clip.positions = std::move(positions);
    }

 private:
    std::size_t add(std::size_t parent, const glm::dvec3& offset) {
        dancing.clip.joints.push_back({.name = "f" + std::to_string(dancing.clip.joints.size()),
                                       .parent = parent,
                                       .offset = offset,
                                       .end_site = {}});
        return dancing.clip.joints.size() - 1;
    }

    void add_finger(const Form& form, std::size_t finger, Side side, double out) {
        std::size_t at = dancing.joints.at(on_side(Bone::left_hand, side));
        const glm::dvec3 knuckle =
            finger == 0
                ? glm::dvec3(2.5 * out, -1, 2.5)
                : glm::dvec3((9.8 - 0.4 * double(finger)) * out, 0, 4.5 - 2.0 * double(finger));
        if (form.has_palm && finger > 0) {
            at = add(at, 0.3 * knuckle);
            at = add(at, 0.7 * knuckle);
        } else {
            at = add(at, knuckle);
        }
        for (std::size_t bone = 0; bone < 3; ++bone) {
            const Bone left = static_cast<Bone>(index_of(kFirst[finger]) + bone);
            dancing.joints[on_side(left, side)] = at;
            if (bone < 2 || form.has_tips) {
                at = add(at, {(4.0 - double(bone)) * out, 0, finger == 0 ? 2.0 : 0.0});
            }
        }
    }
};

TEST(FingersByShape, are_told_whatever_their_order_palm_and_tips) {
    for (const bool has_palm : {false, true}) {
        for (const bool has_tips : {false, true}) {
            for (const std::array<std::size_t, 5>& order :
                 {std::array<std::size_t, 5>{0, 1, 2, 3, 4}, {4, 3, 2, 1, 0}, {2, 4, 0, 3, 1}}) {
                const Handed handed({order, has_palm, has_tips, 5});
                const auto found = find_joints(handed.dancing.clip);
                ASSERT_TRUE(found) << found.error().message;
                for (const auto& [bone, joint] : handed.dancing.joints) {
                    EXPECT_EQ(found->mapping.joint(bone), joint) << kBoneNames[index_of(bone)];
                }
            }
        }
    }
}

TEST(FingersByShape, of_another_number_stay_at_rest_which_is_said) {
    const Handed handed({{0, 1, 2, 3, 4}, false, false, 4});
    const auto found = find_joints(handed.dancing.clip);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_FALSE(found->mapping.joint(Bone::left_index_proximal));
    EXPECT_EQ(found->notes.back(),
              "which finger is which is not clear (4 chains of joints on a hand); they stay at "
              "rest (--joints says which they are)");
}

TEST(FingersByShape, without_a_thumb_are_not_guessed) {
    MotionClip clip;
    clip.frame_count = 1;
    const auto add = [&](std::size_t parent, const glm::dvec3& offset) {
        clip.joints.push_back({.name = "", .parent = parent, .offset = offset, .end_site = {}});
        clip.positions.push_back(offset);
        clip.rotations.emplace_back(1, 0, 0, 0);
        return clip.joints.size() - 1;
    };
    const std::size_t hand = add(0, {0, 0, 0});
    for (int finger = 0; finger < 5; ++finger) {
        const std::size_t knuckle = add(hand, {9, 0, 4.0 - 2.0 * finger});
        add(add(knuckle, {3, 0, 0}), {2, 0, 0});
    }
    const FingersByShape found = fingers_by_shape(PosedSkeleton(clip), static_cast<int>(hand));
    EXPECT_EQ(found.chains, 5);
    EXPECT_FALSE(found.is_found);
}

}  // namespace fingers_by_shape_test
}  // namespace raks::motion
