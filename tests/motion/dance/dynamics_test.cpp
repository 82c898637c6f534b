#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "motion/dance_library.hpp"
#include "motion/dancer.hpp"
#include "motion/repertoire.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "tests/motion/dance/stage.hpp"
#include "tests/support/realtime_guard.hpp"

#include <glm/geometric.hpp>

/// What a dancer does with what the music does: stops, endings, phrases.
namespace raks::motion::dynamics_test {
namespace {

using Kind = MusicEvent::Kind;
constexpr double kBpm = 180.0;  // a bar lasts 1.333 s

MusicState playing(HopIndex hop) {
    MusicState music = test::sure_state(hop, test::steady_grid(kBpm));
    music.part = MusicPart::playing;
    return music;
}

// Silent from one hop to another; the stop is heard 100 ms late, as a stream's analysis does.
MusicState stopping(HopIndex hop, HopIndex from, HopIndex to) {
    MusicState music = playing(hop);
    if (hop >= from && hop < to) {
        music.is_silent = true;
        music.energy.now = 0.0F;
    }
    if (hop >= from + 10 && hop < to) {
        music.part = MusicPart::stopped;
    }
    if (hop == from + 10) {
        music.event = {Kind::stop, time_of_hop(from)};
    }
    if (hop == to) {
        music.event = {Kind::entry, time_of_hop(to)};
    }
    return music;
}

std::vector<Pose> dance(const test::Music& music, HopIndex hops, Dynamics dynamics = Dynamics::on) {
    Dancer dancer;
    DancerPart part;
    part.dynamics = dynamics;
    EXPECT_TRUE(
        dancer.prepare(Repertoire::of_one(test::salsa_library()), mannequin_skeleton(), part));
    const auto track = std::make_unique<PoseTrack>();
    std::vector<Pose> poses;
    for (HopIndex hop = 0; hop < hops; ++hop) {
        dancer.advance(music(hop), *track);
        poses.push_back(track->at_hop(hop));
    }
    return poses;
}

// Mean speed of hands, feet and head, metres a second.
double speed(const std::vector<Pose>& poses, std::size_t from, std::size_t to) {
    double way = 0.0;
    for (std::size_t hop = from + 1; hop <= to; ++hop) {
        const WorldPose a = world_pose(mannequin_skeleton(), poses[hop - 1]);
        const WorldPose b = world_pose(mannequin_skeleton(), poses[hop]);
        for (const Bone bone :
             {Bone::left_hand, Bone::right_hand, Bone::left_foot, Bone::right_foot, Bone::head}) {
            way += static_cast<double>(glm::distance(a.position(bone), b.position(bone))) / 5.0;
        }
    }
    return 100.0 * way / static_cast<double>(to - from);
}

TEST(Dynamics, a_dancer_stops_with_the_music_and_goes_on_with_it) {
    const auto poses = dance([](HopIndex hop) { return stopping(hop, 2000, 2200); }, 3000);
    const double full = speed(poses, 1000, 1990);
    EXPECT_LT(speed(poses, 2050, 2200), 0.25 * full);
    EXPECT_GT(speed(poses, 2050, 2200), 0.0) << "breathes";
    EXPECT_GT(speed(poses, 2210, 2340), 0.7 * full);
    EXPECT_LT(test::largest_step(poses, 0, 3000), test::kFastestStep);
}

// Pauses come where the draw for a phrase says so, so that stops at all beats of many phrases meet
// some.
TEST(Dynamics, a_stop_that_comes_in_a_pause_is_stood_out) {
    for (HopIndex from = 2000; from < 2400; from += 40) {
        const auto poses =
            dance([&](HopIndex hop) { return stopping(hop, from, from + 200); }, from + 200);
        const auto stop = static_cast<std::size_t>(from);
        EXPECT_LT(speed(poses, stop + 60, stop + 199), 0.25 * speed(poses, 1000, 1990)) << from;
    }
}

TEST(Dynamics, a_long_stop_is_waited_out_standing) {
    const auto poses = dance([](HopIndex hop) { return stopping(hop, 2000, 3500); }, 4500);
    const double full = speed(poses, 1000, 1990);
    EXPECT_LT(speed(poses, 2700, 3400), 0.25 * full);
    EXPECT_GT(speed(poses, 3800, 4400), 0.7 * full);
    EXPECT_LT(test::largest_step(poses, 0, 4500), 1.2 * test::kFastestStep);
}

TEST(Dynamics, a_stop_that_is_known_is_stood_when_it_comes) {
    const auto poses = dance(
        [](HopIndex hop) {
            MusicState music = stopping(hop, 2000, 2200);
            music.ahead.is_known = true;
            music.ahead.ends = stream_time_from_seconds(60.0);
            if (hop < 2000) {
                music.ahead.events[0] = {Kind::stop, time_of_hop(2000)};
            }
            return music;
        },
        3000);
    const double full = speed(poses, 1000, 1900);
    EXPECT_LT(speed(poses, 2015, 2200), 0.25 * full);
    EXPECT_GT(speed(poses, 2210, 2340), 0.7 * full);
}

// A known song whose last beat is at a hop; silence after it.
test::Music ending(HopIndex last) {
    return [last](HopIndex hop) {
        MusicState music = playing(hop);
        music.ahead.is_known = true;
        music.ahead.ends = time_of_hop(last);
        if (hop > last + 10) {
            music.is_silent = true;
            music.part = MusicPart::stopped;
        }
        return music;
    };
}

// Files may stop there, so that nothing after it is seen.
TEST(Dynamics, the_last_posture_of_a_known_song_stands_on_its_last_beat) {
    for (const HopIndex last : {1967, 2000, 2033, 2067, 2100, 2133}) {
        const auto poses = dance(ending(last), last + 150);
        const auto end = static_cast<std::size_t>(last);
        const double full = speed(poses, 1000, 1900);
        EXPECT_GT(speed(poses, end - 60, end - 40), 0.4 * full) << "danced until shortly before";
        EXPECT_LT(speed(poses, end, end + 3), 0.2 * full) << last;
        EXPECT_LT(speed(poses, end, end + 140), 0.1 * full) << "holds the last chord";
        EXPECT_LT(test::largest_step(poses, 0, last + 150), test::kFastestStep);
    }
}

TEST(Dynamics, the_end_of_a_known_song_is_a_posture_then_thanks_then_life) {
    const auto poses = dance(ending(2000), 9000);
    const double full = speed(poses, 1000, 1900);
    // Settles after 1.8 s, and thanks the audience from 0.6 s later on.
    EXPECT_GT(speed(poses, 2250, 2400), 0.1 * full);
    for (std::size_t from = 2200; from + 200 < 9000; from += 100) {
        EXPECT_GT(speed(poses, from, from + 200), 0.015) << "is not still for 2 s: " << from;
    }
    EXPECT_LT(test::largest_step(poses, 0, 9000), test::kFastestStep);
}

// A song in its midst, its first bar line long ago or, of a clip that was cut out, soon.
test::Music in_midst(int bars, HopIndex begins) {
    return [bars, begins](HopIndex hop) {
        MusicState music = playing(hop);
        const double beats = music.grid.beats_at(music.time).count();
        music.ahead.is_known = true;
        music.ahead.begins =
            begins > 0 ? time_of_hop(begins) : StreamTime(std::chrono::seconds(-60));
        music.ahead.ends = stream_time_from_seconds(60.0);
        music.ahead.bar = begins > hop ? -1 : bars + static_cast<int>(std::floor(beats / 4.0));
        return music;
    };
}

TEST(Dynamics, a_known_song_in_its_midst_is_danced_from_the_first_pose) {
    const double full = speed(dance(in_midst(0, 0), 3000), 1000, 2900);
    for (const int bars : {0, 1, 2, 7, 40}) {
        const auto poses = dance(in_midst(bars, 0), 600);
        EXPECT_GT(speed(poses, 0, 60), 0.4 * full) << bars;
        EXPECT_GT(speed(poses, 0, 200), 0.6 * full) << bars;
        EXPECT_LT(test::largest_step(poses, 0, 600), test::kFastestStep) << bars;
    }
    const auto cut = dance(in_midst(0, 90), 600);
    EXPECT_GT(speed(cut, 0, 80), 0.4 * full) << "the beginning of the first bar is cut off";
}

TEST(Dynamics, count_1_is_on_the_downbeat_of_a_song_in_its_midst) {
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(
        Repertoire::of_one(test::salsa_library()), mannequin_skeleton(), DancerPart{}));
    const auto track = std::make_unique<PoseTrack>();
    raks::test::RealtimeScope scope;
    for (HopIndex hop = 0; hop < 800; ++hop) {
        const MusicState music = in_midst(5, 0)(hop);
        dancer.advance(music, *track);
        const double off =
            music.grid.bar_position(music.grid.beats_at(music.time)) - dancer.status().phase;
        ASSERT_TRUE(dancer.status().is_dancing);
        ASSERT_NEAR(std::remainder(off, 4.0), 0.0, 0.1) << hop;
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

TEST(Dynamics, calm_music_is_danced_smaller) {
    const auto with = [](float energy) {
        return [energy](HopIndex hop) {
            MusicState music = playing(hop);
            music.energy = {energy, energy, energy};
            return music;
        };
    };
    const double usual = speed(dance(with(0.6F), 3000), 1000, 2900);
    EXPECT_LT(speed(dance(with(0.05F), 3000), 1000, 2900), 0.75 * usual);
}

TEST(Dynamics, a_breakdown_is_danced_through_though_its_beat_is_hardly_heard) {
    const auto poses = dance(
        [](HopIndex hop) {
            MusicState music = playing(hop);
            if (hop >= 1500 && hop < 2500) {
                music.part = MusicPart::breakdown;
                music.grid.confidence = 0.05F;
            }
            return music;
        },
        2500);
    EXPECT_GT(speed(poses, 2000, 2490), 0.3 * speed(poses, 500, 1400));
}

TEST(Dynamics, switched_off_nothing_but_the_beat_is_followed) {
    const auto changing = [](HopIndex hop) {
        MusicState music = stopping(hop, 2000, 2100);
        music.energy.now = hop % 700 < 350 ? 0.0F : 1.0F;
        return music;
    };
    const auto off = dance(changing, 3000, Dynamics::off);
    const auto plain = dance(
        [](HopIndex hop) {
            MusicState music = playing(hop);
            music.is_silent = hop >= 2000 && hop < 2100;
            return music;
        },
        3000,
        Dynamics::off);
    for (std::size_t hop = 0; hop < off.size(); ++hop) {
        ASSERT_EQ(off[hop].local_rotations, plain[hop].local_rotations) << hop;
    }
}

// Music whose bar is found after 3 s: until then another beat is taken for the downbeat.
MusicState late_bar(HopIndex hop, int beats_off) {
    MusicState music = playing(hop);
    music.grid.bar_origin = Beats(hop < 300 ? 0.0 : beats_off);
    return music;
}

TEST(Dynamics, a_bar_that_is_found_late_is_waited_for) {
    for (const Dynamics dynamics : {Dynamics::on, Dynamics::off}) {
        for (const int beats_off : {1, 2, 3}) {
            Dancer dancer;
            DancerPart part;
            part.dynamics = dynamics;
            ASSERT_TRUE(dancer.prepare(
                Repertoire::of_one(test::salsa_library()), mannequin_skeleton(), part));
            const auto track = std::make_unique<PoseTrack>();
            std::vector<Pose> poses;
            for (HopIndex hop = 0; hop < 2000; ++hop) {
                dancer.advance(late_bar(hop, beats_off), *track);
                poses.push_back(track->at_hop(hop));
            }
            EXPECT_EQ(dancer.status().reanchors, 1U);
            const BeatGrid grid = late_bar(1999, beats_off).grid;
            const double off =
                grid.bar_position(grid.beats_at(time_of_hop(1999))) - dancer.status().phase;
            EXPECT_NEAR(std::remainder(off, 4.0), 0.0, 0.05) << "count 1 is on the downbeat";
            EXPECT_LT(test::largest_step(poses, 1, static_cast<HopIndex>(poses.size()) - 1),
                      test::kFastestStep);
        }
    }
}

TEST(Dynamics, stops_and_endings_keep_the_real_time_rules) {
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(
        Repertoire::of_one(test::salsa_library()), mannequin_skeleton(), DancerPart{}));
    const auto track = std::make_unique<PoseTrack>();
    raks::test::RealtimeScope scope;
    for (HopIndex hop = 0; hop < 4000; ++hop) {
        dancer.advance(stopping(hop, 1500 + 1000 * (hop / 2200), 1700 + 2000 * (hop / 2200)),
                       *track);
    }
    for (HopIndex hop = 4000; hop < 6000; ++hop) {
        MusicState music = playing(hop);
        music.grid.bar_origin = Beats(2.0);
        dancer.advance(music, *track);
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::motion::dynamics_test
