#include "motion/dance/cell_chooser.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/motion/dance/small_cells.hpp"
#include "tests/support/realtime_guard.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

/// So many beats of a dance, and where each ends on the stage.
struct Walk {
    std::vector<CellStep> steps;
    std::vector<FloorMove> places;
};

FloorMove move_of(const CellGraph& graph, const CellStep& step) {
    const Cell& cell = graph.cells[step.cell];
    const double side = step.is_mirrored ? -1.0 : 1.0;
    return {side * static_cast<double>(cell.turn),
            {side * static_cast<double>(cell.way.x), static_cast<double>(cell.way.y)}};
}

Walk walk(const CellGraph& graph, std::uint64_t seed, std::size_t beats, double energy = 0.5) {
    CellChooser chooser;
    Walk walk;
    CellWish wish;
    for (CellBeatWish& beat : wish.beats) {
        beat.energy = energy;
    }
    CellStep last = chooser.start(graph, seed);
    walk.steps.push_back(last);
    walk.places.push_back(move_of(graph, last));
    while (walk.steps.size() < beats) {
        while (!chooser.is_drawn()) {
            chooser.draw(graph, last, walk.places.back(), wish);
        }
        for (const CellStep& step : chooser.decide()) {
            walk.steps.push_back(step);
            walk.places.push_back(walk.places.back() * move_of(graph, step));
            last = step;
        }
    }
    return walk;
}

TEST(CellChooser, goes_along_arcs_and_successors_alone) {
    const CellGraph graph = test::small_graph(6, 20, 8);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const Walk danced = walk(graph, seed, 400);
        for (std::size_t i = 1; i < danced.steps.size(); ++i) {
            const CellStep& from = danced.steps[i - 1];
            const CellStep& to = danced.steps[i];
            if (!to.is_joined) {
                EXPECT_TRUE(graph.has_successor(from.cell));
                EXPECT_EQ(to.cell, from.cell + 1);
                EXPECT_EQ(to.is_mirrored, from.is_mirrored);
                continue;
            }
            const auto arcs = graph.arcs_of(from.cell);
            EXPECT_TRUE(std::any_of(arcs.begin(),
                                    arcs.end(),
                                    [&](const CellArc& arc) {
                                        return arc.to == to.cell &&
                                               arc.is_mirrored ==
                                                   (from.is_mirrored != to.is_mirrored);
                                    }))
                << "seed " << seed << ", beat " << i;
        }
    }
}

TEST(CellChooser, stays_on_the_stage_for_an_hour) {
    const CellGraph graph = test::small_graph(8, 24, 12);
    double farthest = 0.0;
    for (const FloorMove& place : walk(graph, 3, 7'200).places) {
        farthest = std::max(farthest, glm::length(place.offset));
    }
    EXPECT_LT(farthest, 4.0);
}

TEST(CellChooser, gives_more_to_music_that_gives_more) {
    const CellGraph graph = test::small_graph(8, 24, 12);
    const auto mean_energy = [&](double energy) {
        double sum = 0.0;
        const Walk danced = walk(graph, 1, 400, energy);
        for (const CellStep& step : danced.steps) {
            sum += static_cast<double>(graph.cells[step.cell].energy);
        }
        return sum / static_cast<double>(danced.steps.size());
    };
    const double usual = mean_energy(0.5);
    EXPECT_LT(mean_energy(0.1), usual - 0.05);
    EXPECT_GT(mean_energy(1.0), usual + 0.05);
}

TEST(CellChooser, hardly_repeats_what_it_danced_lately) {
    const CellGraph graph = test::small_graph(8, 24, 12);
    const Walk danced = walk(graph, 2, 400);
    int repeats = 0;
    for (std::size_t i = 1; i < danced.steps.size(); ++i) {
        for (std::size_t j = i > 32 ? i - 32 : 0; j < i; ++j) {
            repeats += danced.steps[j].cell == danced.steps[i].cell ? 1 : 0;
        }
    }
    EXPECT_LT(repeats, 40) << "of 400 beats";
}

TEST(CellChooser, the_same_seed_dances_the_same) {
    const CellGraph graph = test::small_graph(4, 16, 6);
    const auto is_same = [](const CellStep& a, const CellStep& b) {
        return a.cell == b.cell && a.is_mirrored == b.is_mirrored && a.is_joined == b.is_joined;
    };
    const auto one = walk(graph, 7, 100).steps;
    const auto two = walk(graph, 7, 100).steps;
    const auto other = walk(graph, 8, 100).steps;
    EXPECT_TRUE(std::equal(one.begin(), one.end(), two.begin(), two.end(), is_same));
    EXPECT_FALSE(std::equal(one.begin(), one.end(), other.begin(), other.end(), is_same));
}

TEST(CellChooser, begins_a_half_of_the_bar_and_does_not_begin_as_it_did_before) {
    const CellGraph graph = test::small_graph(6, 20, 8);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        CellChooser chooser;
        const CellStep first = chooser.start(graph, seed);
        EXPECT_FALSE(graph.cells[first.cell].is_second_half) << seed;
        EXPECT_NE(chooser.start(graph, seed).cell, first.cell) << seed;
    }
}

TEST(CellChooser, a_row_is_followed_and_reached_along_no_arc_where_none_leads_to_it) {
    const CellGraph graph = test::small_graph(6, 20, 8);
    CellWish wish;
    for (std::size_t beat = 0; beat < wish.beats.size(); ++beat) {
        wish.beats[beat].is = CellStep{static_cast<std::uint16_t>(40 + beat), true, false};
    }
    CellChooser chooser;
    const CellStep last = chooser.start(graph, 1);
    while (!chooser.is_drawn()) {
        chooser.draw(graph, last, {}, wish);
    }
    const auto steps = chooser.decide();
    EXPECT_EQ(steps[1].cell, 41);
    EXPECT_TRUE(steps[1].is_mirrored);
}

TEST(CellChooser, a_loop_without_a_choice_is_danced_on_and_on) {
    CellGraph graph = test::small_graph(1, 10, 0);
    graph.arcs.push_back({0, false, 5.0F});
    graph.first_arc.back() = 1;
    EXPECT_GE(walk(graph, 1, 60).steps.size(), 60U);
}

TEST(CellChooser, neither_allocates_nor_waits) {
    const CellGraph graph = test::small_graph(8, 24, 12);
    CellChooser chooser;
    const CellStep last = chooser.start(graph, 1);
    raks::test::RealtimeScope scope;
    for (int i = 0; i < CellChooser::kFutures; ++i) {
        chooser.draw(graph, last, {}, {});
    }
    static_cast<void>(chooser.decide());
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::motion
