// Dancers who go on where others are, on another body.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "motion/dance_library.hpp"
#include "motion/ensemble.hpp"
#include "motion/repertoire.hpp"
#include "tests/motion/dance/stage.hpp"
#include "tests/support/dances.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::motion {
namespace {

constexpr double kGoingOnBpm = 168.0;
constexpr HopIndex kGoesOnAt = 1'700;
constexpr HopIndex kGoingOnHops = 2'400;

/// A body as high as the mannequin that is thicker, with longer arms and thighs, shorter shins.
Skeleton other_body() {
    Skeleton body = mannequin_skeleton();
    body.girth.trunk = 0.12F;
    body.girth.thigh = 0.09F;
    for (const Side side : kSides) {
        body.offsets[index_of(on_side(Bone::left_lower_arm, side))] *= 1.1F;
        body.offsets[index_of(on_side(Bone::left_lower_leg, side))] *= 1.04F;
        body.offsets[index_of(on_side(Bone::left_foot, side))] *= 0.96F;
    }
    return body;
}

std::shared_ptr<const Repertoire> one_figure_on(const Skeleton& body) {
    const FigureModel& model = test::basic_step();
    return std::make_shared<Repertoire>(shipped::salsa,
                                        *DanceLibrary::build(std::span(&model, 1), body));
}

struct GoneOn {
    std::vector<Pose> poses;
    std::vector<DancerStatus> hops;
};

/// Dances on the mannequin, from kGoesOnAt on with the dancer given, if any.
GoneOn dance_and_go_on(Dancer* next) {
    Dancer first;
    EXPECT_TRUE(
        first.prepare(one_figure_on(mannequin_skeleton()), mannequin_skeleton(), DancerPart{}));
    GoneOn danced;
    const auto track = std::make_unique<PoseTrack>();
    Dancer* dancer = &first;
    for (HopIndex hop = 0; hop < kGoingOnHops; ++hop) {
        if (hop == kGoesOnAt && next != nullptr) {
            next->go_on_from(first);
            dancer = next;
        }
        dancer->advance(test::sure_state(hop, test::steady_grid(kGoingOnBpm)), *track);
        danced.poses.push_back(track->at_hop(hop));
        danced.hops.push_back(dancer->status());
    }
    return danced;
}

Dancer dancer_of_body(const Skeleton& body) {
    Dancer dancer;
    EXPECT_TRUE(dancer.prepare(one_figure_on(body), body, DancerPart{}));
    return dancer;
}

TEST(GoingOn, on_the_same_body_changes_nothing) {
    Dancer same = dancer_of_body(mannequin_skeleton());
    const GoneOn changed = dance_and_go_on(&same);
    const GoneOn alone = dance_and_go_on(nullptr);
    for (std::size_t hop = 0; hop < changed.poses.size(); ++hop) {
        ASSERT_LT(glm::distance(changed.poses[hop].hips_position, alone.poses[hop].hips_position),
                  1e-4F)
            << hop;
        ASSERT_EQ(changed.hops[hop].number, alone.hops[hop].number) << hop;
        ASSERT_EQ(changed.hops[hop].phase, alone.hops[hop].phase) << hop;
    }
}

TEST(GoingOn, on_another_body_is_the_same_dance_without_a_leap) {
    Dancer other = dancer_of_body(other_body());
    const GoneOn changed = dance_and_go_on(&other);
    for (std::size_t hop = kGoesOnAt; hop < changed.hops.size(); ++hop) {
        ASSERT_TRUE(changed.hops[hop].is_dancing) << hop;
    }
    const double usual = test::largest_step(changed.poses, 0, kGoesOnAt - 1);
    EXPECT_LT(test::largest_step(changed.poses, kGoesOnAt - 1, kGoingOnHops), 1.45 * usual);
    EXPECT_EQ(changed.hops[kGoesOnAt].number, changed.hops[kGoesOnAt - 1].number);
    // At last it dances as one who danced on that body from the beginning.
    const auto track = std::make_unique<PoseTrack>();
    Dancer always = dancer_of_body(other_body());
    for (HopIndex hop = 0; hop < kGoingOnHops; ++hop) {
        always.advance(test::sure_state(hop, test::steady_grid(kGoingOnBpm)), *track);
    }
    EXPECT_LT(glm::distance(track->at_hop(kGoingOnHops - 1).hips_position,
                            changed.poses.back().hips_position),
              0.01F);
}

TEST(GoingOn, before_the_first_hop_and_while_standing_is_to_stand) {
    Dancer first = dancer_of_body(mannequin_skeleton());
    Dancer other = dancer_of_body(other_body());
    other.go_on_from(first);
    EXPECT_GT(other.shown().hips_position.y, 0.8F);
    const auto track = std::make_unique<PoseTrack>();
    other.advance(MusicState{}, *track);
    EXPECT_FALSE(other.status().is_dancing);
}

TEST(GoingOn, with_a_dance_that_is_not_known_is_to_stand_there_softly) {
    Dancer first = dancer_of_body(mannequin_skeleton());
    const FigureModel& model = test::basic_step();
    Dancer stranger;
    ASSERT_TRUE(stranger.prepare(
        std::make_shared<Repertoire>(
            shipped::belly, *DanceLibrary::build(std::span(&model, 1), mannequin_skeleton())),
        mannequin_skeleton(),
        DancerPart{}));
    const auto track = std::make_unique<PoseTrack>();
    std::vector<Pose> poses;
    for (HopIndex hop = 0; hop < kGoesOnAt + 40; ++hop) {
        if (hop == kGoesOnAt) {
            stranger.go_on_from(first);
        }
        Dancer& dancer = hop < kGoesOnAt ? first : stranger;
        dancer.advance(test::sure_state(hop, test::steady_grid(kGoingOnBpm)), *track);
        poses.push_back(track->at_hop(hop));
    }
    EXPECT_LT(test::largest_step(poses, kGoesOnAt - 1, kGoesOnAt + 40), test::kFastestStep);
}

TEST(GoingOn, dancers_of_several_bodies_dance_as_each_body_would) {
    const DancingBody own{mannequin_skeleton(), one_figure_on(mannequin_skeleton())};
    const DancingBody other{other_body(), one_figure_on(other_body())};
    const auto dance = [](const std::vector<DancingBody>& bodies) {
        Ensemble ensemble;
        EXPECT_TRUE(ensemble.prepare(members_of(Formation::unison, bodies, 1)));
        std::vector<PoseTrack> tracks(ensemble.size());
        for (HopIndex hop = 0; hop < 700; ++hop) {
            ensemble.advance(test::sure_state(hop, test::steady_grid(kGoingOnBpm)), tracks);
        }
        return tracks;
    };
    const auto mixed = dance({own, other});
    const auto all_own = dance({own});
    const auto all_other = dance({other});
    ASSERT_EQ(mixed.size(), 3U);
    for (HopIndex hop = mixed[0].oldest_final(); hop <= mixed[0].newest(); ++hop) {
        EXPECT_TRUE(test::are_same(mixed[0].at_hop(hop), all_own[0].at_hop(hop)));
        EXPECT_TRUE(test::are_same(mixed[1].at_hop(hop), all_other[1].at_hop(hop)));
        EXPECT_TRUE(test::are_same(mixed[2].at_hop(hop), all_own[2].at_hop(hop)));
        EXPECT_FALSE(test::are_same(mixed[1].at_hop(hop), all_own[1].at_hop(hop)))
            << "bodies differ";
    }
}

TEST(GoingOn, allocates_nothing) {
    Ensemble before;
    Ensemble after;
    const auto own = one_figure_on(mannequin_skeleton());
    const auto other = one_figure_on(other_body());
    ASSERT_TRUE(before.prepare(members_of(Formation::unison, {{mannequin_skeleton(), own}}, 1)));
    ASSERT_TRUE(after.prepare(members_of(Formation::unison, {{other_body(), other}}, 1)));
    std::vector<PoseTrack> tracks(before.size());
    for (HopIndex hop = 0; hop < 300; ++hop) {
        before.advance(test::sure_state(hop, test::steady_grid(kGoingOnBpm)), tracks);
    }
    ::raks::test::RealtimeScope scope;
    after.go_on_from(before);
    after.advance(test::sure_state(300, test::steady_grid(kGoingOnBpm)), tracks);
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::motion
