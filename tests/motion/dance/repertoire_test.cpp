#include "motion/repertoire.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "motion/dance/body/floor_move.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "tests/motion/dance/stage.hpp"
#include "tests/support/dances.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::motion {
namespace {

using test::steady_grid;
using test::sure_state;

constexpr double kTempoBpm = 168.0;

/// Salsa with all its figures, and a "belly dance" of one salsa step: another library.
std::shared_ptr<Repertoire> two_dances(Repertoire::Fallback otherwise) {
    auto repertoire =
        std::make_shared<Repertoire>(shipped::salsa, test::salsa_library(), otherwise);
    repertoire->add(shipped::belly, test::library_of(test::basic_step()));
    return repertoire;
}

struct Hop {
    Pose pose;
    DancerStatus status;
    double bar_position = 0.0;
};

/// `genre_at`: what is heard at each hop.
template <typename GenreAt>
std::vector<Hop> dance_to(const std::shared_ptr<const Repertoire>& repertoire,
                          HopIndex hops,
                          const GenreAt& genre_at,
                          std::vector<DancerCommand> commands = {}) {
    Dancer dancer;
    EXPECT_TRUE(dancer.prepare(repertoire, mannequin_skeleton(), DancerPart{}));
    for (const DancerCommand& command : commands) {
        dancer.command(command);
    }
    const auto track = std::make_unique<PoseTrack>();
    std::vector<Hop> danced;
    for (HopIndex hop = 0; hop < hops; ++hop) {
        MusicState state = sure_state(hop, steady_grid(kTempoBpm));
        state.genre = genre_at(hop);
        dancer.advance(state, *track);
        danced.push_back({track->at_hop(hop),
                          dancer.status(),
                          state.grid.bar_position(state.grid.beats_at(state.time))});
    }
    return danced;
}

double largest_step(const std::vector<Hop>& danced) {
    std::vector<Pose> poses;
    for (const Hop& hop : danced) {
        poses.push_back(hop.pose);
    }
    return test::largest_step(poses, 0, static_cast<HopIndex>(poses.size()));
}

DanceId to_belly(HopIndex hop) { return hop < 1700 ? shipped::salsa : shipped::belly; }

// The first hop after 1500 from which the dancer of salsa faces the audience for a bar.
HopIndex faces_us_from() {
    const auto salsa = [](HopIndex) { return shipped::salsa; };
    const auto danced = dance_to(two_dances(Repertoire::Fallback::first), 3500, salsa);
    const auto bar = static_cast<HopIndex>(100.0 * 4.0 * 60.0 / kTempoBpm);
    HopIndex from = 1500;
    for (HopIndex hop = from; hop < 3500 && hop < from + bar; ++hop) {
        const glm::quat hips = danced[static_cast<std::size_t>(hop)].pose.rotation(Bone::hips);
        if ((hips * glm::vec3(0.0F, 0.0F, 1.0F)).z < 0.5F) {
            from = hop + 1;
        }
    }
    return from;
}

// One who is turned away may have to settle first.
TEST(Repertoire, a_new_dance_goes_on_from_the_steps_of_the_old_one_on_a_bar_line) {
    const HopIndex heard = faces_us_from();
    ASSERT_LT(heard, 2500);
    const auto danced = dance_to(two_dances(Repertoire::Fallback::first), 3500, [&](HopIndex hop) {
        return hop < heard ? shipped::salsa : shipped::belly;
    });
    std::size_t begun = 0;
    for (auto hop = static_cast<std::size_t>(heard); hop < danced.size(); ++hop) {
        ASSERT_TRUE(danced[hop].status.is_dancing) << "no pose of attention between: " << hop;
        if (danced[hop].status.dance == shipped::belly && begun == 0) {
            begun = hop;
        }
    }
    ASSERT_GT(begun, static_cast<std::size_t>(heard));
    const double bar = 4.0 * 60.0 / kTempoBpm;
    EXPECT_LT(static_cast<double>(begun) - static_cast<double>(heard), 100.0 * (2.0 * bar + 0.1))
        << "two bars at most";
    EXPECT_LT(danced[begun].bar_position, 0.1) << "count 1 on the bar line";
    EXPECT_LT(largest_step(danced), test::kFastestStep);
}

// Wherever in its turns the old dance is.
TEST(Repertoire, a_known_song_changes_its_dance_within_two_bars_and_never_with_the_back_to_us) {
    const double bar = 100.0 * 4.0 * 60.0 / kTempoBpm;
    for (int line = 11; line < 24; ++line) {
        const auto heard = static_cast<HopIndex>(std::ceil(line * bar));
        const auto danced =
            dance_to(two_dances(Repertoire::Fallback::first), heard + 500, [&](HopIndex hop) {
                return hop < heard ? shipped::salsa : shipped::belly;
            });
        auto begun = static_cast<std::size_t>(heard);
        while (begun < danced.size() && danced[begun].status.dance != shipped::belly) {
            ++begun;
        }
        ASSERT_LT(begun, danced.size());
        EXPECT_LT(static_cast<double>(begun) - static_cast<double>(heard), 2.125 * bar) << line;
        const glm::quat hips = danced[begun].pose.rotation(Bone::hips);
        EXPECT_GT((hips * glm::vec3(0.0F, 0.0F, 1.0F)).z, -0.2F) << line;
    }
}

TEST(Repertoire, feet_that_stand_do_not_slide_into_a_new_dance) {
    const auto danced = dance_to(two_dances(Repertoire::Fallback::first), 3500, to_belly);
    const Skeleton& skeleton = mannequin_skeleton();
    for (std::size_t hop = 1701; hop < 2300; ++hop) {
        const WorldPose now = world_pose(skeleton, danced[hop].pose);
        const WorldPose before = world_pose(skeleton, danced[hop - 1].pose);
        for (const Side side : kSides) {
            const auto s = static_cast<std::size_t>(side);
            EXPECT_GT(foot_point(now, side, skeleton.ball).y, -0.01F) << hop;
            if (danced[hop].pose.foot_contact[s] && danced[hop - 1].pose.foot_contact[s]) {
                glm::vec3 slid = foot_place(skeleton, now, side).pivot -
                                 foot_place(skeleton, before, side).pivot;
                slid.y = 0.0F;
                EXPECT_LT(glm::length(slid), 0.006F) << "hop " << hop << " side " << s;
            }
        }
    }
}

TEST(Repertoire, feet_step_to_where_the_dancer_settles_and_do_not_slide) {
    const auto lost = [](HopIndex hop) { return hop < 1700 ? shipped::belly : DanceId::none; };
    const auto danced = dance_to(two_dances(Repertoire::Fallback::stand), 3500, lost);
    const Skeleton& skeleton = mannequin_skeleton();
    for (std::size_t hop = 1701; hop < danced.size(); ++hop) {
        if (danced[hop].status.is_dancing || danced[hop - 1].status.is_dancing) {
            continue;
        }
        const WorldPose now = world_pose(skeleton, danced[hop].pose);
        const WorldPose before = world_pose(skeleton, danced[hop - 1].pose);
        for (const Side side : kSides) {
            const auto s = static_cast<std::size_t>(side);
            const glm::vec3 ball = foot_point(now, side, skeleton.ball);
            EXPECT_GT(ball.y, -0.005F);
            if (danced[hop].pose.foot_contact[s] && danced[hop - 1].pose.foot_contact[s]) {
                glm::vec3 slid = ball - foot_point(before, side, skeleton.ball);
                slid.y = 0.0F;
                EXPECT_LT(glm::length(slid), 0.012F) << "hop " << hop << " side " << s;
            }
        }
    }
}

TEST(Repertoire, unknown_music_is_danced_as_the_setting_says) {
    const auto lost = [](HopIndex hop) { return hop < 1700 ? shipped::belly : DanceId::none; };
    using Fallback = Repertoire::Fallback;
    EXPECT_EQ(dance_to(two_dances(Fallback::first), 3000, lost).back().status.dance,
              shipped::salsa);
    EXPECT_EQ(dance_to(two_dances(Fallback::keep), 3000, lost).back().status.dance, shipped::belly);
    EXPECT_FALSE(dance_to(two_dances(Fallback::stand), 3000, lost).back().status.is_dancing);
    // A genre whose dance nobody knows is as good as unknown.
    const auto waltz = [](HopIndex) { return shipped::waltz; };
    EXPECT_EQ(dance_to(two_dances(Fallback::keep), 1500, waltz).back().status.dance,
              shipped::salsa);
}

TEST(Repertoire, a_dance_that_is_selected_is_kept_to_until_it_is_let_go) {
    using Kind = DancerCommand::Kind;
    const auto salsa = [](HopIndex) { return shipped::salsa; };
    const auto danced = dance_to(
        two_dances(Repertoire::Fallback::first),
        4000,
        salsa,
        {{Kind::select_dance, stream_time_from_seconds(10.0), 1.0},
         {Kind::select_dance, stream_time_from_seconds(15.0), std::nan("")},
         {Kind::select_dance, stream_time_from_seconds(25.0), static_cast<double>(DanceId::none)}});
    EXPECT_EQ(danced[900].status.dance, shipped::salsa);
    EXPECT_EQ(danced[2400].status.dance, shipped::belly);
    EXPECT_EQ(danced[3900].status.dance, shipped::salsa);
}

TEST(Repertoire, a_forbidden_dance_is_left_for_another_until_it_is_allowed) {
    using Kind = DancerCommand::Kind;
    for (const auto otherwise : {Repertoire::Fallback::first, Repertoire::Fallback::keep}) {
        const auto danced = dance_to(two_dances(otherwise),
                                     4000,
                                     [](HopIndex) { return shipped::salsa; },
                                     {{Kind::forbid_dance,
                                       stream_time_from_seconds(10.0),
                                       static_cast<double>(shipped::salsa)},
                                      {Kind::forbid_dance, stream_time_from_seconds(10.0), 1e9},
                                      {Kind::allow_dance,
                                       stream_time_from_seconds(25.0),
                                       static_cast<double>(shipped::salsa)}});
        EXPECT_EQ(danced[900].status.dance, shipped::salsa);
        EXPECT_EQ(danced[2400].status.dance, shipped::belly);
        EXPECT_EQ(danced[3900].status.dance, shipped::salsa);
    }
}

TEST(Repertoire, the_last_dance_stays_allowed_and_a_selected_one_is_danced_even_so) {
    using Kind = DancerCommand::Kind;
    const auto salsa = static_cast<double>(shipped::salsa);
    const auto belly = static_cast<double>(shipped::belly);
    const auto danced = dance_to(two_dances(Repertoire::Fallback::first),
                                 4000,
                                 [](HopIndex) { return shipped::salsa; },
                                 {{Kind::forbid_dance, stream_time_from_seconds(1.0), belly},
                                  {Kind::forbid_dance, stream_time_from_seconds(1.0), salsa},
                                  {Kind::select_dance, stream_time_from_seconds(20.0), belly}});
    EXPECT_EQ(danced[1900].status.dance, shipped::salsa);
    EXPECT_EQ(danced[3900].status.dance, shipped::belly);
}

TEST(Repertoire, a_dance_added_later_is_danced_from_then_on) {
    auto repertoire = std::make_shared<Repertoire>(shipped::salsa, test::salsa_library());
    const auto belly = [&](HopIndex hop) {
        if (hop == 1500) {
            repertoire->add(shipped::belly, test::library_of(test::basic_step()));
        }
        return shipped::belly;
    };
    const auto danced = dance_to(repertoire, 2500, belly);
    EXPECT_EQ(danced[1499].status.dance, shipped::salsa);
    EXPECT_EQ(danced.back().status.dance, shipped::belly);
}

TEST(Repertoire, unknown_music_far_from_the_first_dance_gets_the_nearest) {
    const auto library = test::library_of(test::basic_step());
    Repertoire repertoire(DanceId{4},
                          library,
                          Repertoire::Fallback::first,
                          {.lowest = Bpm(88.0), .highest = Bpm(157.0), .likely = Bpm(118.0)});
    repertoire.add(
        DanceId{0}, library, {.lowest = Bpm(160.0), .highest = Bpm(220.0), .likely = Bpm(184.0)});
    repertoire.add(
        DanceId{2}, library, {.lowest = Bpm(70.0), .highest = Bpm(115.0), .likely = Bpm(92.0)});
    repertoire.add(
        DanceId{3},
        library,
        {.lowest = Bpm(80.0), .highest = Bpm(200.0), .likely = Bpm(160.0), .beats_per_bar = 3});
    const auto nearest = [&](double bpm, DanceId present = DanceId::none, int beats = 4) {
        return repertoire.nearest(Bpm(bpm), beats, present);
    };
    EXPECT_EQ(nearest(120.0), DanceId{4});
    EXPECT_EQ(nearest(70.0), DanceId{4}) << "twice as fast it lies in the range";
    EXPECT_EQ(nearest(180.0), DanceId{4}) << "half as fast it lies in the range";
    EXPECT_EQ(nearest(82.0), DanceId{2});
    EXPECT_EQ(nearest(172.0), DanceId{0});
    EXPECT_EQ(nearest(162.0, DanceId::none, 3), DanceId{3}) << "a bar of three beats";
    EXPECT_EQ(nearest(0.0), DanceId{4}) << "no tempo yet";
    // What is danced stays while the tempo wavers about the edge of the range.
    EXPECT_EQ(nearest(160.0), DanceId{0});
    EXPECT_EQ(nearest(160.0, DanceId{4}), DanceId{4});
    EXPECT_EQ(nearest(168.0, DanceId{4}), DanceId{0});
}

TEST(Repertoire, changes_of_dance_keep_the_real_time_rules) {
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(
        two_dances(Repertoire::Fallback::first), mannequin_skeleton(), DancerPart{}));
    const auto track = std::make_unique<PoseTrack>();
    raks::test::RealtimeScope scope;
    for (HopIndex hop = 0; hop < 4000; ++hop) {
        MusicState state = sure_state(hop, steady_grid(kTempoBpm));
        state.genre = hop / 1000 % 2 == 0 ? shipped::salsa : shipped::belly;
        dancer.advance(state, *track);
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::motion
