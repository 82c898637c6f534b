// Salsa as it is shipped: four figures, never twice the same, never a jump, never a skating foot.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "base/statistics.hpp"
#include "motion/evaluate/dance_metrics.hpp"
#include "motion/figures/motion_features.hpp"
#include "tests/motion/dance/stage.hpp"
#include "tests/support/realtime_guard.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kSalsaTempo = 171.0;
constexpr HopIndex kMinute = 6000;

/// Poses and what was danced, hop by hop.
struct Danced {
    std::vector<Pose> poses;
    std::vector<DancerStatus> status;
};

Danced dance(std::uint64_t seed, HopIndex hops, const std::vector<DancerCommand>& commands = {}) {
    Dancer dancer;
    EXPECT_TRUE(dancer.prepare(test::salsa_library(), mannequin_skeleton(), seed));
    for (const DancerCommand& command : commands) {
        dancer.command(command);
    }
    const auto track = std::make_unique<PoseTrack>();
    Danced danced;
    for (HopIndex hop = 0; hop < hops; ++hop) {
        dancer.advance(test::sure_state(hop, test::steady_grid(kSalsaTempo)), *track);
        danced.poses.push_back(track->at_hop(hop));
        danced.status.push_back(dancer.status());
    }
    return danced;
}

/// Five minutes of seed 1; danced once.
const Danced& five_minutes() {
    static const Danced danced = dance(1, 5 * kMinute);
    return danced;
}

/// The figures begun, in order.
std::vector<std::string> figures_of(const Danced& danced) {
    std::vector<std::string> figures;
    std::uint32_t last = 0;
    for (const DancerStatus& status : danced.status) {
        if (status.is_dancing && (figures.empty() || status.number != last)) {
            figures.emplace_back(status.figure.data());
            last = status.number;
        }
    }
    return figures;
}

TEST(Salsa, goes_through_all_its_figures_and_begins_with_the_basic) {
    const auto figures = figures_of(five_minutes());
    EXPECT_EQ(figures.front(), "basic");
    ASSERT_GT(figures.size(), 95U) << "8 counts each";
    const std::set<std::string> soon(figures.begin(), figures.begin() + 60);
    EXPECT_EQ(soon.size(), 4U);
}

TEST(Salsa, the_same_seed_dances_the_same_and_another_seed_another_dance) {
    const Danced& first = five_minutes();
    const Danced again = dance(1, kMinute);
    const Danced other = dance(2, kMinute);
    double apart = 0.0;
    for (std::size_t i = 0; i < again.poses.size(); ++i) {
        ASSERT_EQ(first.poses[i].hips_position, again.poses[i].hips_position) << i;
        ASSERT_EQ(first.poses[i].local_rotations, again.poses[i].local_rotations) << i;
        apart = std::max(apart,
                         static_cast<double>(glm::distance(first.poses[i].hips_position,
                                                           other.poses[i].hips_position)));
    }
    EXPECT_GT(apart, 0.1);
}

/// Joints in the hips' own frame at 64 phases of a figure.
using Shape = std::vector<glm::dvec3>;

Shape shape_of(const Danced& danced, std::size_t first, std::size_t end) {
    const auto track = body_track(
        mannequin_skeleton(), std::span(danced.poses).subspan(first, end - first), 100.0);
    Shape shape;
    for (std::size_t phase = 0; phase < 64; ++phase) {
        const std::size_t i = phase * (end - first) / 64;
        const double heading = heading_of(glm::dquat(danced.poses[first + i].rotation(Bone::hips)));
        const glm::dquat back = glm::angleAxis(-heading, glm::dvec3(0, 1, 0));
        for (std::size_t joint = 1; joint < 18; ++joint) {
            const glm::dvec3 from_hips = track.joints[i][joint] - track.joints[i][0];
            shape.push_back(back * from_hips);
        }
    }
    return shape;
}

TEST(Salsa, two_repeats_differ_as_peoples_do) {
    // People: 11.6 cm rms over the joints for the basic; half to one and a half times that.
    const Danced danced =
        dance(3, 2 * kMinute, {{DancerCommand::Kind::lock_figure, StreamTime{}, 1.0}});
    std::vector<Shape> shapes;
    for (std::size_t i = 1, first = 0; i < danced.status.size(); ++i) {
        if (danced.status[i].number != danced.status[i - 1].number) {
            if (first > 0) {
                shapes.push_back(shape_of(danced, first, i));
            }
            first = i;
        }
    }
    ASSERT_GT(shapes.size(), 20U);
    std::vector<double> distances;
    for (std::size_t a = 0; a < shapes.size(); ++a) {
        for (std::size_t b = a + 1; b < shapes.size(); ++b) {
            double sum = 0.0;
            for (std::size_t i = 0; i < shapes[a].size(); ++i) {
                const glm::dvec3 apart = shapes[a][i] - shapes[b][i];
                sum += glm::dot(apart, apart);
            }
            distances.push_back(std::sqrt(sum / static_cast<double>(shapes[a].size())));
        }
    }
    EXPECT_GT(percentile(distances, 0.5), 0.5 * 0.116);
    EXPECT_LT(percentile(distances, 0.5), 1.5 * 0.116);
    EXPECT_GT(percentile(distances, 0.0), 0.005) << "no repeat is danced twice";
}

TEST(Salsa, feet_stand_and_nothing_jerks_joins_included) {
    const auto settled = std::span(five_minutes().poses).subspan(1000);
    const BodyTrack track = body_track(mannequin_skeleton(), resampled(settled, 100.0, 60.0), 60.0);
    const ContactReport contacts = contacts_of(track, 0.0);
    EXPECT_LE(contacts.slip_median, 0.015);
    EXPECT_LE(contacts.slip_p90, 0.027);
    EXPECT_GE(contacts.lowest_toe, -0.005);
    EXPECT_LE(contacts.toe_speed_mean, 0.13) << "people's";
    EXPECT_LE(jerk_of(track).highest, 3.0 * 1408.0) << "three times people's 99.9th percentile";
}

TEST(Salsa, stays_on_the_stage) {
    for (const Pose& pose : five_minutes().poses) {
        ASSERT_LT(std::hypot(pose.hips_position.x, pose.hips_position.z), 1.5F);
    }
}

TEST(Salsa, does_what_is_asked_at_the_end_of_the_figure) {
    const std::vector<DancerCommand> commands = {
        {DancerCommand::Kind::select_figure, stream_time_from_seconds(2.0), 2.0},
        {DancerCommand::Kind::lock_figure, stream_time_from_seconds(5.0), 1.0},
        {DancerCommand::Kind::lock_figure, stream_time_from_seconds(20.0), 0.0},
        {DancerCommand::Kind::next_figure, stream_time_from_seconds(20.0), 0.0}};
    const Danced danced = dance(6, 3000, commands);
    const auto at = [&](double seconds) {
        return std::string(danced.status[static_cast<std::size_t>(100.0 * seconds)].figure.data());
    };
    EXPECT_EQ(at(3.0), "basic");
    for (const double seconds : {10.0, 14.0, 18.0}) {
        EXPECT_EQ(at(seconds), "inplace_turn") << seconds;
    }
    EXPECT_NE(at(22.0), "inplace_turn");
}

TEST(Salsa, keeps_the_real_time_rules) {
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(test::salsa_library(), mannequin_skeleton(), 1));
    const auto track = std::make_unique<PoseTrack>();
    raks::test::RealtimeScope scope;
    for (HopIndex hop = 0; hop < kMinute; ++hop) {
        dancer.advance(test::sure_state(hop, test::steady_grid(kSalsaTempo)), *track);
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::motion
