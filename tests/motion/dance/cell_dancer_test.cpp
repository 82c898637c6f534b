// Dancers of cells: what those of figures can.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "motion/cells/cell_file.hpp"
#include "motion/dancer.hpp"
#include "motion/ensemble.hpp"
#include "motion/repertoire.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "tests/motion/dance/cell_takes.hpp"
#include "tests/motion/dance/stage.hpp"
#include "tests/support/dances.hpp"
#include "tests/support/realtime_guard.hpp"

#include <glm/geometric.hpp>

namespace raks::motion::cell_dancer_test {
namespace {

using Kind = MusicEvent::Kind;
constexpr double kBpm = 168.0;

std::shared_ptr<const DanceLibrary> cells() {
    static const std::shared_ptr<const DanceLibrary> library = test::salsa_cell_library();
    return library;
}

MusicState playing(HopIndex hop) {
    MusicState music = test::sure_state(hop, test::steady_grid(kBpm));
    music.part = MusicPart::playing;
    return music;
}

// Silent from one hop to another; the stop is heard 100 ms late.
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

std::vector<Pose> dance(const test::Music& music,
                        HopIndex hops,
                        const DancerPart& part = {},
                        const std::vector<DancerCommand>& commands = {}) {
    Dancer dancer;
    EXPECT_TRUE(dancer.prepare(Repertoire::of_one(cells()), mannequin_skeleton(), part));
    for (const DancerCommand& command : commands) {
        dancer.command(command);
    }
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

std::string where(const DancerStatus& status) {
    return std::string(status.figure.data()) + (status.is_mirrored ? "'" : "") +
           std::to_string(status.count);
}

TEST(CellDancer, stops_with_the_music_and_goes_on_where_it_stood) {
    for (const HopIndex stop : {2'000, 2'025, 2'050, 2'075}) {
        const auto poses =
            dance([&](HopIndex hop) { return stopping(hop, stop, stop + 200); }, 3'000);
        const double full = speed(poses, 1'000, 1'990);
        const auto at = static_cast<std::size_t>(stop);
        EXPECT_LT(speed(poses, at + 50, at + 199), 0.25 * full) << stop;
        EXPECT_GT(speed(poses, at + 200, at + 340), 0.6 * full) << stop;
        EXPECT_LT(glm::distance(poses[at + 190].hips_position, poses[at + 210].hips_position),
                  0.15F)
            << stop;
        EXPECT_LT(test::largest_step(poses, 0, 3'000), 1.5 * test::kFastestStep) << stop;
    }
}

TEST(CellDancer, stays_the_same_bit_for_bit) {
    const auto music = [](HopIndex hop) { return stopping(hop, 1'500, 1'650); };
    const auto one = dance(music, 2'500);
    const auto two = dance(music, 2'500);
    for (std::size_t hop = 0; hop < one.size(); ++hop) {
        ASSERT_TRUE(test::are_same(one[hop], two[hop])) << hop;
    }
}

TEST(CellDancer, keeps_the_real_time_rules_and_dances_on_for_minutes) {
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(Repertoire::of_one(cells()), mannequin_skeleton(), DancerPart{}));
    const auto track = std::make_unique<PoseTrack>();
    double farthest = 0.0;
    int idle = 0;
    raks::test::RealtimeScope scope;
    for (HopIndex hop = 0; hop < 20'000; ++hop) {
        MusicState music =
            hop % 3'000 > 2'500
                ? stopping(hop, hop / 3'000 * 3'000 + 2'600, hop / 3'000 * 3'000 + 2'750)
                : playing(hop);
        if (hop > 9'000 && hop < 12'000) {
            // The tempo rises by a half and falls again.
            const double by = 1.0 - std::abs(static_cast<double>(hop - 10'500)) / 1'500.0;
            music.grid.anchor_beat = music.grid.beats_at(music.time);
            music.grid.anchor_time = music.time;
            music.grid.tempo = Bpm(kBpm * (1.0 + 0.3 * by));
        }
        if (hop % 4'000 == 1'000) {
            dancer.command({DancerCommand::Kind::next_figure, music.time, 0.0});
        } else if (hop % 4'000 == 2'000) {
            dancer.command(
                {DancerCommand::Kind::lock_figure, music.time, hop % 8'000 == 2'000 ? 1.0 : 0.0});
        }
        dancer.advance(music, *track);
        idle = hop > 200 && !dancer.status().is_dancing ? idle + 1 : 0;
        ASSERT_LT(idle, 300) << hop << ": stopped by itself";
        const glm::vec3& hips = dancer.shown().hips_position;
        farthest = std::max(farthest, static_cast<double>(glm::length(glm::vec2(hips.x, hips.z))));
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_LT(farthest, 4.0);
}

TEST(CellDancer, is_held_and_released_by_command) {
    const auto poses = dance(playing,
                             3'000,
                             {},
                             {{DancerCommand::Kind::hold, stream_time_from_seconds(10.0), 0.0},
                              {DancerCommand::Kind::release, stream_time_from_seconds(18.0), 0.0}});
    const double full = speed(poses, 500, 1'000);
    EXPECT_LT(speed(poses, 1'400, 1'800), 0.3 * full);
    EXPECT_GT(speed(poses, 2'400, 2'900), 0.6 * full);
}

TEST(CellDancer, without_dynamics_does_not_stand_in_a_rest) {
    DancerPart part;
    part.dynamics = Dynamics::off;
    const auto poses = dance(playing, 9'000, part);
    std::vector<double> windows;
    for (std::size_t hop = 800; hop + 30 < poses.size(); hop += 30) {
        windows.push_back(speed(poses, hop, hop + 30));
    }
    std::sort(windows.begin(), windows.end());
    EXPECT_GT(windows.front(), 0.05 * windows[windows.size() / 2]);
}

/// What each dancer of a formation does at each hop.
struct EnsembleDanced {
    std::array<std::vector<Pose>, Ensemble::kMost> poses;
    std::array<std::vector<DancerStatus>, Ensemble::kMost> hops;
};

std::unique_ptr<EnsembleDanced> dance_together(
    Formation formation,
    std::size_t dancers,
    HopIndex hops,
    const std::shared_ptr<const DanceLibrary>& library = cells()) {
    const auto members = members_of(
        formation, {{mannequin_skeleton(), Repertoire::of_one(library)}}, 3, Dynamics::on, dancers);
    auto danced = std::make_unique<EnsembleDanced>();
    const auto track = std::make_unique<PoseTrack>();
    for (std::size_t i = 0; i < dancers; ++i) {
        Dancer dancer;
        EXPECT_TRUE(
            dancer.prepare(members[i].body.repertoire, members[i].body.skeleton, members[i].part));
        track->clear();
        for (HopIndex hop = 0; hop < hops; ++hop) {
            dancer.advance(playing(hop), *track);
            danced->poses[i].push_back(track->at_hop(hop));
            danced->hops[i].push_back(dancer.status());
        }
    }
    return danced;
}

TEST(CellDancer, a_part_of_a_known_song_that_comes_again_is_danced_again) {
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(Repertoire::of_one(cells()), mannequin_skeleton(), DancerPart{}));
    const auto track = std::make_unique<PoseTrack>();
    std::vector<std::string> danced;  // by beat
    constexpr std::size_t kBars = 8;
    while (danced.size() < 8 * kBars) {
        MusicState music = playing(track->newest_final() + 1);
        const double beat = music.grid.beats_at(music.time).count();
        const int bar = static_cast<int>(std::floor(beat / 4.0 + 1e-6));
        music.ahead.is_known = true;
        music.ahead.ends = stream_time_from_seconds(1'000.0);
        music.ahead.bar = bar;
        for (int i = 0; i < 4; ++i) {
            const int first = bar + i - static_cast<int>(kBars);
            const bool is_again = first >= 0 && first < static_cast<int>(kBars);
            music.ahead.repeats[static_cast<std::size_t>(i)] =
                static_cast<std::int16_t>(is_again ? first : -1);
        }
        dancer.advance(music, *track);
        if (beat > static_cast<double>(danced.size()) + 0.5) {
            danced.push_back(where(dancer.status()));
        }
    }
    int same = 0;
    for (std::size_t beat = 4 * kBars; beat < 8 * kBars; ++beat) {
        same += danced[beat] == danced[beat - 4 * kBars] ? 1 : 0;
    }
    EXPECT_GT(same, 20) << "of 32 beats";
}

TEST(CellDancer, dances_to_any_tempo_near_its_own_or_an_octave_of_it) {
    const double learnt = 1.0 / test::salsa_cells().graph.beat_seconds;
    for (const double bpm : {60.0, 90.0, 120.0, 168.0, 200.0, 230.0}) {
        Dancer dancer;
        ASSERT_TRUE(
            dancer.prepare(Repertoire::of_one(cells()), mannequin_skeleton(), DancerPart{}));
        const auto track = std::make_unique<PoseTrack>();
        std::vector<Pose> poses;
        for (HopIndex hop = 0; hop < 2'000; ++hop) {
            dancer.advance(test::sure_state(hop, test::steady_grid(bpm)), *track);
            poses.push_back(track->at_hop(hop));
        }
        const DancerStatus status = dancer.status();
        EXPECT_TRUE(status.is_dancing) << bpm;
        EXPECT_GT(status.rate / learnt, 0.6) << bpm;
        EXPECT_LT(status.rate / learnt, 1.6) << bpm;
        EXPECT_LT(test::largest_step(poses, 0, 2'000), 1.6 * test::kFastestStep) << bpm;
    }
}

TEST(CellDancer, in_unison_all_dance_the_same_cells) {
    const auto danced = dance_together(Formation::unison, 3, 3'000);
    for (std::size_t hop = 0; hop < 3'000; ++hop) {
        ASSERT_EQ(where(danced->hops[0][hop]), where(danced->hops[1][hop])) << hop;
        ASSERT_EQ(where(danced->hops[0][hop]), where(danced->hops[2][hop])) << hop;
    }
    EXPECT_GT(
        glm::distance(danced->poses[0][2'000].hips_position, danced->poses[1][2'000].hips_position),
        0.5F);
}

TEST(CellDancer, free_dancers_dance_other_cells) {
    const auto danced = dance_together(Formation::free, 2, 3'000);
    int other = 0;
    for (std::size_t hop = 500; hop < 3'000; ++hop) {
        other += where(danced->hops[0][hop]) != where(danced->hops[1][hop]) ? 1 : 0;
    }
    EXPECT_GT(other, 2'000);
}

TEST(CellDancer, free_dancers_of_peoples_takes_keep_apart) {
    constexpr std::size_t kDancers = 3;
    const auto takes = load_cells(RAKS_SOURCE_DIR "/models/trained/disco.cells");
    ASSERT_TRUE(takes) << takes.error().message;
    const auto library = DanceLibrary::build(*takes, mannequin_skeleton());
    ASSERT_TRUE(library) << library.error().message;
    const auto danced = dance_together(Formation::free, kDancers, 6'000, *library);
    float closest = 10.0F;
    for (std::size_t hop = 500; hop < 6'000; ++hop) {
        for (std::size_t i = 0; i < kDancers; ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                closest = std::min(closest,
                                   glm::distance(danced->poses[i][hop].hips_position,
                                                 danced->poses[j][hop].hips_position));
            }
        }
    }
    EXPECT_GT(closest, 0.8F);
}

TEST(CellDancer, a_canon_begins_two_bars_later) {
    const auto danced = dance_together(Formation::canon, 2, 1'500);
    const auto first = [&](std::size_t dancer) {
        const auto& hops = danced->hops[dancer];
        return std::find_if(hops.begin(),
                            hops.end(),
                            [](const DancerStatus& status) { return status.is_dancing; }) -
               hops.begin();
    };
    const double bar = 4.0 * 60.0 / kBpm * 100.0;
    EXPECT_NEAR(static_cast<double>(first(1) - first(0)), 2.0 * bar, 3.0);
}

TEST(CellDancer, goes_over_to_a_dance_of_figures_and_back) {
    auto repertoire = std::make_shared<Repertoire>(shipped::salsa, test::salsa_library());
    repertoire->add(shipped::hiphop, cells());
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(repertoire, mannequin_skeleton(), DancerPart{}));
    const auto track = std::make_unique<PoseTrack>();
    std::vector<Pose> poses;
    int of_cells = 0;
    for (HopIndex hop = 0; hop < 6'000; ++hop) {
        MusicState music = playing(hop);
        music.genre = hop / 1'500 % 2 == 0 ? shipped::salsa : shipped::hiphop;
        dancer.advance(music, *track);
        poses.push_back(track->at_hop(hop));
        of_cells += dancer.status().dance == shipped::hiphop ? 1 : 0;
    }
    EXPECT_GT(of_cells, 1'800);
    EXPECT_LT(of_cells, 4'200);
    EXPECT_LT(test::largest_step(poses, 0, 6'000), 1.5 * test::kFastestStep);
}

TEST(CellDancer, goes_on_in_another_body_without_a_leap) {
    Skeleton body = mannequin_skeleton();
    for (const Side side : kSides) {
        body.offsets[index_of(on_side(Bone::left_lower_arm, side))] *= 1.1F;
    }
    Dancer first;
    Dancer next;
    ASSERT_TRUE(first.prepare(Repertoire::of_one(cells()), mannequin_skeleton(), DancerPart{}));
    ASSERT_TRUE(
        next.prepare(Repertoire::of_one(test::salsa_cell_library(body)), body, DancerPart{}));
    const auto track = std::make_unique<PoseTrack>();
    std::vector<Pose> poses;
    Dancer* dancer = &first;
    for (HopIndex hop = 0; hop < 3'000; ++hop) {
        if (hop == 1'700) {
            const std::string before = where(first.status());
            next.go_on_from(first);
            dancer = &next;
            EXPECT_EQ(where(next.status()), before);
        }
        dancer->advance(playing(hop), *track);
        ASSERT_TRUE(hop < 300 || dancer->status().is_dancing) << hop;
        poses.push_back(track->at_hop(hop));
    }
    EXPECT_LT(test::largest_step(poses, 1'690, 1'760), 1.5 * test::kFastestStep);
}

}  // namespace
}  // namespace raks::motion::cell_dancer_test
