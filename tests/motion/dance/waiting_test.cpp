#include "motion/dance/dynamics/waiting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "motion/dance/standing.hpp"
#include "motion/figures/figure_grammar.hpp"
#include "tests/motion/dance/stage.hpp"
#include "tests/support/realtime_guard.hpp"

#include <glm/geometric.hpp>

namespace raks::motion::waiting_test {
namespace {

const Skeleton& body() { return mannequin_skeleton(); }
StreamTime at(double seconds) { return stream_time_from_seconds(seconds); }

constexpr std::array kDances = {"salsa", "belly", "house", "hiphop", "rock", "waltz"};

DanceHabits habits_of(const std::string& dance) {
    const auto grammar =
        load_grammar(std::string(RAKS_SOURCE_DIR) + "/models/trained/" + dance + ".toml");
    EXPECT_TRUE(grammar) << grammar.error().message;
    return grammar->habits;
}

/// One who waits from time 0 on.
class Waits {
 public:
    Waits(const DanceHabits& habits, std::uint64_t seed) { waiting.begin(at(0.0), habits, seed); }
    /// The pose of the next hop.
    Pose next(const FeltBeat& beat = {}) {
        const StreamTime time = time_of_hop(hop_++);
        waiting.lead_hands(time, hands_);
        Pose pose = idle_pose(body(), time);
        waiting.move(body(), time, beat, pose);
        hands_.apply(body(), time, 0.0, pose);
        waiting.shake(time, pose);
        return pose;
    }
    Waiting waiting;

 private:
    HandRests hands_;
    HopIndex hop_ = 0;
};

std::vector<Pose> waited(Waits& waits, int hops) {
    std::vector<Pose> poses;
    for (int hop = 0; hop < hops; ++hop) {
        poses.push_back(waits.next());
    }
    return poses;
}

constexpr std::array kSeen = {Bone::hips,
                              Bone::head,
                              Bone::left_hand,
                              Bone::right_hand,
                              Bone::left_lower_arm,
                              Bone::right_lower_arm,
                              Bone::left_toes,
                              Bone::right_toes};

/// The farthest that any joint, or the point that the head looks at from 1 m, goes in some poses.
double way_in(const std::vector<Pose>& poses, std::size_t from, std::size_t to) {
    double most = 0.0;
    std::vector<glm::vec3> first;
    for (std::size_t hop = from; hop < to; hop += 5) {
        const WorldPose world = world_pose(body(), poses[hop]);
        std::vector<glm::vec3> points;
        for (const Bone bone : kSeen) {
            points.push_back(world.position(bone));
        }
        points.push_back(world.position(Bone::head) +
                         world.rotation(Bone::head) * glm::vec3(0.0F, 0.0F, 1.0F));
        first = first.empty() ? points : first;
        for (std::size_t i = 0; i < points.size(); ++i) {
            most = std::max(most, static_cast<double>(glm::distance(points[i], first[i])));
        }
    }
    return most;
}

TEST(Waiting, nobody_is_still_for_two_seconds_in_any_dance) {
    for (const char* const dance : kDances) {
        for (const std::uint64_t seed : {1U, 2U, 3U}) {
            Waits waits(habits_of(dance), seed);
            const auto poses = waited(waits, 7000);
            for (std::size_t from = 0; from + 200 < poses.size(); from += 20) {
                ASSERT_GT(way_in(poses, from, from + 200), 0.025) << dance << " " << from;
            }
        }
    }
}

TEST(Waiting, no_movement_comes_twice_within_a_minute) {
    for (const char* const dance : kDances) {
        Waits waits(habits_of(dance), 5);
        std::map<IdleMove, double> ended;
        std::optional<IdleMove> last;
        for (double time = 0.0; time < 300.0; time += 0.1) {
            const auto move = waits.waiting.move_at(at(time));
            if (move && move != last) {
                ASSERT_TRUE(!ended.contains(*move) || time - ended[*move] > 60.0)
                    << dance << " " << time;
            }
            if (last) {
                ended[*last] = move == last ? time : ended[*last];
            }
            last = move;
        }
        EXPECT_GE(ended.size(), Waiting::kLeastMoves);
    }
}

TEST(Waiting, each_dance_waits_in_its_own_way) {
    for (const char* const dance : kDances) {
        const DanceHabits habits = habits_of(dance);
        ASSERT_GE(habits.idle.size(), 3U) << dance;
        Waits waits(habits, 1);
        for (const IdleMove own : habits.idle) {
            bool is_done = false;
            for (double time = 0.0; time < 100.0 && !is_done; time += 1.0) {
                is_done = waits.waiting.move_at(at(time)) == own;
            }
            EXPECT_TRUE(is_done) << dance << " " << kIdleMoveNames[static_cast<std::size_t>(own)];
        }
    }
}

/// The place on the floor under the heel of a foot that is flat or turned about it.
glm::vec3 heel_of(const WorldPose& world, Side side) {
    const Bone foot = on_side(Bone::left_foot, side);
    const float ankle = world_pose(body(), idle_pose(body(), at(0.0))).position(foot).y;
    return world.position(foot) + world.rotation(foot) * glm::vec3(0.0F, -ankle, -0.04F);
}

TEST(Waiting, feet_turn_about_heel_or_ball_and_do_not_slide) {
    DanceHabits all;
    for (std::size_t i = 0; i < kIdleMoveNames.size(); ++i) {
        all.idle.push_back(static_cast<IdleMove>(i));
    }
    Waits waits(all, 1);
    const WorldPose stands = world_pose(body(), idle_pose(body(), at(0.0)));
    for (int hop = 0; hop < 11'000; ++hop) {
        const WorldPose world = world_pose(body(), waits.next());
        for (const Side side : kSides) {
            const float heel =
                glm::distance(glm::vec2(heel_of(world, side).x, heel_of(world, side).z),
                              glm::vec2(heel_of(stands, side).x, heel_of(stands, side).z));
            const float ball = glm::distance(foot_place(body(), world, side).pivot,
                                             foot_place(body(), stands, side).pivot);
            ASSERT_LT(std::min(heel, ball), 0.02F) << hop;
        }
    }
}

TEST(Waiting, moves_smoothly) {
    DanceHabits all;
    for (std::size_t i = 0; i < kIdleMoveNames.size(); ++i) {
        all.idle.push_back(static_cast<IdleMove>(i));
    }
    for (const std::uint64_t seed : {1U, 2U}) {
        Waits waits(all, seed);
        const auto poses = waited(waits, 11'000);
        EXPECT_LT(test::largest_step(poses, 0, 11'000), 0.03) << "metres a hop";
        double highest = 0.0;
        std::vector<WorldPose> worlds;
        for (const Pose& pose : poses) {
            worlds.push_back(world_pose(body(), pose));
        }
        for (std::size_t hop = 3; hop < worlds.size(); ++hop) {
            for (const Bone bone : kSeen) {
                const glm::vec3 third =
                    worlds[hop].position(bone) - 3.0F * worlds[hop - 1].position(bone) +
                    3.0F * worlds[hop - 2].position(bone) - worlds[hop - 3].position(bone);
                highest = std::max(highest, 1e6 * static_cast<double>(glm::length(third)));
            }
        }
        EXPECT_LT(highest, 1'500.0) << "m/s3; people's highest of a thousand in dances: 1,408";
    }
}

TEST(Waiting, nods_on_the_beat_once_it_is_felt) {
    const auto head = [](const FeltBeat& beat) {
        Waits waits(DanceHabits(), 1);
        return world_pose(body(), waits.next(beat)).position(Bone::head).y;
    };
    const float between = head({1.0F, 4.5});
    EXPECT_LT(head({1.0F, 4.0}), between - 0.008F);
    EXPECT_EQ(head({0.0F, 4.0}), between) << "who feels nothing does not move with it";
}

TEST(Waiting, every_ending_shows_and_comes_back_to_standing) {
    for (std::size_t i = 0; i < kEndingNames.size(); ++i) {
        Waits waits(DanceHabits(), 1);
        const auto ending = static_cast<Ending>(i);
        waits.waiting.end_song(ending, at(1.0));
        const double lasts = gesture_of(ending).seconds();
        EXPECT_GE(lasts, 2.5);
        EXPECT_LE(lasts, 4.0);
        const auto poses = waited(waits, static_cast<int>(100.0 * (1.0 + lasts)) + 1);
        EXPECT_GT(way_in(poses, 100, poses.size()), 0.12) << kEndingNames[i];
        const auto last = static_cast<HopIndex>(poses.size()) - 1;
        const glm::vec3 head = world_pose(body(), poses.back()).position(Bone::head);
        const Pose stands = idle_pose(body(), time_of_hop(last));
        EXPECT_LT(glm::distance(head, world_pose(body(), stands).position(Bone::head)), 0.002F)
            << kEndingNames[i];
    }
}

TEST(Waiting, a_bow_goes_down_and_comes_up) {
    Waits waits(DanceHabits(), 1);
    waits.waiting.end_song(Ending::bow, at(1.0));
    const auto poses = waited(waits, 200);
    const glm::vec3 upright = world_pose(body(), poses[100]).position(Bone::head);
    const glm::vec3 bowed = world_pose(body(), poses[195]).position(Bone::head);
    EXPECT_GT(bowed.z, upright.z + 0.15F);
    EXPECT_LT(bowed.y, upright.y - 0.05F);
}

TEST(Waiting, hip_hop_does_not_bow_and_each_dance_has_four_endings) {
    for (const char* const dance : kDances) {
        const DanceHabits habits = habits_of(dance);
        EXPECT_EQ(habits.endings.size(), 4U) << dance;
        EXPECT_TRUE(habits.notes.empty()) << dance;
    }
    const auto endings = habits_of("hiphop").endings;
    EXPECT_EQ(std::count(endings.begin(), endings.end(), Ending::bow), 0);
}

TEST(Waiting, keeps_the_real_time_rules) {
    const DanceHabits habits = habits_of("belly");
    Waits waits(habits, 1);
    raks::test::RealtimeScope scope;
    for (int hop = 0; hop < 1000; ++hop) {
        waits.next();
    }
    waits.waiting.end_song(Ending::curtsy, at(10.0));
    for (int hop = 0; hop < 1000; ++hop) {
        waits.next();
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::motion::waiting_test
