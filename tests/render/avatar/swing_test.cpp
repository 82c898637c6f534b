#include "render/avatar/swing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <glm/geometric.hpp>

#include "render/avatar/avatar_rig.hpp"
#include "tests/render/avatar/tiny_model.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::render {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the tests' own small models

// A humanoid with a braid of four joints on its head.
Model with_braid() {
    Model model = humanoid_model();
    int node = model.character.humanoid.nodes[motion::index_of(motion::Bone::head)];
    SpringChain braid;
    for (int i = 0; i < 5; ++i) {
        node = add_node(model, "braid", node, {0, i == 0 ? 0.1F : -0.1F, i == 0 ? -0.15F : 0});
        SpringJoint joint;
        joint.node = node;
        braid.joints.push_back(joint);
    }
    model.character.springs.push_back(braid);
    return model;
}

motion::Pose pose_at(StreamTime time) {
    motion::Pose pose;
    const float t = static_cast<float>(to_seconds(time));
    pose.hips_position = {0.2F * std::sin(6.0F * t), 0.9F, 0.0F};
    pose.rotation(motion::Bone::hips) = turn_about_y(std::sin(5.0F * t));
    return pose;
}

class Dancer {
 public:
    Dancer() : rig_(build_rig(with_braid())), state_(rig_) {}

    // Place of the braid's tip against the head in a picture of this time.
    glm::vec3 tip(StreamTime time) {
        advance(rig_, time, 1.0F, pose_at, state_);
        pose_avatar(rig_, pose_at(time), {}, 1.0F, state_);
        return rig_.springs.tail_place(rig_.springs.size() - 1, state_.joints);
    }
    void reset() { state_.swing.reset(); }

 private:
    AvatarRig rig_;
    RigState state_;
};

TEST(Swing, steps_lie_on_whole_sixtieths_of_a_second) {
    for (SpringStep step = 0; step < 1000; ++step) {
        EXPECT_EQ(step_at(time_of_step(step)), step);
        EXPECT_EQ(step_at(time_of_step(step) - Nanos(1)), step - 1);
    }
    EXPECT_EQ(time_of_step(60), stream_time_from_seconds(1.0));
    const SpringStep a_day = 60 * 86'400;
    EXPECT_EQ(step_at(time_of_step(a_day) + Nanos(5)), a_day);
}

TEST(Swing, films_at_24_30_and_60_pictures_a_second_show_the_same_tails) {
    Dancer slow;
    Dancer middle;
    Dancer fast;
    const auto second = [](int picture, int rate) {
        return stream_time_from_seconds(static_cast<double>(picture) / rate);
    };
    // What each shows at whole twelfths, and every sixtieth for the fastest.
    for (int twelfth = 0; twelfth < 36; ++twelfth) {
        const glm::vec3 a = slow.tip(second(2 * twelfth, 24));
        slow.tip(second(2 * twelfth + 1, 24));
        glm::vec3 b{};
        for (int i = 0; i < 5; ++i) {
            const glm::vec3 shown = fast.tip(second(5 * twelfth + i, 60));
            b = i == 0 ? shown : b;
        }
        EXPECT_LT(glm::distance(a, b), 1e-5F) << twelfth;
        if (twelfth % 2 == 0) {
            for (int i = 0; i < 5; ++i) {
                const glm::vec3 shown = middle.tip(second(5 * twelfth / 2 + i, 30));
                EXPECT_TRUE(i > 0 || glm::distance(shown, b) < 1e-5F) << twelfth;
            }
        }
    }
}

TEST(Swing, pictures_between_two_steps_lie_between_them) {
    Dancer dancer;
    Dancer other;
    for (int i = 0; i < 60; ++i) {
        const StreamTime step = time_of_step(i);
        const glm::vec3 before = dancer.tip(step);
        other.tip(step);
        const glm::vec3 after = dancer.tip(time_of_step(i + 1));
        const glm::vec3 middle = other.tip(step + Nanos(8'333'333));
        EXPECT_LT(glm::distance(middle, 0.5F * (before + after)), 2e-3F) << i;
    }
}

TEST(Swing, a_seek_begins_anew_with_hair_that_hangs) {
    Dancer seeking;
    seeking.tip(stream_time_from_seconds(1.0));
    seeking.tip(stream_time_from_seconds(1.1));
    const glm::vec3 later = seeking.tip(stream_time_from_seconds(7.0));
    const glm::vec3 back = seeking.tip(stream_time_from_seconds(3.0));
    Dancer fresh;
    EXPECT_EQ(fresh.tip(stream_time_from_seconds(7.0)), later);
    fresh.reset();
    EXPECT_EQ(fresh.tip(stream_time_from_seconds(3.0)), back);
}

TEST(Swing, poses_are_asked_for_at_the_times_of_steps_alone) {
    const AvatarRig rig = build_rig(with_braid());
    RigState state(rig);
    std::vector<StreamTime> asked;
    const auto noting = [&](StreamTime time) {
        asked.push_back(time);
        return pose_at(time);
    };
    advance(rig, stream_time_from_seconds(0.02), 1.0F, noting, state);
    EXPECT_EQ(asked, (std::vector<StreamTime>{time_of_step(1), time_of_step(2)}));
    asked.clear();
    advance(rig, stream_time_from_seconds(0.021), 1.0F, noting, state);
    EXPECT_TRUE(asked.empty());
}

TEST(Swing, before_the_first_time_it_rests) {
    const AvatarRig rig = build_rig(with_braid());
    RigState state(rig);
    motion::Pose pose;
    pose.hips_position = rig.humanoid.rest_hips();
    const JointState rest = rest_state(rig.tree.joints);
    pose_avatar(rig, pose, {}, 1.0F, state);
    for (std::size_t i = 0; i < rig.tree.joints.size(); ++i) {
        EXPECT_LT(glm::distance(state.joints.world[i][3], rest.world[i][3]), 1e-5F);
    }
}

TEST(Swing, a_whole_picture_is_real_time_safe) {
    const AvatarRig rig = build_rig(with_braid());
    RigState state(rig);
    raks::test::RealtimeScope scope;
    for (int i = 0; i < 10; ++i) {
        const StreamTime time = stream_time_from_seconds(0.04 * i);
        advance(rig, time, 1.0F, pose_at, state);
        pose_avatar(rig, pose_at(time), {}, 1.0F, state);
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::render
