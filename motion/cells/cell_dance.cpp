#include "motion/cells/cell_dance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace raks::motion {
namespace {

bool is_sound(float value, float most) noexcept { return std::abs(value) <= most; }

Expected<void> check_cell(const CellGraph& graph, std::size_t i) {
    constexpr float kMost = 100.0F;  // metres, radians, metres a second: far beyond any dance
    const Cell& cell = graph.cells[i];
    if (cell.take >= graph.takes.size() || cell.beat + 1 > graph.takes[cell.take].beats) {
        return fail(fmt::format(
            "cells[{}] is beat {} of take {}, which there is not", i, cell.beat, cell.take));
    }
    for (const float value : {cell.energy, cell.turn, cell.way.x, cell.way.y, cell.speed_at_end}) {
        if (!is_sound(value, kMost)) {
            return fail(
                fmt::format("cells[{}] has a value of {}, must lie within +-{}", i, value, kMost));
        }
    }
    for (const float landing : cell.landings) {
        if (landing != Cell::kNoLanding && !is_sound(landing, 0.5F)) {
            return fail(fmt::format(
                "cells[{}] has a landing at {} beats, must lie within +-0.5 or be 2", i, landing));
        }
    }
    if (i > 0 && std::pair(graph.cells[i - 1].take, graph.cells[i - 1].beat) >=
                     std::pair(cell.take, cell.beat)) {
        return fail(fmt::format("cells[{}] does not come after the cell before it", i));
    }
    if (graph.arcs_of(i).empty() && !graph.has_successor(i)) {
        return fail(fmt::format("nothing follows cells[{}]", i));
    }
    return {};
}

// Whether a foot stands when it has landed: at the top of a kick it is as slow as on the floor.
bool stands_after(const FigureModel& take, std::size_t side, const Cell& cell) {
    constexpr double kSoon = 0.15;  // beats
    const std::vector<double>& chances = take.contact[side];
    if (chances.empty()) {
        return false;
    }
    const double beat = cell.beat + static_cast<double>(cell.landings[side]);
    const auto bin = [&](double at) {
        const double last = static_cast<double>(chances.size()) - 1.0;
        return static_cast<std::ptrdiff_t>(std::clamp(at * kContactBinsPerBeat, 0.0, last));
    };
    return std::any_of(chances.begin() + bin(beat),
                       chances.begin() + bin(beat + kSoon) + 1,
                       [](double chance) { return chance > 0.5; });
}

}  // namespace

void sort_energies(CellGraph& graph) {
    std::vector<float> energies;
    for (const Cell& cell : graph.cells) {
        energies.push_back(cell.energy);
    }
    std::sort(energies.begin(), energies.end());
    for (std::size_t i = 0; i < graph.energies.size(); ++i) {
        graph.energies[i] = energies[i * (energies.size() - 1) / (graph.energies.size() - 1)];
    }
}

void give_landings(CellDance& dance) {
    // Of figures, only landings that so many repeats share are aimed at. What one dancer did once
    // is what a take shall do.
    constexpr int kShared = 3;
    for (FigureModel& take : dance.takes) {
        take.repeats = kShared;
        for (auto& landings : take.landings) {
            landings.assign(static_cast<std::size_t>(take.beats), {});
        }
    }
    for (const Cell& cell : dance.graph.cells) {
        for (std::size_t side = 0; side < cell.landings.size(); ++side) {
            if (cell.landings[side] != Cell::kNoLanding &&
                stands_after(dance.takes[cell.take], side, cell)) {
                dance.takes[cell.take].landings[side][cell.beat] = {
                    kShared, Beats(static_cast<double>(cell.landings[side])), Beats(0.0)};
            }
        }
    }
}

Expected<void> validate(const CellGraph& graph) {
    if (graph.cells.empty() || graph.cells.size() > kMostCells || graph.takes.empty()) {
        return fail(
            fmt::format("there are {} cells of {} takes, must be 1 to {} of at least one take",
                        graph.cells.size(),
                        graph.takes.size(),
                        kMostCells));
    }
    if (graph.first_arc.size() != graph.cells.size() + 1 || graph.first_arc.front() != 0 ||
        graph.first_arc.back() != graph.arcs.size() ||
        !std::is_sorted(graph.first_arc.begin(), graph.first_arc.end())) {
        return fail("first_arc does not divide the arcs among the cells");
    }
    if (!(graph.beat_seconds >= 0.1 && graph.beat_seconds <= 3.0)) {
        return fail(fmt::format("beat_seconds is {}, must lie in [0.1, 3]", graph.beat_seconds));
    }
    for (std::size_t i = 0; i < graph.arcs.size(); ++i) {
        if (graph.arcs[i].to >= graph.cells.size() || !is_sound(graph.arcs[i].distance, 1e6F)) {
            return fail(fmt::format("arcs[{}] leads nowhere", i));
        }
    }
    for (std::size_t i = 0; i < graph.cells.size(); ++i) {
        if (auto ok = check_cell(graph, i); !ok) {
            return ok;
        }
    }
    return {};
}

}  // namespace raks::motion
