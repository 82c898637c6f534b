#include "tests/motion/dance/cell_takes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "base/random.hpp"
#include "motion/dance/body/floor_move.hpp"
#include "tests/motion/dance/stage.hpp"

namespace raks::motion::test {
namespace {

constexpr std::uint64_t kArcsEach = 10;
constexpr int kCopies = 2;  // of each figure, so that there is a choice of cells

DanceContent solved(const CellDance& dance) {
    auto content = make_cell_content(dance, mannequin_skeleton());
    EXPECT_TRUE(content) << content.error().message;
    return std::move(*content);
}

CellDance unmeasured_cells() {
    CellDance dance;
    dance.dance = "cells";
    for (const DanceRole role : {DanceRole::lead, DanceRole::follow}) {
        for (int copy = 0; copy < kCopies; ++copy) {
            const auto& figures = salsa_figures(role);
            dance.takes.insert(dance.takes.end(), figures.begin(), figures.end());
        }
    }
    CellGraph& graph = dance.graph;
    for (std::size_t take = 0; take < dance.takes.size(); ++take) {
        const int beats = dance.takes[take].beats;
        graph.takes.push_back({dance.takes[take].name, beats});
        for (int beat = 0; beat < beats; ++beat) {
            Cell cell;
            cell.take = static_cast<std::uint16_t>(take);
            cell.beat = static_cast<std::uint16_t>(beat);
            cell.energy = 0.4F + 0.1F * static_cast<float>(beat);
            cell.speed_at_end = 0.6F;
            cell.is_second_half = beat % 2 == 1;
            graph.cells.push_back(cell);
        }
    }
    graph.beat_seconds = dance.takes.front().learnt_tempo.seconds_per_beat();
    const CounterRandom random(1);
    std::uint64_t draw = 0;
    const std::uint64_t count = graph.cells.size();
    for (const Cell& from : graph.cells) {
        graph.first_arc.push_back(static_cast<std::uint32_t>(graph.arcs.size()));
        for (std::uint64_t arc = 0; arc < kArcsEach;) {
            const auto to = static_cast<std::uint16_t>(random.below(draw++, count));
            if (graph.cells[to].is_second_half != from.is_second_half) {
                graph.arcs.push_back({to, arc % 2 == 1, 5.0F + static_cast<float>(arc)});
                ++arc;
            }
        }
    }
    graph.first_arc.push_back(static_cast<std::uint32_t>(graph.arcs.size()));
    sort_energies(graph);
    return dance;
}

}  // namespace

const CellDance& salsa_cells() {
    static const CellDance dance = [] {
        CellDance made = unmeasured_cells();
        const DanceContent content = solved(made);
        int halves = 0;
        for (Cell& cell : made.graph.cells) {
            Pose from;
            Pose to;
            const FigurePassage& take = content.figures[cell.take].passages.front();
            take.at(cell.beat, from);
            take.at(cell.beat + 1, to);
            const FloorMove move = inverse(floor_frame(from)) * floor_frame(to);
            cell.turn = static_cast<float>(std::remainder(move.heading, 2.0 * M_PI));
            cell.way = glm::vec2(move.offset);
            if (cell.is_second_half && halves++ % 3 == 0) {
                cell.stands_at_end = true;
                cell.speed_at_end = 0.1F;
            }
        }
        return made;
    }();
    return dance;
}

const DanceContent& salsa_cell_content() {
    static const DanceContent content = solved(salsa_cells());
    return content;
}

std::shared_ptr<const DanceLibrary> salsa_cell_library(const Skeleton& body) {
    auto library = DanceLibrary::build(salsa_cells(), body);
    EXPECT_TRUE(library) << library.error().message;
    return *library;
}

}  // namespace raks::motion::test
