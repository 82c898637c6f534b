// Several dancers to one music: a couple that holds hands, three in unison, in canon, free.
#include "motion/ensemble.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "base/statistics.hpp"
#include "motion/evaluate/couple_measures.hpp"
#include "motion/evaluate/dance_metrics.hpp"
#include "tests/motion/dance/stage.hpp"
#include "tests/support/realtime_guard.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kBpm = 171.0;

std::vector<EnsembleMember> salsa(Formation formation, std::size_t dancers = 0) {
    if (formation == Formation::couple) {
        return members_of(
            formation,
            {{mannequin_skeleton(), Repertoire::of_one(test::couple_library(DanceRole::lead))},
             {mannequin_skeleton(), Repertoire::of_one(test::couple_library(DanceRole::follow))}},
            3);
    }
    return members_of(formation,
                      {{mannequin_skeleton(), Repertoire::of_one(test::salsa_library())}},
                      3,
                      Dynamics::on,
                      dancers);
}

using Tracks = std::array<PoseTrack, Ensemble::kMost>;
/// Each dancer's pose at each hop.
using Danced = std::array<std::vector<Pose>, Ensemble::kMost>;

/// Two dancers in a formation.
Danced dance(Formation formation, HopIndex hops, bool is_locked = false) {
    Ensemble ensemble;
    EXPECT_TRUE(ensemble.prepare(salsa(formation, 2)));
    if (is_locked) {
        ensemble.command({DancerCommand::Kind::lock_figure, StreamTime{}, 1.0});
    }
    const auto tracks = std::make_unique<Tracks>();
    Danced poses;
    for (HopIndex hop = 0; hop < hops; ++hop) {
        ensemble.advance(test::sure_state(hop, test::steady_grid(kBpm)), *tracks);
        for (std::size_t i = 0; i < ensemble.size(); ++i) {
            poses[i].push_back((*tracks)[i].at_hop(hop));
        }
    }
    return poses;
}

/// A couple in all its figures for two minutes; danced once.
const Danced& couple_of_two_minutes() {
    static const Danced danced = dance(Formation::couple, 12000);
    return danced;
}

TEST(Ensemble, a_couple_holds_hands_in_the_basic_and_faces) {
    const auto poses = dance(Formation::couple, 4000, true);
    std::vector<double> hands;
    for (std::size_t hop = 600; hop < 4000; ++hop) {
        const WorldPose lead = world_pose(mannequin_skeleton(), poses[0][hop]);
        const WorldPose follow = world_pose(mannequin_skeleton(), poses[1][hop]);
        hands.push_back(static_cast<double>(
            glm::distance(lead.position(Bone::left_hand), follow.position(Bone::right_hand))));
        const glm::vec3 to_follow = follow.position(Bone::hips) - lead.position(Bone::hips);
        EXPECT_GT(glm::length(to_follow), 0.4F) << hop;
        EXPECT_LT(glm::length(to_follow), 1.1F) << hop;
        const glm::vec3 faces = lead.rotation(Bone::hips) * glm::vec3(0, 0, 1);
        EXPECT_GT(glm::dot(faces, glm::normalize(to_follow)), 0.5F) << hop;
    }
    EXPECT_LE(percentile(hands, 0.9), 0.25);
}

TEST(Ensemble, a_couple_stays_together_through_all_figures) {
    const Danced& poses = couple_of_two_minutes();
    std::vector<double> apart;
    for (std::size_t hop = 600; hop < 12000; ++hop) {
        apart.push_back(static_cast<double>(
            glm::distance(poses[0][hop].hips_position, poses[1][hop].hips_position)));
        ASSERT_LT(apart.back(), 1.4) << hop;
    }
    EXPECT_NEAR(percentile(apart, 0.5), 0.75, 0.15);
}

TEST(Ensemble, a_couple_passes_one_another_and_not_through) {
    const Danced& poses = couple_of_two_minutes();
    double closest = 1.0;
    double touching = 0.0;
    double looked_at = 0.0;
    for (std::size_t hop = 600; hop < 12000; hop += 3) {
        const double clearance = body_clearance(mannequin_skeleton(), poses[0][hop], poses[1][hop]);
        closest = std::min(closest, clearance);
        touching += clearance < 0.0 ? 1.0 : 0.0;
        looked_at += 1.0;
        ASSERT_GT(glm::distance(poses[0][hop].hips_position, poses[1][hop].hips_position), 0.33F)
            << "people's least is 0.29 m, their trunks turned aside";
    }
    EXPECT_GT(closest, -0.10) << "legs that step between one another, most after a hold";
    EXPECT_LT(touching / looked_at, 0.02);
}

/// Turn of the hips at each hop, as a figure's fingerprint that its ways do not change much.
bool are_alike(const Pose& a, const Pose& b) {
    const float dot = std::abs(glm::dot(a.rotation(Bone::hips), b.rotation(Bone::hips)));
    return dot > 0.9F;
}

double alike_share(const std::vector<Pose>& a, const std::vector<Pose>& b, std::size_t late) {
    double alike = 0.0;
    for (std::size_t hop = 3000; hop < a.size(); ++hop) {
        alike += are_alike(a[hop - late], b[hop]) ? 1.0 : 0.0;
    }
    return alike / static_cast<double>(a.size() - 3000);
}

TEST(Ensemble, unison_dances_the_same_figures_each_in_its_own_way) {
    const auto poses = dance(Formation::unison, 7000);
    EXPECT_GT(alike_share(poses[0], poses[1], 0), 0.97);
    double apart = 0.0;
    for (std::size_t hop = 3000; hop < 7000; ++hop) {
        const WorldPose a = world_pose(mannequin_skeleton(), poses[0][hop]);
        const WorldPose b = world_pose(mannequin_skeleton(), poses[1][hop]);
        apart = std::max(apart,
                         static_cast<double>(
                             std::abs((a.position(Bone::left_hand) - a.position(Bone::hips)).y -
                                      (b.position(Bone::left_hand) - b.position(Bone::hips)).y)));
    }
    EXPECT_GT(apart, 0.05) << "arms differ";
}

TEST(Ensemble, canon_comes_two_bars_later) {
    const auto poses = dance(Formation::canon, 7000);
    const auto two_bars = static_cast<std::size_t>(8.0 * 60.0 / kBpm * 100.0);
    EXPECT_GT(alike_share(poses[0], poses[1], two_bars), 0.95);
    EXPECT_LT(alike_share(poses[0], poses[1], 0), 0.8);
}

TEST(Ensemble, free_dancers_dance_other_figures) {
    const auto poses = dance(Formation::free, 7000);
    EXPECT_LT(alike_share(poses[0], poses[1], 0), 0.9);
}

TEST(Ensemble, a_crowd_keeps_apart_while_it_dances) {
    constexpr std::size_t kCrowd = 12;
    for (const Formation formation : {Formation::free, Formation::grid}) {
        Ensemble ensemble;
        ASSERT_TRUE(ensemble.prepare(salsa(formation, kCrowd)));
        ASSERT_EQ(ensemble.size(), kCrowd);
        ASSERT_EQ(ensemble.places().size(), kCrowd);
        std::vector<PoseTrack> tracks(kCrowd);
        float closest = 10.0F;
        for (HopIndex hop = 0; hop < 900; ++hop) {
            ensemble.advance(test::sure_state(hop, test::steady_grid(kBpm)), tracks);
            for (std::size_t i = 0; i < kCrowd; ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    closest = std::min(closest,
                                       glm::distance(tracks[i].at_hop(hop).hips_position,
                                                     tracks[j].at_hop(hop).hips_position));
                }
            }
        }
        EXPECT_GT(closest, 0.9F) << kFormationNames[static_cast<std::size_t>(formation)];
    }
}

TEST(Ensemble, refuses_nobody_too_many_and_half_a_couple) {
    Ensemble ensemble;
    EXPECT_FALSE(ensemble.prepare({}));
    const EnsembleMember one = salsa(Formation::solo).front();
    EXPECT_FALSE(ensemble.prepare(std::vector<EnsembleMember>(Ensemble::kMost + 1, one)));
    EXPECT_FALSE(ensemble.prepare(
        members_of(Formation::couple, {one.body, {mannequin_skeleton(), nullptr}}, 1)));
}

TEST(Ensemble, keeps_the_real_time_rules) {
    Ensemble ensemble;
    ASSERT_TRUE(ensemble.prepare(salsa(Formation::couple)));
    const auto tracks = std::make_unique<Tracks>();
    raks::test::RealtimeScope scope;
    for (HopIndex hop = 0; hop < 3000; ++hop) {
        ensemble.advance(test::sure_state(hop, test::steady_grid(kBpm)), *tracks);
    }
    ensemble.reset();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::motion
