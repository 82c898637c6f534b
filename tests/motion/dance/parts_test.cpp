#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <numeric>

#include "motion/dance/baking/foot_lock.hpp"
#include "motion/dance/baking/trajectory.hpp"
#include "motion/dance/beat_phase.hpp"
#include "motion/dance/body/hands.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/dance/inertialization.hpp"
#include "motion/dance/standing.hpp"
#include "motion/skeleton/body_capsules.hpp"
#include "tests/motion/dance/stage.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

PartModel one_feature(const std::vector<double>& means) {
    PartModel part;
    part.part = Part::upper;
    part.joints.resize(1);
    for (const double mean : means) {
        FigureState state;
        state.mean.assign(3, mean);
        state.variance.assign(3, 0.01);
        state.delta_mean.assign(3, 0.0);
        state.delta_variance.assign(3, 0.001);
        state.delta_delta_mean.assign(3, 0.0);
        state.delta_delta_variance.assign(3, 0.001);
        part.states.push_back(state);
    }
    part.global_variance.assign(3, 1.0);
    return part;
}

TEST(RotationBetween, turns_each_direction_to_its_opposite) {
    for (const glm::vec3& from : {glm::vec3(1, 0, 0),
                                  glm::vec3(-1, 0, 0),
                                  glm::vec3(0, 1, 0),
                                  glm::vec3(0, 0, -1),
                                  glm::normalize(glm::vec3(2, 1, -1))}) {
        EXPECT_LT(glm::distance(rotation_between(from, -from) * from, -from), 1e-5F)
            << from.x << " " << from.y << " " << from.z;
    }
}

TEST(Trajectory, equal_states_give_a_constant) {
    const FeatureTrack track = most_likely_trajectory(one_feature({0.7, 0.7, 0.7, 0.7}), 64);
    for (const double value : track.values) {
        EXPECT_NEAR(value, 0.7, 1e-9);
    }
}

TEST(Trajectory, is_smooth_over_the_seam_and_between_states) {
    const FeatureTrack track = most_likely_trajectory(one_feature({0.0, 1.0, 0.0, -1.0}), 96);
    for (std::size_t i = 0; i < track.rows(); ++i) {
        const double step = track.row((i + 1) % track.rows())[0] - track.row(i)[0];
        EXPECT_LT(std::abs(step), 0.35) << i;  // of a jump by 1 between states
    }
    EXPECT_GT(track.row(36)[0], 0.5);
    EXPECT_LT(track.row(84)[0], -0.5);
}

/// The same sum of squares solved as a dense system by Gauss-Seidel, on a short closed figure.
TEST(Trajectory, minimizes_the_weighted_squares) {
    const PartModel part = one_feature({0.3, -0.8});
    const std::size_t samples = 80;
    const FeatureTrack track = most_likely_trajectory(part, samples);
    const auto x = [&](std::ptrdiff_t i) {
        const auto n = static_cast<std::ptrdiff_t>(samples);
        return track.row(static_cast<std::size_t>(((i % n) + n) % n))[0];
    };
    for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(samples); ++i) {
        // The derivative of the sum by x(i) is zero: value, delta and delta-delta terms that hold
        // it.
        const double mean =
            part.states[part.state_at(static_cast<std::size_t>(i), samples)].mean[0];
        const double delta_before = (x(i) - x(i - 2)) / 2.0;
        const double delta_after = (x(i + 2) - x(i)) / 2.0;
        const auto bend = [&](std::ptrdiff_t k) { return x(k + 1) - 2.0 * x(k) + x(k - 1); };
        const double gradient = 6.0 * (x(i) - mean) / 0.01 +
                                (0.5 * delta_before - 0.5 * delta_after) / 0.001 +
                                (bend(i - 1) - 2.0 * bend(i) + bend(i + 1)) / 0.001;
        EXPECT_NEAR(gradient, 0.0, 1.0) << i;  // the seam is three figures away, not exactly closed
    }
}

TEST(Amplitude, that_averaging_took_comes_back_in_full_where_the_hips_travel) {
    PartModel part;
    part.part = Part::torso;
    part.states.resize(1);
    part.states[0].variance.assign(kRootFeatures, 0.36);
    part.global_variance.assign(kRootFeatures, 1.0);
    FeatureTrack track;
    track.columns = kRootFeatures;
    track.values.assign(2 * kRootFeatures, 1.0);
    std::fill_n(track.values.begin(), kRootFeatures, -1.0);
    const FeatureTrack mean = track;
    restore_variance(part, 0.0, track);
    for (std::size_t feature = 0; feature < kRootFeatures; ++feature) {
        const bool travels = feature == static_cast<std::size_t>(RootFeature::velocity_left) ||
                             feature == static_cast<std::size_t>(RootFeature::velocity_forward);
        EXPECT_NEAR(track.row(1)[feature], travels ? 1.25 : 1.0, 1e-12) << feature;
    }
    track = mean;
    restore_variance(part, 1.0, track);
    for (std::size_t feature = 0; feature < kRootFeatures; ++feature) {
        EXPECT_NEAR(track.row(1)[feature], 1.25, 1e-12) << feature;
    }
}

TEST(LegIk, reaches_the_target_and_keeps_bone_lengths) {
    const Skeleton& skeleton = mannequin_skeleton();
    for (const Side side : kSides) {
        const float sign = side == Side::left ? 1.0F : -1.0F;
        for (const glm::vec3 place : {glm::vec3(0.1F, 0.09F, 0.2F),
                                      glm::vec3(0.2F, 0.3F, -0.2F),
                                      glm::vec3(0.05F, 0.12F, 0.0F)}) {
            Pose pose;
            pose.hips_position = {0.0F, 0.86F, 0.0F};
            pose.rotation(Bone::hips) = glm::angleAxis(0.2F, glm::vec3(0, 1, 0));
            const FootTarget target{{sign * place.x, place.y, place.z}, kNoRotation};
            solve_leg(skeleton, side, target, pose);
            const WorldPose world = world_pose(skeleton, pose);
            const Bone foot = on_side(Bone::left_foot, side);
            EXPECT_LT(glm::length(world.position(foot) - target.ankle), 1e-3F);
            EXPECT_GT(std::abs(glm::dot(world.rotation(foot), target.rotation)), 0.9999F);
            // The knee bends forward.
            const Bone knee = on_side(Bone::left_lower_leg, side);
            const glm::vec3 middle =
                0.5F * (world.position(on_side(Bone::left_upper_leg, side)) + world.position(foot));
            const glm::vec3 ahead = pose.rotation(Bone::hips) * glm::vec3(0, 0, 1);
            EXPECT_GT(glm::dot(world.position(knee) - middle, ahead), 0.0F);
        }
    }
}

TEST(ContactWindows, close_short_gaps_and_drop_short_contacts) {
    std::array<double, kContactBins> chance{};  // 8 bins a beat
    const auto set = [&](std::size_t from, std::size_t to) {
        std::fill(chance.begin() + static_cast<std::ptrdiff_t>(from),
                  chance.begin() + static_cast<std::ptrdiff_t>(to),
                  1.0);
    };
    set(0, 8);
    set(9, 16);   // a gap of one bin
    set(40, 41);  // a flicker
    const auto windows = contact_windows(chance, 8, 64);
    ASSERT_EQ(windows.size(), 1U);
    EXPECT_NEAR(static_cast<double>(windows[0].first), 0.0, 1.0);
    EXPECT_NEAR(static_cast<double>(windows[0].length), 16.0, 2.0);
}

TEST(ContactWindows, a_foot_that_never_leaves_the_floor_stands_all_the_time) {
    std::array<double, kContactBins> chance{};
    chance.fill(1.0);
    const auto windows = contact_windows(chance, 4, 192);
    ASSERT_EQ(windows.size(), 1U);
    EXPECT_EQ(windows[0].first, 0U);
    EXPECT_EQ(windows[0].length, 192U);
}

/// People's landings with one foot in a figure of four beats: at each of these.
std::vector<LandingOffset> landings_at(std::initializer_list<double> beats) {
    std::vector<LandingOffset> landings(4);
    for (const double beat : beats) {
        const double count = std::floor(beat);
        landings[static_cast<std::size_t>(count)] = {25, Beats(beat - count), Beats(0.03)};
    }
    return landings;
}

TEST(ContactWindows, a_foot_that_steps_on_at_once_stands_as_long_as_it_can) {
    constexpr double kPerBeat = 48.0;
    const std::vector<ContactWindow> own = {{0, 48}, {144, 24}};  // beats 0 to 1, 3 to 3.5
    const auto windows = with_passing_steps(own, landings_at({0.02, 2.5, 3.0}), kPerBeat, 192);
    ASSERT_EQ(windows.size(), 3U);
    EXPECT_EQ(windows[0].first, own[0].first);
    EXPECT_EQ(windows[2].length, own[1].length);
    EXPECT_TRUE(windows[1].is_passing && windows[1].is_step);
    EXPECT_NEAR(static_cast<double>(windows[1].first) / kPerBeat, 2.5, 0.03);
    const auto end = static_cast<double>(windows[1].first + windows[1].length);
    EXPECT_GT(3.0 - end / kPerBeat, 0.37) << "it must reach the next place unhurried";
    EXPECT_LT(3.0 - end / kPerBeat, 0.42);
}

TEST(ContactWindows, a_foot_that_must_fly_on_sooner_or_has_landed_is_left_alone) {
    const std::vector<ContactWindow> own = {{0, 48}, {144, 24}};
    for (const double beat : {0.5, 2.7, 2.97}) {
        const auto windows = with_passing_steps(own, landings_at({beat}), 48.0, 192);
        EXPECT_EQ(windows.size(), own.size()) << "landing at beat " << beat;
    }
}

/// An arm that swings from the side to the front of the body, lower and lower: at 0 it is free.
Pose arm_along_body(float angle) {
    Pose pose;
    pose.hips_position.y = mannequin_skeleton().hips_height();
    pose.rotation(Bone::left_upper_arm) = glm::angleAxis(-angle, glm::vec3(0, 0, 1));
    pose.rotation(Bone::left_lower_arm) = glm::angleAxis(-0.5F, glm::vec3(0, 1, 0));
    return pose;
}

TEST(ClearHands, brings_a_hand_out_of_the_body_and_leaves_a_free_one_alone) {
    Pose free = arm_along_body(0.3F);
    const Pose before = free;
    clear_hands(mannequin_skeleton(), free);
    EXPECT_EQ(free.rotation(Bone::left_upper_arm), before.rotation(Bone::left_upper_arm));
    bool was_inside = false;
    for (float angle = 1.0F; angle < 1.75F; angle += 0.05F) {
        Pose pose = arm_along_body(angle);
        was_inside = was_inside || hand_clearance(mannequin_skeleton(), pose).metres < -0.02;
        clear_hands(mannequin_skeleton(), pose);
        EXPECT_GT(hand_clearance(mannequin_skeleton(), pose).metres, -0.005) << angle;
    }
    EXPECT_TRUE(was_inside);
}

TEST(ClearHands, moves_a_hand_smoothly_as_it_comes_near) {
    const auto wrist = [](float angle) {
        Pose pose = arm_along_body(angle);
        clear_hands(mannequin_skeleton(), pose);
        return world_pose(mannequin_skeleton(), pose).position(Bone::left_hand);
    };
    constexpr float kStep = 0.01F;  // radians: 5 mm of the hand by itself
    for (float angle = 0.3F; angle < 1.75F; angle += kStep) {
        EXPECT_LT(glm::distance(wrist(angle), wrist(angle + kStep)), 0.02F) << angle;
    }
}

/// An arm that hangs, bent towards the body, and swings back and forth through the trunk.
Pose arm_through_body(float swing) {
    Pose pose;
    pose.hips_position.y = mannequin_skeleton().hips_height();
    pose.rotation(Bone::left_upper_arm) =
        glm::angleAxis(swing, glm::vec3(1, 0, 0)) * glm::angleAxis(-1.6F, glm::vec3(0, 0, 1));
    pose.rotation(Bone::left_lower_arm) = glm::angleAxis(-0.5F, glm::vec3(0, 0, 1));
    return pose;
}

TEST(ClearHands, a_hand_that_passes_through_the_trunk_does_not_whip_round_it) {
    const Skeleton skeleton = mannequin_skeleton();
    const auto wrist = [&](float swing) {
        Pose pose = arm_through_body(swing);
        clear_hands(skeleton, pose);
        return world_pose(skeleton, pose).position(Bone::left_hand);
    };
    constexpr float kStep = 0.01F;  // radians: 5 mm of the hand by itself
    double deepest = 0.0;
    for (float swing = -1.0F; swing < 1.0F; swing += kStep) {
        EXPECT_LT(glm::distance(wrist(swing), wrist(swing + kStep)), 0.05F) << swing;
        deepest = std::min(deepest, hand_clearance(skeleton, arm_through_body(swing)).metres);
    }
    EXPECT_LT(deepest, -0.1) << "through its middle";
}

TEST(DancePhase, is_monotone_and_close_to_the_music_on_a_ramp) {
    DancePhase phase;
    BeatGrid grid = test::steady_grid(150.0);
    const DanceMetre metre{Bpm(166.0), 4};
    phase.start(grid, Beats(0.0), metre, StreamTime{});
    double last = -1.0;
    for (HopIndex hop = 1; hop < 3000; ++hop) {
        const StreamTime now = time_of_hop(hop);
        const Beats here = grid.beats_at(now);
        grid.anchor_time = now;
        grid.anchor_beat = here;
        grid.tempo = Bpm(150.0 * std::exp(0.02 * to_seconds(now) * (hop < 1500 ? 1.0 : 0.0)) +
                         (hop < 1500 ? 0.0 : 52.0));
        phase.advance(grid, metre, Beats(last + 4.0), now);
        ASSERT_GT(phase.phase().count(), last) << hop;
        last = phase.phase().count();
        ASSERT_NEAR(last, here.count(), 0.05) << hop;
    }
}

/// Dances for 20 s, and takes the bar when it is off. `bar_origin` says where the downbeat is at
/// each hop. Returns how often the bar was taken.
int bars_taken(DancePhase& phase,
               BeatGrid& grid,
               const DanceMetre& metre,
               const std::function<Beats(HopIndex)>& bar_origin) {
    int taken = 0;
    phase.start(grid, Beats(0.0), metre, StreamTime{});
    for (HopIndex hop = 1; hop < 2000; ++hop) {
        grid.bar_origin = bar_origin(hop);
        EXPECT_FALSE(phase.advance(grid, metre, Beats(1e9), time_of_hop(hop))) << hop;
        if (phase.beats_off_bar() != 0) {
            phase.take_bar();
            ++taken;
        }
    }
    return taken;
}

TEST(DancePhase, takes_count_1_to_a_downbeat_that_was_found_late) {
    for (const int late : {1, 2, 3}) {
        for (const double tempo : {70.0, 120.0}) {  // the slower one is danced at double pace
            DancePhase phase;
            BeatGrid grid = test::steady_grid(tempo);
            const int taken = bars_taken(phase, grid, {Bpm(140.0), 4}, [&](HopIndex hop) {
                return Beats(hop < 100 ? 0.0 : late);
            });
            EXPECT_EQ(taken, 1) << late;
            const double beats = phase.phase().count() / phase.octave();
            const double bars =
                (grid.beats_at(time_of_hop(1999)).count() - grid.bar_origin.count() - beats) / 4.0;
            EXPECT_NEAR(bars, std::round(bars), 0.02) << late << " " << tempo;
        }
    }
}

TEST(DancePhase, does_not_follow_a_bar_that_goes_to_and_fro_or_has_other_beats) {
    DancePhase phase;
    BeatGrid grid = test::steady_grid(120.0);
    const auto to_and_fro = [](HopIndex hop) { return Beats(hop / 300 % 2 == 0 ? 0.0 : 2.0); };
    EXPECT_EQ(bars_taken(phase, grid, {Bpm(120.0), 4}, to_and_fro), 0);
    const auto late = [](HopIndex) { return Beats(2.0); };
    EXPECT_EQ(bars_taken(phase, grid, {Bpm(120.0), 3}, late), 0);
}

TEST(Octave, keeps_what_it_has_until_it_does_not_fit) {
    const DanceMetre salsa{Bpm(166.0), 4};
    EXPECT_EQ(choose_octave(Bpm(83.0), salsa, 0.0), 2.0);
    EXPECT_EQ(choose_octave(Bpm(166.0), salsa, 0.0), 1.0);
    EXPECT_EQ(choose_octave(Bpm(110.0), salsa, 1.0), 1.0);
    EXPECT_EQ(choose_octave(Bpm(90.0), salsa, 1.0), 2.0);
    EXPECT_EQ(choose_octave(Bpm(180.0), {Bpm(90.0), 3}, 0.0), 1.0) << "a waltz keeps its three";
}

/// Music that gets faster or slower by 3 % a second until another octave suits: that begins where
/// no step leaves its beat.
TEST(Octave, changes_without_leaving_the_beat) {
    const DanceMetre metre{Bpm(170.0), 4};
    for (const auto& [from, faster] : {std::pair{100.0, 0.03}, std::pair{130.0, -0.03}}) {
        for (int beats_late = 0; beats_late < 8; ++beats_late) {  // when it happens: any
            DancePhase phase;
            BeatGrid grid;
            grid.tempo = Bpm(from);
            grid.anchor_beat = Beats(beats_late);
            phase.start(grid, Beats(0.0), metre, StreamTime{});
            const double first = phase.octave();
            HopIndex changed = 0;
            for (HopIndex hop = 1; hop < 3000; ++hop) {
                const StreamTime now = time_of_hop(hop);
                grid.anchor_beat = grid.beats_at(now);
                grid.anchor_time = now;
                grid.tempo = Bpm(from * std::exp(faster * to_seconds(now)));
                ASSERT_FALSE(phase.advance(grid, metre, Beats(1e9), now)) << "anchored anew";
                changed = changed == 0 && phase.octave() != first ? hop : changed;
                const bool is_slewing = changed != 0 && hop < changed + 50;
                const double beats = phase.phase().count() / phase.octave();
                const double off = (grid.anchor_beat.count() - beats) / grid.beats_per_bar;
                if (!is_slewing) {
                    ASSERT_NEAR(4.0 * phase.octave() * (off - std::round(off)), 0.0, 0.1) << hop;
                }
            }
            EXPECT_GT(changed, 0);
        }
    }
}

TEST(Idle, stands_with_both_feet_on_the_floor) {
    for (double t = 0.0; t < 20.0; t += 0.37) {
        const WorldPose world = world_pose(
            mannequin_skeleton(), idle_pose(mannequin_skeleton(), stream_time_from_seconds(t)));
        for (const Side side : kSides) {
            EXPECT_NEAR(foot_point(world, side, mannequin_skeleton().ball).y, 0.0F, 2e-3F) << t;
        }
    }
}

TEST(Inertialization, starts_where_it_was_and_ends_where_it_goes) {
    const Pose from = idle_pose(mannequin_skeleton(), StreamTime{});
    Pose to = from;
    to.rotation(Bone::head) = glm::angleAxis(0.8F, glm::vec3(0, 1, 0));
    Inertialization smoothing;
    smoothing.start(from, from, to, to);
    const auto turn = [&](double seconds) {
        const Pose pose = smoothing.apply(to, nanos_from_seconds(seconds));
        return std::abs(glm::dot(pose.rotation(Bone::head), to.rotation(Bone::head)));
    };
    const Pose first = smoothing.apply(to, Nanos(0));
    EXPECT_GT(std::abs(glm::dot(first.rotation(Bone::head), from.rotation(Bone::head))), 0.99999F);
    EXPECT_GT(turn(1.5), 0.9999F);
    EXPECT_LT(turn(0.1), turn(0.3));
}

TEST(Inertialization, does_not_spin_where_the_other_way_round_becomes_the_shorter) {
    const Pose to = idle_pose(mannequin_skeleton(), StreamTime{});
    Pose before = to;
    Pose from = to;
    before.rotation(Bone::head) = glm::angleAxis(3.15F, glm::vec3(0, 1, 0));
    from.rotation(Bone::head) = glm::angleAxis(3.13F, glm::vec3(0, 1, 0));
    Inertialization smoothing;
    smoothing.start(from, before, to, to);
    const Pose next = smoothing.apply(to, kHop);
    EXPECT_NEAR(glm::angle(next.rotation(Bone::head)), 3.11F, 0.03F);
}

}  // namespace
}  // namespace raks::motion
