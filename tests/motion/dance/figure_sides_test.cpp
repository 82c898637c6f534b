// Figures that are danced left for right.
#include "motion/dance/figure_sides.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "motion/dance/dance_content.hpp"
#include "motion/dance/figure_sequence.hpp"
#include "tests/motion/dance/stage.hpp"

#include <glm/geometric.hpp>

namespace raks::motion::figure_sides_test {
namespace {

const DanceContent& hiphop() {
    static const DanceContent content = test::written_dance("hiphop");
    return content;
}

std::size_t figure_of(const std::string& name) {
    const auto& figures = hiphop().figures;
    const auto found = std::find_if(
        figures.begin(), figures.end(), [&](const auto& one) { return one.name == name; });
    EXPECT_NE(found, figures.end()) << name;
    return static_cast<std::size_t>(found - figures.begin());
}

double farthest_joint(const Pose& a, const Pose& b) { return test::largest_step({a, b}, 0, 2); }

TEST(FigureSides, tell_with_which_foot_a_figure_begins) {
    const auto leads = [](const std::string& name) {
        return hiphop().figures[figure_of(name)].sides.leads;
    };
    EXPECT_EQ(leads("two_step"), Side::left);
    EXPECT_EQ(leads("bounce_rock"), Side::left);
    EXPECT_EQ(leads("running_man"), Side::right);
}

TEST(FigureSides, a_mirrored_figure_begins_in_the_stance_of_all) {
    const Skeleton& skeleton = hiphop().skeleton;
    const auto middle_of_feet = [&](std::size_t figure, bool is_mirrored) {
        FigureChoice choice;
        choice.figure = figure;
        choice.is_mirrored = is_mirrored;
        const LibraryFigure& own = hiphop().figures[figure];
        const FloorMove& place = is_mirrored ? own.sides.mirrored_place : own.place;
        const Pose pose = place(pose_of(hiphop(), choice, -FigurePassage::kMargin));
        const WorldPose world = world_pose(skeleton, pose);
        const glm::vec3 middle = 0.5F * (foot_point(world, Side::left, skeleton.ball) +
                                         foot_point(world, Side::right, skeleton.ball));
        return glm::vec2(middle.x, middle.z);
    };
    const glm::vec2 stance = middle_of_feet(0, false);
    for (std::size_t figure = 0; figure < hiphop().figures.size(); ++figure) {
        EXPECT_LT(glm::distance(middle_of_feet(figure, true), stance), 1e-3F) << figure;
    }
}

TEST(FigureSides, a_mirrored_figure_is_the_mirror_image_also_before_its_beginning) {
    for (std::size_t figure = 0; figure < hiphop().figures.size(); ++figure) {
        FigureChoice choice;
        choice.figure = figure;
        FigureChoice other = choice;
        other.is_mirrored = true;
        for (const double beat : {-1.4, -0.3, 1.7}) {
            const Pose pose = pose_of(hiphop(), choice, beat);
            EXPECT_LT(farthest_joint(mirrored(pose), pose_of(hiphop(), other, beat)), 1e-5);
        }
        // It goes on before its beginning as it ends, without a leap.
        const double edge = -FigurePassage::kMargin;
        EXPECT_LT(farthest_joint(pose_of(hiphop(), choice, edge - 1e-4),
                                 pose_of(hiphop(), choice, edge + 1e-4)),
                  2e-3)
            << figure;
    }
}

/// A dance of 120 bars at its own tempo, a pose a hop, and which of its figures were mirrored.
struct Danced {
    std::vector<Pose> poses;
    std::vector<bool> mirrored;                      // by figure danced
    std::set<std::pair<std::string, bool>> figures;  // name, side
};

Danced dance(const DancerPart& part) {
    FigureSequence sequence;
    sequence.start(hiphop(), hiphop().stage, part, false);
    sequence.set_tempo(hiphop().metre.learnt_tempo);
    const double rate = hiphop().metre.learnt_tempo.beats_per_second();
    Danced danced;
    std::uint64_t number = ~0ULL;
    FigureWish wish;
    for (int hop = 0; hop * 0.01 * rate < 480.0; ++hop) {
        const Beats phase(hop * 0.01 * rate);
        sequence.advance(phase, 0.5 + 0.4 * std::sin(0.05 * phase.count()), wish);
        danced.poses.push_back(sequence.at(phase));
        if (sequence.number() != number) {
            number = sequence.number();
            danced.mirrored.push_back(sequence.is_mirrored());
            danced.figures.insert({sequence.figure().name, sequence.is_mirrored()});
        }
    }
    return danced;
}

TEST(FigureSides, both_sides_are_danced_and_joined_without_a_leap_or_a_sliding_foot) {
    DancerPart part;
    part.seed = 3;
    const Danced danced = dance(part);
    EXPECT_EQ(danced.figures.size(), 2 * hiphop().figures.size()) << "each on both sides";
    const auto hops = static_cast<HopIndex>(danced.poses.size());
    EXPECT_LT(test::largest_step(danced.poses, 0, hops), test::kFastestStep);
    // A foot that stands from one hop to the next moves slowly; so do the joins of one side.
    int fast = 0;
    int stood = 0;
    for (std::size_t hop = 1; hop < danced.poses.size(); ++hop) {
        const WorldPose now = world_pose(hiphop().skeleton, danced.poses[hop]);
        const WorldPose before = world_pose(hiphop().skeleton, danced.poses[hop - 1]);
        for (const Side side : kSides) {
            const auto s = static_cast<std::size_t>(side);
            if (danced.poses[hop].foot_contact[s] && danced.poses[hop - 1].foot_contact[s]) {
                const glm::vec3 a = foot_point(now, side, hiphop().skeleton.ball);
                const glm::vec3 b = foot_point(before, side, hiphop().skeleton.ball);
                ++stood;
                fast += glm::distance(glm::vec2(a.x, a.z), glm::vec2(b.x, b.z)) > 0.004F ? 1 : 0;
            }
        }
    }
    EXPECT_LT(fast, 0.02 * stood) << "more than 0.4 m/s";
}

TEST(FigureSides, to_calm_music_some_figures_are_danced_at_half_the_tempo) {
    for (const double energy : {0.1, 0.8}) {
        FigureSequence sequence;
        sequence.start(hiphop(), hiphop().stage, DancerPart(), false);
        const double rate = hiphop().metre.learnt_tempo.beats_per_second();
        std::vector<Pose> poses;
        std::set<double> stretches;
        FigureWish wish;
        for (int hop = 0; hop * 0.01 * rate < 160.0; ++hop) {
            const Beats phase(hop * 0.01 * rate);
            sequence.advance(phase, energy, wish);
            poses.push_back(sequence.at(phase));
            stretches.insert(sequence.stretch());
            const double beats = (sequence.end() - phase).count() / sequence.stretch();
            EXPECT_NEAR(sequence.figure().beats - beats, sequence.beat(phase), 1e-6);
        }
        EXPECT_EQ(stretches.count(2.0), energy < 0.5 ? 1U : 0U) << energy;
        EXPECT_LT(test::largest_step(poses, 0, static_cast<HopIndex>(poses.size())),
                  test::kFastestStep);
    }
}

TEST(FigureSides, without_dynamics_and_in_a_couple_figures_stay_as_learnt) {
    DancerPart off;
    off.dynamics = Dynamics::off;
    DancerPart couple;
    couple.is_in_couple = true;
    for (const DancerPart& part : {off, couple}) {
        const Danced danced = dance(part);
        EXPECT_EQ(std::count(danced.mirrored.begin(), danced.mirrored.end(), true), 0);
    }
}

}  // namespace
}  // namespace raks::motion::figure_sides_test
