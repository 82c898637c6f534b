#include "motion/dance/cell_sequence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "tests/motion/dance/cell_takes.hpp"
#include "tests/motion/dance/stage.hpp"
#include "tests/support/realtime_guard.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kHopBeats = 0.02;

/// A dance of cells, a hop after the other.
struct Cells {
    std::unique_ptr<CellSequence> sequence = std::make_unique<CellSequence>();
    FigureWish wish;
    double phase = 0.0;
    std::vector<CellStep> steps;  // by beat

    explicit Cells(std::uint64_t seed = 1) {
        DancerPart part;
        part.seed = seed;
        sequence->start(test::salsa_cell_content(), {}, part);
    }
    static const CellGraph& graph() { return *test::salsa_cell_content().cells; }
    void go_on(const CellMusic& music = {}) {
        phase += kHopBeats;
        sequence->advance(Beats(phase), music, wish);
        const auto beat = static_cast<std::size_t>(phase);
        if (beat >= steps.size() && phase - std::floor(phase) > 0.5) {
            steps.resize(beat + 1);
            steps[beat] = sequence->step_at(Beats(phase));
        }
    }
    void go_on_to(double until, const CellMusic& music = {}) {
        while (phase < until) {
            go_on(music);
        }
    }
    /// First halves of the bar are danced in even beats.
    void expect_halves(double from) const {
        for (double at = std::floor(from) + 0.5; at < phase + 0.5; at += 1.0) {
            const CellStep step = sequence->step_at(Beats(at));
            EXPECT_EQ(graph().cells[step.cell].is_second_half, std::lround(at - 0.5) % 2 == 1)
                << at;
        }
    }
};

double step_between(const Pose& a, const Pose& b) { return test::largest_step({a, b}, 0, 2); }

TEST(CellSequence, first_halves_of_the_bar_begin_at_even_beats) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        Cells cells(seed);
        for (int beat = 1; beat < 100; ++beat) {
            cells.go_on_to(beat + 0.5);
            cells.expect_halves(cells.phase);
        }
    }
}

TEST(CellSequence, keeps_the_halves_where_the_phase_jumps) {
    for (const double by : {-2.6, -1.0, 0.4, 1.37, 3.0}) {
        Cells cells;
        cells.go_on_to(20.3);
        cells.phase += by;
        const Pose before = cells.sequence->at(Beats(20.3));
        cells.sequence->jump(Beats(cells.phase));
        const Pose after = cells.sequence->at(Beats(cells.phase));
        EXPECT_LT(glm::distance(before.hips_position, after.hips_position), 0.2F) << by;
        cells.expect_halves(cells.phase);
        for (int beat = 1; beat < 12; ++beat) {
            cells.go_on_to(std::floor(20.3 + by) + beat + 0.5);
            cells.expect_halves(cells.phase);
        }
    }
}

TEST(CellSequence, goes_on_from_a_rest_where_it_stood_and_is_in_time_again) {
    for (const double key : {20.4, 20.5, 20.6}) {
        for (const double pause : {0.4, 1.5, 2.2, 3.9, 7.1}) {
            Cells cells;
            cells.go_on_to(key - 0.2);
            const Pose stood = cells.sequence->at(Beats(key));
            cells.phase = key + pause;
            cells.sequence->go_on_from(Beats(key), Beats(cells.phase));
            Pose last = cells.sequence->at(Beats(cells.phase));
            EXPECT_LT(step_between(stood, last), 0.15) << key << ", " << pause;
            double farthest = 0.0;
            for (int hop = 0; hop < 600; ++hop) {
                cells.go_on();
                const Pose next = cells.sequence->at(Beats(cells.phase));
                farthest = std::max(farthest, step_between(last, next));
                last = next;
            }
            EXPECT_LT(farthest, 1.6 * test::kFastestStep) << key << ", " << pause;
            cells.expect_halves(cells.phase);
        }
    }
}

TEST(CellSequence, comes_to_rest_where_it_is_asked_to) {
    int asked = 0;
    int rested = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        Cells cells(seed);
        for (double when = 14.0; when < 100.0; when += 16.0) {
            CellMusic music;
            music.rests_at = when;
            cells.go_on_to(when - 0.1, music);
            ++asked;
            rested += cells.sequence->rests_at(Beats(when)) ? 1 : 0;
        }
    }
    EXPECT_GT(rested, 0.7 * asked) << "of " << asked;
}

TEST(CellSequence, dances_the_greatest_cells_from_a_drop_on) {
    int greatest = 0;
    int before = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        Cells cells(seed);
        CellMusic music;
        music.energy = 0.2;
        music.drop_at = 24.0;
        cells.go_on_to(28.5, music);
        const auto is_great = [&](std::size_t beat) {
            return is_greatest(Cells::graph(), cells.steps[beat].cell) ? 1 : 0;
        };
        greatest += is_great(24) + is_great(25) + is_great(26) + is_great(27);
        before += is_great(20) + is_great(21) + is_great(22) + is_great(23);
    }
    EXPECT_GT(greatest, before + 12) << "of 40";
}

TEST(CellSequence, a_part_that_comes_again_gets_the_same_row) {
    int same = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        Cells cells(seed);
        // Bars 0 to 7 are new; 8 to 15 repeat them.
        for (int bar = 0; bar < 16; ++bar) {
            CellMusic music;
            SongBars song;
            song.bar = bar;
            song.begins = 4.0 * bar;
            for (int i = 0; i < 4; ++i) {
                const int first = bar + i - 8;
                song.repeats[static_cast<std::size_t>(i)] =
                    static_cast<std::int16_t>(first >= 0 && first < 8 ? first : -1);
            }
            music.song = song;
            cells.go_on_to(4.0 * (bar + 1), music);
        }
        for (std::size_t beat = 32; beat < 63; ++beat) {
            same += is_same_cell(cells.steps[beat], cells.steps[beat - 32]) ? 1 : 0;
        }
    }
    EXPECT_GT(same, 0.7 * 5 * 31);
}

TEST(CellSequence, another_cell_comes_at_the_next_beat) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        Cells cells(seed);
        cells.go_on_to(21.1);
        cells.wish.is_another = true;
        const std::uint64_t number = cells.sequence->number();
        cells.go_on_to(22.2);
        EXPECT_FALSE(cells.wish.is_another) << "granted";
        EXPECT_GT(cells.sequence->number(), number);
        const CellStep& before = cells.steps[21];
        EXPECT_FALSE(cells.sequence->step_at(Beats(22.2)).cell == before.cell + 1 &&
                     cells.sequence->is_mirrored() == before.is_mirrored);
    }
}

TEST(CellSequence, a_wished_take_comes) {
    Cells cells;
    cells.go_on_to(21.1);
    for (std::size_t take = 0; take < test::salsa_cells().takes.size(); ++take) {
        cells.wish.figure = take;
        cells.go_on_to(std::ceil(cells.phase + 0.6) + 0.2);
        EXPECT_FALSE(cells.wish.figure);
        EXPECT_EQ(Cells::graph().cells[cells.sequence->step_at(Beats(cells.phase)).cell].take,
                  take);
        cells.expect_halves(cells.phase);
    }
    cells.wish.figure = 1'000;
    cells.go_on_to(cells.phase + 4.0);
    EXPECT_FALSE(cells.wish.figure) << "there is none: nothing happens";
}

TEST(CellSequence, locked_it_dances_the_same_row_again_and_again) {
    Cells cells;
    cells.go_on_to(21.1);
    cells.wish.is_locked = true;
    cells.go_on_to(80.0);
    int same = 0;
    for (std::size_t beat = 40; beat < 80; ++beat) {
        for (const std::size_t back : {4U, 6U, 8U}) {
            if (is_same_cell(cells.steps[beat], cells.steps[beat - back])) {
                ++same;
                break;
            }
        }
    }
    EXPECT_GT(same, 30) << "of 40";
    cells.wish.is_locked = false;
    cells.go_on_to(140.0);
    int again = 0;
    for (std::size_t beat = 100; beat < 140; ++beat) {
        again += is_same_cell(cells.steps[beat], cells.steps[beat - 8]) ? 1 : 0;
    }
    EXPECT_LT(again, 10) << "of 40";
}

// Everything that can be asked for, for an hour at 120 BPM.
TEST(CellSequence, stays_on_the_stage_and_goes_on_for_an_hour) {
    const auto hour = [](std::vector<Pose>* poses) {
        Cells cells(3);
        double farthest = 0.0;
        int stays = 0;
        raks::test::RealtimeScope scope;
        for (int hop = 0; hop < 360'000; ++hop) {
            CellMusic music;
            music.energy = 0.5 + 0.5 * std::sin(0.001 * hop);
            music.rests_at = 16.0 * std::ceil(cells.phase / 16.0) - 2.0;
            music.anew_at = 32.0 * std::ceil(cells.phase / 32.0);
            music.has_come_in = hop % 7'000 == 6'000;
            music.drop_at = 256.0 * std::ceil(cells.phase / 256.0);
            cells.wish.is_locked = hop / 20'000 % 4 == 3;
            if (hop % 9'000 == 5'000) {
                cells.wish.is_another = true;
            }
            cells.phase += kHopBeats;
            if (hop % 11'111 == 11'110) {
                cells.phase += 1.3;
                cells.sequence->jump(Beats(cells.phase));
            }
            if (hop % 5'555 == 5'554) {
                const double key = cells.phase + 0.2;
                cells.phase += 3.1;
                cells.sequence->go_on_from(Beats(key), Beats(cells.phase));
            }
            const std::uint64_t number = cells.sequence->number();
            cells.sequence->advance(Beats(cells.phase), music, cells.wish);
            stays = cells.sequence->number() == number ? stays + 1 : 0;
            ASSERT_LT(stays, 1'500) << "the same piece for half a minute";
            if (hop % 10 == 0) {
                const Pose pose = cells.sequence->at(Beats(cells.phase));
                farthest = std::max(farthest,
                                    static_cast<double>(glm::length(
                                        glm::vec2(pose.hips_position.x, pose.hips_position.z))));
                if (poses != nullptr && hop % 1'000 == 0) {
                    poses->push_back(pose);
                }
            }
        }
        EXPECT_LT(farthest, 4.0);
        if (poses == nullptr) {
            EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
        }
    };
    hour(nullptr);
    std::vector<Pose> one;
    std::vector<Pose> two;
    hour(&one);
    hour(&two);
    ASSERT_EQ(one.size(), two.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        ASSERT_TRUE(test::are_same(one[i], two[i])) << i;
    }
}

TEST(CellSequence, calm_manners_make_its_poses_smaller_and_leave_the_feet) {
    Cells cells;
    Manner small;
    small.body = 0.5F;
    small.arms = 0.5F;
    double whole = 0.0;
    double half = 0.0;
    std::optional<std::array<WorldPose, 2>> before;
    for (int hop = 0; hop < 2'000; ++hop) {
        cells.go_on();
        const std::array<WorldPose, 2> now = {
            world_pose(mannequin_skeleton(), cells.sequence->at(Beats(cells.phase))),
            world_pose(mannequin_skeleton(), cells.sequence->at(Beats(cells.phase), small))};
        for (const Bone foot : {Bone::left_foot, Bone::right_foot}) {
            EXPECT_LT(glm::distance(now[0].position(foot), now[1].position(foot)), 0.01F);
        }
        if (before) {
            const auto way = [&](std::size_t i) {
                const auto hand = [i](const std::array<WorldPose, 2>& of) {
                    return of[i].position(Bone::left_hand) - of[i].position(Bone::hips);
                };
                return static_cast<double>(glm::distance(hand(now), hand(*before)));
            };
            whole += way(0);
            half += way(1);
        }
        before = now;
    }
    EXPECT_LT(half, 0.75 * whole);
}

}  // namespace
}  // namespace raks::motion
