#include "engine/show/dancer_bodies.hpp"

#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace raks::engine {
namespace {

constexpr render::AvatarHandle kFirst{0};
constexpr render::AvatarHandle kPartner{1};

std::shared_ptr<const render::Avatar> plain_avatar() {
    auto avatar = std::make_shared<render::Avatar>();
    avatar->skeleton = motion::mannequin_skeleton();
    return avatar;
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
    DancerBodies bodies(kFirst, plain_avatar(), motion::mannequin_skeleton());
    const auto three = worn(bodies, 3);
    std::set<int> outfits;
    for (const auto& [handle, outfit] : three) {
        EXPECT_EQ(handle, kFirst.number);
        outfits.insert(outfit);
    }
    EXPECT_EQ(outfits.size(), 3U);
}

TEST(DancerBodies, a_couple_is_a_lead_and_a_follow) {
    DancerBodies bodies(kFirst, plain_avatar(), motion::mannequin_skeleton());
    bodies.add_partner(kPartner, plain_avatar());
    const auto couple = worn(bodies, 2);
    EXPECT_EQ(couple[0].first, kPartner.number);
    EXPECT_EQ(couple[1].first, kFirst.number);
    EXPECT_NE(couple[0].second, couple[1].second);
}

TEST(DancerBodies, who_dances_alone_is_the_first_and_a_group_takes_turns) {
    DancerBodies bodies(kFirst, plain_avatar(), motion::mannequin_skeleton());
    bodies.add_partner(kPartner, plain_avatar());
    EXPECT_EQ(worn(bodies, 1).front().first, kFirst.number);
    const auto three = worn(bodies, 3);
    EXPECT_NE(three[0].first, three[1].first);
    EXPECT_EQ(three[0].first, three[2].first);
    EXPECT_NE(three[0].second, three[2].second);
}

}  // namespace
}  // namespace raks::engine
