#include "engine/show/dancer_bodies.hpp"

#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render/avatar/avatar_rig.hpp"

namespace raks::engine {
namespace {

constexpr render::AvatarHandle kFirst{0};
constexpr render::AvatarHandle kPartner{1};

std::shared_ptr<const render::Avatar> plain_avatar(float height = render::kMannequinHeight) {
    auto avatar = std::make_shared<render::Avatar>();
    avatar->skeleton =
        motion::scaled(motion::mannequin_skeleton(), height / render::kMannequinHeight);
    avatar->height = height;
    return avatar;
}

DancerBodies bodies_of(DancerBodies::Wardrobe wardrobe) {
    return {std::move(wardrobe), motion::mannequin_skeleton()};
}

/// Handle and outfit of each of so many dancers.
std::vector<std::pair<int, int>> worn(DancerBodies& bodies, std::size_t count) {
    const std::vector<motion::PoseTrack> tracks(count);
    const DancedMoment danced{.tracks = tracks, .moment = {}, .lead = {}};
    std::vector<std::pair<int, int>> all;
    for (const render::Dancer& dancer : bodies.at(danced, {}, {})) {
        all.emplace_back(dancer.avatar.number, dancer.outfit);
    }
    return all;
}

TEST(DancerBodies, one_avatar_is_worn_by_all_in_outfits_that_differ) {
    DancerBodies bodies = bodies_of({{{kFirst, plain_avatar()}}});
    const auto three = worn(bodies, 3);
    std::set<int> outfits;
    for (const auto& [handle, outfit] : three) {
        EXPECT_EQ(handle, kFirst.number);
        outfits.insert(outfit);
    }
    EXPECT_EQ(outfits.size(), 3U);
}

TEST(DancerBodies, a_couple_is_a_lead_and_a_follow) {
    DancerBodies bodies = bodies_of({{{kFirst, plain_avatar()}, {kPartner, plain_avatar()}}});
    const auto couple = worn(bodies, 2);
    EXPECT_EQ(couple[0].first, kPartner.number);
    EXPECT_EQ(couple[1].first, kFirst.number);
    EXPECT_NE(couple[0].second, couple[1].second);
}

TEST(DancerBodies, who_dances_alone_is_the_first_and_a_group_takes_turns) {
    DancerBodies bodies = bodies_of({{{kFirst, plain_avatar()}, {kPartner, plain_avatar()}}});
    EXPECT_EQ(worn(bodies, 1).front().first, kFirst.number);
    const auto three = worn(bodies, 3);
    EXPECT_NE(three[0].first, three[1].first);
    EXPECT_EQ(three[0].first, three[2].first);
    EXPECT_NE(three[0].second, three[2].second);
}

TEST(DancerBodies, several_avatars_are_worn_in_turn) {
    const render::AvatarHandle third{2};
    DancerBodies bodies = bodies_of(
        {{{kFirst, plain_avatar()}}, {{kPartner, plain_avatar()}}, {{third, plain_avatar()}}});
    const auto seven = worn(bodies, 7);
    for (std::size_t i = 0; i < seven.size(); ++i) {
        EXPECT_EQ(seven[i].first, static_cast<int>(i % 3)) << i;
    }
    EXPECT_EQ(worn(bodies, 2).front().first, kFirst.number) << "a couple's lead has the first";
}

TEST(DancerBodies, among_several_the_second_build_is_worn_by_every_second_one_who_wears_it) {
    const render::AvatarHandle other{2};
    DancerBodies bodies = bodies_of(
        {{{kFirst, plain_avatar()}, {kPartner, plain_avatar()}}, {{other, plain_avatar()}}});
    const auto six = worn(bodies, 6);
    EXPECT_EQ(six[0].first, kFirst.number);
    EXPECT_EQ(six[2].first, kPartner.number);
    EXPECT_EQ(six[4].first, kFirst.number);
    EXPECT_EQ(six[1].first, other.number);
    EXPECT_EQ(six[3].first, other.number);
}

TEST(DancerBodies, of_differing_sizes_keep_the_places_that_the_largest_need) {
    const float twice = 2.0F * render::kMannequinHeight;
    DancerBodies bodies =
        bodies_of({{{kFirst, plain_avatar()}}, {{kPartner, plain_avatar(twice)}}});
    EXPECT_FLOAT_EQ(bodies.size(), 2.0F);
    const std::vector<glm::vec2> places = {{-1.3F, 0.0F}, {1.3F, 0.5F}};
    std::vector<motion::PoseTrack> tracks(2);
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        motion::Pose pose;
        // A step aside from its place.
        pose.hips_position = {places[i].x + 0.1F, 0.9F, places[i].y};
        tracks[i].append_final(0, pose);
    }
    const auto dancers = bodies.at({.tracks = tracks, .places = places}, {}, {});
    EXPECT_NEAR(dancers[0].pose.hips_position.x, -2.6F + 0.1F, 1e-5F);
    EXPECT_NEAR(dancers[1].pose.hips_position.x, 2.6F + 0.2F, 1e-5F);
    EXPECT_NEAR(dancers[0].pose.hips_position.y, 0.9F, 1e-5F);
    EXPECT_NEAR(dancers[1].pose.hips_position.y, 1.8F, 1e-5F);
    EXPECT_NEAR(dancers[1].pose.hips_position.z, 1.0F, 1e-5F);
}

TEST(DancerBodies, a_clip_moves_what_a_pose_does_not_hold) {
    render::Model model;
    model.nodes.resize(2);
    model.nodes[0].children = {1};
    model.nodes[1].parent = 0;
    model.roots = {0};
    model.character.humanoid.nodes[0] = 0;
    auto avatar = std::make_shared<render::Avatar>(*plain_avatar());
    avatar->rig = std::make_shared<const render::AvatarRig>(render::build_rig(model));
    DancerBodies bodies = bodies_of({{{kFirst, avatar}}});
    const std::vector<motion::PoseTrack> tracks(1);
    DancedMoment danced{.tracks = tracks, .moment = {}, .lead = {}};
    danced.move_others = [](const motion::Pose& /*pose*/,
                            const render::JointTree& /*tree*/,
                            render::JointState& state) { state.translations[1].y = 2.0F; };
    const auto dancers = bodies.at(danced, {}, {});
    ASSERT_NE(dancers.front().state, nullptr);
    const std::vector<glm::mat4>& world = dancers.front().state->joints.world;
    EXPECT_EQ(world[1][3].y - world[0][3].y, 2.0F);
}

TEST(DancerBodies, a_body_that_is_worn_twice_is_one_in_the_renderer) {
    const auto body = plain_avatar();
    const LoadedAvatar avatar{.avatar = body, .name = {}, .credit = {}, .warnings = {}};
    const Costumes costumes = costumes_of({avatar, avatar});
    EXPECT_EQ(costumes.bodies.size(), 1U);
    const auto wardrobe = wardrobe_of(costumes, {{kPartner, body}});
    ASSERT_EQ(wardrobe.size(), 2U);
    EXPECT_EQ(wardrobe[1].front().handle.number, kPartner.number);
    EXPECT_EQ(handles_of(wardrobe).size(), 1U);
}

}  // namespace
}  // namespace raks::engine
