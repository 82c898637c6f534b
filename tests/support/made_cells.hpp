// A dance of cells that a test makes: no take of a person need be at hand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "motion/cells/cell_dance.hpp"

namespace raks::motion::test {

/// One take of 8 beats, made of the basic step of salsa as Raks ships it (`models`:
/// its folder models/trained), and six cells in a ring, to be written to a file: what is read
/// from there passes validate(). `energy`: of all cells.
[[nodiscard]] inline CellDance made_cells(const std::string& models,
                                          const std::string& dance,
                                          float energy = 0.5F) {
    const auto text = read_file(models + "/salsa_basic_lead.json");
    auto figure = text ? parse_figure(*text, "salsa_basic_lead.json") : fail(text.error());
    if (!figure) {
        throw std::runtime_error(figure.error().message);
    }
    CellDance made;
    made.dance = dance;
    made.licence = "made by a test";
    FigureModel& take = made.takes.emplace_back(std::move(*figure));
    take.name = "made_0";
    take.dance = dance;
    for (auto& chances : take.contact) {
        chances.assign(static_cast<std::size_t>(kContactBinsPerBeat * take.beats), 1.0);
    }
    const auto wanted = static_cast<std::size_t>(kStatesPerBeat * take.beats);
    for (PartModel& part : take.parts) {
        const std::vector<FigureState> states = part.states;
        part.states.clear();
        for (std::size_t k = 0; k < wanted; ++k) {
            part.states.push_back(states[k * states.size() / wanted]);
        }
    }
    CellGraph& graph = made.graph;
    graph.takes.push_back({take.name, take.beats});
    for (std::uint16_t beat = 1; beat < 7; ++beat) {
        Cell cell;
        cell.beat = beat;
        cell.energy = energy;
        cell.is_second_half = beat % 2 == 0;
        graph.cells.push_back(cell);
        graph.first_arc.push_back(0);
    }
    graph.first_arc.push_back(1);
    graph.arcs.push_back({0, true, 9.0F});
    sort_energies(graph);
    return made;
}

}  // namespace raks::motion::test
