#include "motion/dancer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "motion/dance_library.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "tests/motion/dance/stage.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::motion {
namespace {

using test::are_same;
using test::basic_step;
using test::dance_to;
using test::largest_step;
using test::library_of;
using test::Music;
using test::steady_grid;
using test::steady_music;
using test::sure_state;

// No joint of a salsa dancer is faster than 10 m/s.

Music silence_between(double bpm, HopIndex from, HopIndex to) {
    return [=](HopIndex hop) {
        MusicState state = sure_state(hop, steady_grid(bpm));
        if (hop >= from && hop < to) {
            state.is_silent = true;
            state.grid.confidence = 0.0F;
        }
        return state;
    };
}

TEST(Dancer, starts_on_a_downbeat_and_counts_with_the_music) {
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(library_of(basic_step()), mannequin_skeleton(), 1));
    const auto track = std::make_unique<PoseTrack>();
    bool was_dancing = false;
    for (HopIndex hop = 0; hop < 2000; ++hop) {
        const MusicState state = sure_state(hop, steady_grid(180.0));
        dancer.advance(state, *track);
        const DancerStatus status = dancer.status();
        const double beat = state.grid.beats_at(state.time).count();
        if (status.is_dancing && !was_dancing) {
            EXPECT_LT(state.grid.bar_position(Beats(beat)), 0.6) << hop;
        }
        was_dancing = status.is_dancing;
        if (hop > 800) {
            ASSERT_TRUE(status.is_dancing);
            const double off = (beat - status.phase) / 4.0;  // count 1 or 5 is the downbeat
            ASSERT_NEAR(off, std::round(off), 0.01) << hop;
        }
    }
}

TEST(Dancer, the_same_music_gives_the_same_bits) {
    const auto a = dance_to(silence_between(176.0, 900, 1400), 2500);
    const auto b = dance_to(silence_between(176.0, 900, 1400), 2500);
    for (std::size_t hop = 0; hop < a.size(); ++hop) {
        ASSERT_TRUE(are_same(a[hop], b[hop])) << hop;
    }
}

TEST(Dancer, reset_is_just_prepared) {
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(library_of(basic_step()), mannequin_skeleton(), 1));
    const auto track = std::make_unique<PoseTrack>();
    std::vector<Pose> first;
    for (int round = 0; round < 2; ++round) {
        track->clear();
        for (HopIndex hop = 0; hop < 700; ++hop) {
            dancer.advance(sure_state(hop, steady_grid(150.0)), *track);
            if (round == 0) {
                first.push_back(track->at_hop(hop));
            } else {
                ASSERT_TRUE(are_same(track->at_hop(hop), first[static_cast<std::size_t>(hop)]));
            }
        }
        dancer.reset();
    }
}

TEST(Dancer, settles_in_silence_and_breathes) {
    const auto poses = dance_to(silence_between(180.0, 1000, 4000), 4000);
    // Settled: hands below the hips' height plus a little, feet beside each other, never frozen.
    const WorldPose world = world_pose(mannequin_skeleton(), poses[2500]);
    EXPECT_LT(world.position(Bone::left_hand).y, 1.0F);
    EXPECT_LT(std::abs(world.position(Bone::left_foot).z - world.position(Bone::right_foot).z),
              0.05F);
    EXPECT_FALSE(are_same(poses[2500], poses[2600]));
    EXPECT_LT(largest_step(poses, 1600, 4000), 0.015) << "calm, though it shakes out its hands";
}

TEST(Dancer, never_jumps_also_when_the_music_does) {
    const Music rude = [](HopIndex hop) {
        BeatGrid grid = steady_grid(hop < 1500 ? 150.0 : 190.0);
        if (hop >= 2200) {
            grid.anchor_beat = Beats(2.6);  // the tracker was wrong and sets the beat anew
        }
        MusicState state = sure_state(hop, grid);
        if (hop >= 3000 && hop < 3500) {
            state.is_silent = true;
        }
        return state;
    };
    const auto poses = dance_to(rude, 5000);
    EXPECT_LT(largest_step(poses, 0, 5000), test::kFastestStep);
}

TEST(Dancer, predicted_poses_become_the_final_ones_on_steady_music) {
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(library_of(basic_step()), mannequin_skeleton(), 1));
    const auto track = std::make_unique<PoseTrack>();
    Pose predicted;
    for (HopIndex hop = 0; hop < 1500; ++hop) {
        dancer.advance(sure_state(hop, steady_grid(180.0)), *track);
        if (hop == 1400) {
            predicted = track->at_hop(1420);
        }
        if (hop == 1420) {
            for (std::size_t i = 0; i < predicted.local_rotations.size(); ++i) {
                ASSERT_GT(std::abs(glm::dot(predicted.local_rotations[i],
                                            track->at_hop(hop).local_rotations[i])),
                          0.99999F);
            }
        }
    }
}

TEST(Dancer, dances_at_the_octave_of_its_learnt_tempo) {
    const std::pair<double, double> cases[] = {
        {60.0, 2.0}, {95.0, 2.0}, {150.0, 1.0}, {200.0, 1.0}, {225.0, 1.0}};
    for (const auto& [bpm, octave] : cases) {
        Dancer dancer;
        ASSERT_TRUE(dancer.prepare(library_of(basic_step()), mannequin_skeleton(), 1));
        const auto track = std::make_unique<PoseTrack>();
        for (HopIndex hop = 0; hop < 1500; ++hop) {
            dancer.advance(sure_state(hop, steady_grid(bpm)), *track);
        }
        EXPECT_EQ(dancer.status().octave, octave) << bpm;
    }
}

TEST(Dancer, another_figure_begins_on_its_count_1_without_a_jump) {
    auto follow =
        load_figure(std::string(RAKS_SOURCE_DIR) + "/models/trained/salsa_basic_follow.json");
    ASSERT_TRUE(follow) << follow.error().message;
    const std::array<FigureModel, 2> figures = {basic_step(), *follow};
    auto library = DanceLibrary::build(figures, mannequin_skeleton());
    ASSERT_TRUE(library);
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(*library, mannequin_skeleton(), 1));
    const auto track = std::make_unique<PoseTrack>();
    dancer.command({DancerCommand::Kind::next_figure, stream_time_from_seconds(8.33), 0.0});
    dancer.command({DancerCommand::Kind::select_figure, stream_time_from_seconds(14.1), 0.0});
    dancer.command(
        {DancerCommand::Kind::select_figure, stream_time_from_seconds(14.2), std::nan("")});
    std::vector<Pose> poses;
    for (HopIndex hop = 0; hop < 2200; ++hop) {
        dancer.advance(sure_state(hop, steady_grid(166.0)), *track);
        poses.push_back(track->at_hop(hop));
    }
    EXPECT_LT(largest_step(poses, 0, 2200), test::kFastestStep);
}

TEST(Dancer, is_on_the_beat_again_after_a_change_of_octave) {
    for (const double slow : {88.0, 70.0}) {
        Dancer dancer;
        ASSERT_TRUE(dancer.prepare(library_of(basic_step()), mannequin_skeleton(), 1));
        const auto track = std::make_unique<PoseTrack>();
        BeatGrid grid = steady_grid(120.0);
        for (HopIndex hop = 0; hop < 4000; ++hop) {
            if (hop == 1337) {
                grid.anchor_beat = grid.beats_at(time_of_hop(hop));
                grid.anchor_time = time_of_hop(hop);
                grid.tempo = Bpm(slow);
            }
            dancer.advance(sure_state(hop, grid), *track);
        }
        const DancerStatus status = dancer.status();
        EXPECT_EQ(status.octave, 2.0);
        const double bar = grid.bar_position(grid.beats_at(time_of_hop(3999)));
        const double off = (status.phase - 2.0 * bar) / 8.0;
        EXPECT_NEAR(off, std::round(off), 0.01) << slow << ": count 1 is on the downbeat";
    }
}

TEST(Dancer, holds_and_goes_on_by_command) {
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(library_of(basic_step()), mannequin_skeleton(), 1));
    const auto track = std::make_unique<PoseTrack>();
    dancer.command({DancerCommand::Kind::hold, stream_time_from_seconds(10.0), 0.0});
    dancer.command({DancerCommand::Kind::release, stream_time_from_seconds(15.0), 0.0});
    for (HopIndex hop = 0; hop < 2000; ++hop) {
        dancer.advance(sure_state(hop, steady_grid(170.0)), *track);
        if (hop == 990) {
            EXPECT_TRUE(dancer.status().is_dancing);
        } else if (hop == 1010 || hop == 1490) {
            EXPECT_FALSE(dancer.status().is_dancing) << hop;
        }
    }
    EXPECT_TRUE(dancer.status().is_dancing);
}

TEST(Dancer, keeps_the_real_time_rules_for_60_seconds) {
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(library_of(basic_step()), mannequin_skeleton(), 1));
    const auto track = std::make_unique<PoseTrack>();
    raks::test::RealtimeScope scope;
    for (HopIndex hop = 0; hop < 6000; ++hop) {
        MusicState state = sure_state(hop, steady_grid(hop < 2000 ? 150.0 : 190.0));
        state.is_silent = hop > 3000 && hop < 3700;
        dancer.advance(state, *track);
        if (hop == 4000) {
            dancer.command({DancerCommand::Kind::next_figure, StreamTime{}, 0.0});
        }
    }
    dancer.reset();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

/// Largest change of any rotation of these bones, radians, at each beat of the figure.
std::array<double, 8> change_by_beat(const FigureModel& changed, Bone first, Bone last) {
    const auto a = dance_to(steady_music(150.0), 3000);  // 40 hops a beat, 320 a figure
    const auto b = dance_to(steady_music(150.0), 3000, changed);
    std::array<double, 8> largest{};
    for (std::size_t hop = 1600; hop < 1600 + 320; ++hop) {
        for (std::size_t bone = index_of(first); bone <= index_of(last); ++bone) {
            const double dot = std::min(
                1.0F,
                std::abs(glm::dot(a[hop].local_rotations[bone], b[hop].local_rotations[bone])));
            double& at = largest[(hop % 320) / 40];
            at = std::max(at, 2.0 * std::acos(dot));
        }
    }
    return largest;
}

TEST(Dancer, poses_come_from_the_model_one_state_moves_its_own_slice) {
    // Through the file's text, as a person would change it: state 5 of 16 is beats 2.5 to 3.
    const std::string text = figure_text(basic_step());
    auto changed = parse_figure(text, "changed.json");
    ASSERT_TRUE(changed);
    PartModel& torso = changed->parts[static_cast<std::size_t>(Part::torso)];
    for (std::size_t feature = kRootFeatures; feature < torso.dimension(); ++feature) {
        torso.states[5].mean[feature] += 0.3;
    }
    const auto by_beat = change_by_beat(*changed, Bone::spine, Bone::neck);
    // Count 1 of the figure fell on beat 4 of the music: beats 2.5 to 3 are the music's 6.5 to 7.
    // The most likely trajectory carries a change on as far as the deltas hold it: two beats.
    const double peak = *std::max_element(by_beat.begin(), by_beat.end());
    EXPECT_GT(peak, 0.1);
    EXPECT_GT(by_beat[6], 0.8 * peak);
    for (const std::size_t beat : {1U, 2U, 3U}) {
        EXPECT_LT(by_beat[beat], 0.05 * peak) << beat;
    }
}

}  // namespace
}  // namespace raks::motion
