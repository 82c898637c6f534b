// The figures that the dance must reach, on music whose beats are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "motion/dance/dance_content.hpp"
#include "motion/dance/figure_sequence.hpp"
#include "motion/evaluate/dance_metrics.hpp"
#include "motion/evaluate/landing_error.hpp"
#include "motion/figures/foot_events.hpp"
#include "motion/skeleton/body/retarget.hpp"
#include "tests/motion/dance/stage.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

using test::basic_step;
using test::dance_to;
using test::steady_music;

constexpr HopIndex kSettled = 800;  // hops: it has started and blended in
constexpr HopIndex kHops = 6000;

/// What the rules of contact and landing look at, of every hop.
std::vector<std::array<SourceFoot, 2>> feet_of(const std::vector<Pose>& poses) {
    const Skeleton& skeleton = mannequin_skeleton();
    std::vector<std::array<SourceFoot, 2>> feet;
    for (const Pose& pose : poses) {
        const WorldPose world = world_pose(skeleton, pose);
        std::array<SourceFoot, 2>& pair = feet.emplace_back();
        for (const Side side : kSides) {
            SourceFoot& foot = pair[static_cast<std::size_t>(side)];
            foot.ankle = glm::dvec3(world.position(on_side(Bone::left_foot, side)));
            foot.toe_tip = glm::dvec3(toe_tip(skeleton, world, side));
        }
    }
    return feet;
}

/// Landings from the first count 1 after the start and blend-in; the dance's count 1 may have
/// fallen on either downbeat of two bars: the one at which more of what is expected is danced.
LandingReport landings_at(double bpm) {
    const auto poses = dance_to(steady_music(bpm), kHops);
    const BodyTrack track = body_track(mannequin_skeleton(), poses, kHopsPerSecond);
    std::array<LandingReport, 2> reports;
    for (std::size_t start = 0; start < reports.size(); ++start) {
        std::vector<double> counts;
        for (std::size_t beat = 32 + 4 * start; counts.empty() || counts.back() < kHops / 100.0;
             ++beat) {
            counts.push_back(static_cast<double>(beat) * 60.0 / bpm);
        }
        reports[start] = landing_errors(track, basic_step(), counts);
    }
    return reports[0].missing <= reports[1].missing ? reports[0] : reports[1];
}

TEST(Landing, is_on_the_beat_on_steady_music) {
    for (const double bpm : {120.0, 150.0, 166.0, 184.0, 200.0}) {
        const LandingReport landing = landings_at(bpm);
        std::printf("%5.0f BPM: landing %+6.1f ms, sd %5.1f ms, n %zu, missing %zu\n",
                    bpm,
                    1e3 * landing.mean,
                    1e3 * landing.deviation,
                    landing.landings.size(),
                    landing.missing);
        EXPECT_GE(landing.landings.size(), 40U) << bpm;
        EXPECT_LE(std::abs(landing.mean), 0.015) << bpm;
        EXPECT_LE(landing.deviation, 0.025) << bpm;
        EXPECT_LE(landing.missing, 8U)
            << bpm << ": small steps are steps in a slow dance, too; a hold leaves out one";
    }
}

/// Distance that the toe travels in each contact, centimetres.
std::vector<double> slips_cm(const std::vector<Pose>& poses) {
    const auto feet = feet_of(poses);
    std::vector<double> slips;
    for (const Side side : kSides) {
        const std::vector<bool> contacts = toe_contacts(feet, side, kHopsPerSecond);
        const std::size_t s = static_cast<std::size_t>(side);
        for (std::size_t i = kSettled; i + 1 < contacts.size(); ++i) {
            if (!contacts[i] || contacts[i - 1]) {
                continue;
            }
            glm::dvec3 slip{};
            double length = 0.0;
            for (std::size_t k = i + 1; k < contacts.size() && contacts[k]; ++k) {
                slip = feet[k][s].toe_tip - feet[i][s].toe_tip;
                slip.y = 0.0;
                length = std::max(length, glm::length(slip));
            }
            slips.push_back(100.0 * length);
        }
    }
    std::sort(slips.begin(), slips.end());
    return slips;
}

TEST(Feet, do_not_skate) {
    const auto poses = dance_to(steady_music(166.0), kHops);
    const std::vector<double> slips = slips_cm(poses);
    ASSERT_GE(slips.size(), 40U);
    const double median = slips[slips.size() / 2];
    const double p90 = slips[slips.size() * 9 / 10];
    std::printf("slip of the toe a contact: median %.2f cm, p90 %.2f cm, n %zu\n",
                median,
                p90,
                slips.size());
    EXPECT_LE(median, 1.5);
    EXPECT_LE(p90, 3.3) << "the source's own p95";
}

TEST(Feet, never_go_5_mm_below_the_floor) {
    for (const double bpm : {100.0, 166.0, 220.0}) {
        double lowest = 1.0;
        for (const Pose& pose : dance_to(steady_music(bpm), 3000)) {
            const WorldPose world = world_pose(mannequin_skeleton(), pose);
            for (const Side side : kSides) {
                const Skeleton& skeleton = mannequin_skeleton();
                for (const glm::vec3& point : {foot_point(world, side, skeleton.ball),
                                               toe_tip(skeleton, world, side),
                                               foot_point(world, side, skeleton.heel)}) {
                    lowest = std::min(lowest, static_cast<double>(point.y));
                }
            }
        }
        EXPECT_GE(lowest, -0.005) << bpm;
    }
}

TEST(Feet, jerk_no_more_where_they_are_let_go_than_people) {
    // A second of the lead's basics (confidence >= 0.9): knees 235 and 245, ankles 387 and 392
    // m/s^3 rms at 60 frames a second; a third above them is allowed.
    const auto poses = dance_to(steady_music(166.0), kHops);
    const std::vector<Pose> dancing(poses.begin() + kSettled, poses.end());
    const BodyTrack track =
        body_track(mannequin_skeleton(), resampled(dancing, kHopsPerSecond, 60.0), 60.0);
    const std::array<std::pair<Bone, double>, 4> source = {{{Bone::left_lower_leg, 235.0},
                                                            {Bone::right_lower_leg, 245.0},
                                                            {Bone::left_foot, 387.0},
                                                            {Bone::right_foot, 392.0}}};
    for (const auto& [bone, rms] : source) {
        const auto found = std::find(kBodyBones.begin(), kBodyBones.end(), bone);
        BodyTrack one = track;
        for (auto& joints : one.joints) {
            joints.fill(joints[static_cast<std::size_t>(found - kBodyBones.begin())]);
        }
        const double jerk = jerk_of(one).rms;
        std::printf("jerk of bone %zu: %.0f m/s3, people %.0f\n", index_of(bone), jerk, rms);
        EXPECT_LE(jerk, 1.3 * rms) << index_of(bone);
    }
}

TEST(Feet, bend_their_toes_where_the_heel_is_up_over_a_planted_ball) {
    const Skeleton& skeleton = mannequin_skeleton();
    const auto poses = dance_to(steady_music(166.0), 3000);
    int raised = 0;
    for (std::size_t hop = kSettled; hop < poses.size(); ++hop) {
        const WorldPose world = world_pose(skeleton, poses[hop]);
        for (const Side side : kSides) {
            const float heel = foot_point(world, side, skeleton.heel).y;
            const float ball = foot_point(world, side, skeleton.ball).y;
            if (!poses[hop].foot_contact[static_cast<std::size_t>(side)] || heel - ball < 0.06F) {
                continue;
            }
            ++raised;
            const glm::vec3 tip = toe_tip(skeleton, world, side);
            ASSERT_LT(std::abs(tip.y - ball), 0.015F) << hop << ": the toes lie on the floor";
        }
    }
    EXPECT_GE(raised, 40);
}

TEST(Dance, does_not_leave_the_stage_or_turn_away) {
    const auto poses = dance_to(steady_music(180.0), 12'000);
    for (std::size_t hop = kSettled; hop < poses.size(); ++hop) {
        const glm::vec3& place = poses[hop].hips_position;
        ASSERT_LT(std::hypot(place.x, place.z), 0.6F) << hop;
        const glm::vec3 facing = poses[hop].rotation(Bone::hips) * glm::vec3(0, 0, 1);
        ASSERT_GT(facing.z, 0.3F) << hop;
    }
}

std::size_t index_of_figure(const DanceContent& content, std::string_view name) {
    const auto& figures = content.figures;
    const auto found = std::find_if(
        figures.begin(), figures.end(), [&](const auto& figure) { return figure.name == name; });
    EXPECT_NE(found, figures.end()) << name;
    return static_cast<std::size_t>(found - figures.begin());
}

/// Beats after the change from one figure to another at which the foot is seen to land, from half a
/// beat before it until the second beat.
std::vector<double> landings_at_change(const DanceContent& content,
                                       std::size_t from,
                                       std::size_t to,
                                       Side side,
                                       const DancerPart& part,
                                       double bpm) {
    const double beats_per_hop = bpm / 60.0 / kHopsPerSecond;
    FigureSequence sequence;
    FigureWish wish;
    wish.figure = from;
    sequence.start(content, part.is_in_couple ? content.couple : content.stage, part, false);
    double beat = 0.0;
    while (sequence.number() < 1) {
        sequence.advance(Beats(beat += beats_per_hop), 0.5, wish);
    }
    wish.figure = to;
    const double change = sequence.end().count();
    const double first = change - 1.0;
    std::vector<Pose> poses;
    for (beat = first; beat < change + 2.9; beat += beats_per_hop) {
        sequence.advance(Beats(beat), 0.5, wish);
        poses.push_back(sequence.at(Beats(beat)));
    }
    std::vector<double> seen;
    for (const double frame : landings(feet_of(poses), side, kHopsPerSecond)) {
        const double since = first + frame * beats_per_hop - change;
        if (since > -0.5 && since < 2.0) {
            seen.push_back(since);
        }
    }
    return seen;
}

TEST(Landing, a_foot_that_creeps_at_a_change_does_not_seem_to_have_landed) {
    const auto couple =
        make_content(test::salsa_figures(), mannequin_skeleton(), &test::couple_grammar());
    ASSERT_TRUE(couple) << couple.error().message;
    const std::size_t turn = index_of_figure(*couple, "travelling_turn");
    for (std::size_t from = 0; from < couple->figures.size(); ++from) {
        for (std::uint64_t ways = 1; ways <= 8; ++ways) {
            const DancerPart part{.seed = 1, .ways = ways, .is_in_couple = true};
            for (const double since :
                 landings_at_change(*couple, from, turn, Side::right, part, 126.0)) {
                // The last figure's own step may end at the change.
                EXPECT_TRUE(since < 0.2 || since > 0.8)
                    << since << ", people's: 1.2; " << couple->figures[from].name << " " << ways;
            }
        }
    }
}

TEST(Landing, a_step_that_is_under_way_after_a_change_comes_down_with_the_figure) {
    const auto belly = test::written_dance("belly");
    const std::size_t from = index_of_figure(belly, "shimmy_walk");
    const std::size_t to = index_of_figure(belly, "three_quarter_shimmy");
    for (std::uint64_t ways = 1; ways <= 8; ++ways) {
        // As learnt, not now and then left for right.
        const DancerPart part{.seed = 1, .ways = ways, .dynamics = Dynamics::off};
        const auto landings = landings_at_change(belly, from, to, Side::right, part, 92.0);
        ASSERT_FALSE(landings.empty()) << ways;
        EXPECT_GT(landings.front(), 0.9) << "written: 1.0; " << ways;
    }
}

TEST(Landing, a_foot_that_both_figures_step_with_goes_straight_to_where_it_lands) {
    const auto hiphop = test::written_dance("hiphop");
    const std::size_t to = index_of_figure(hiphop, "wop");
    int seen = 0;  // some steps are so small that they are none
    for (const std::string_view name : {"two_step", "bart_simpson"}) {
        const std::size_t from = index_of_figure(hiphop, name);
        for (std::uint64_t ways = 1; ways <= 8; ++ways) {
            // As learnt, not now and then left for right.
            const DancerPart part{.seed = 1, .ways = ways, .dynamics = Dynamics::off};
            const auto landings = landings_at_change(hiphop, from, to, Side::left, part, 82.0);
            if (!landings.empty()) {
                EXPECT_NEAR(landings.front(), 0.0, 0.06) << name << " " << ways;
                ++seen;
            }
        }
    }
    EXPECT_GE(seen, 12);
}

}  // namespace
}  // namespace raks::motion
