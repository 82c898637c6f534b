#pragma once

#include <cstdint>
#include <string>

#include "base/random.hpp"
#include "motion/cells/cell_dance.hpp"

namespace raks::motion::test {

/// Takes of `beats` cells each, joined at random: every cell has `arcs` arcs.
[[nodiscard]] inline CellGraph small_graph(int takes, int beats, int arcs, std::uint64_t seed = 1) {
    const CounterRandom random(seed);
    CellGraph graph;
    const auto count = static_cast<std::uint64_t>(takes * beats);
    std::uint64_t draw = 0;
    for (int take = 0; take < takes; ++take) {
        graph.takes.push_back({"take" + std::to_string(take), beats + 2});
        for (int beat = 0; beat < beats; ++beat) {
            Cell cell;
            cell.take = static_cast<std::uint16_t>(take);
            cell.beat = static_cast<std::uint16_t>(beat + 1);
            cell.energy = static_cast<float>(0.3 + random.uniform(draw++));
            cell.turn = static_cast<float>(0.6 * (random.uniform(draw++) - 0.5));
            cell.way.x = static_cast<float>(0.3 * (random.uniform(draw++) - 0.5));
            cell.way.y = static_cast<float>(0.3 * (random.uniform(draw++) - 0.5));
            cell.is_second_half = beat % 2 == 1;
            graph.cells.push_back(cell);
        }
    }
    for (std::uint64_t cell = 0; cell < count; ++cell) {
        graph.first_arc.push_back(static_cast<std::uint32_t>(graph.arcs.size()));
        for (int arc = 0; arc < arcs; ++arc) {
            const auto to = static_cast<std::uint16_t>(random.below(draw++, count));
            const bool is_mirrored = random.uniform(draw++) < 0.5;
            graph.arcs.push_back(
                {to, is_mirrored, static_cast<float>(6.0 + 12.0 * random.uniform(draw++))});
        }
    }
    graph.first_arc.push_back(static_cast<std::uint32_t>(graph.arcs.size()));
    sort_energies(graph);
    return graph;
}

}  // namespace raks::motion::test
