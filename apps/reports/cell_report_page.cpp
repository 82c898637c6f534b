#include "apps/reports/cell_report_page.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include "apps/reports/chart.hpp"
#include "apps/reports/web_page.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using motion::Cell;
using motion::CellDance;
using motion::CellGraph;
using motion::CellSurvey;

constexpr double kTakeWidth = 1190.0;   // of a take's chart, pixels
constexpr std::size_t kMostTakes = 40;  // of the table of arcs between takes

std::string percent_of(std::size_t part, std::size_t whole) {
    return whole == 0 ? std::string("-")
                      : fmt::format("{:.0f} %",
                                    100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string row(std::string_view what, const std::string& value) {
    return fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", what, value);
}

// "31, at most 6 beats away (mean 2.3)".
std::string text_of(const CellSurvey::Kind& kind) {
    if (kind.cells == 0) {
        return "none";
    }
    std::string text = fmt::format("{}; from the others it takes {:.1f} beats, at most {}",
                                   kind.cells,
                                   kind.mean_beats,
                                   kind.farthest);
    if (kind.far + kind.cut_off > 0) {
        text += fmt::format("; {} cells need more than {} or have no way",
                            kind.far + kind.cut_off,
                            motion::kBeatsToKind);
    }
    return text;
}

std::string overview(const CellDance& dance, const CellSurvey& survey) {
    const CellGraph& graph = dance.graph;
    int beats = 0;
    for (const motion::CellTake& take : graph.takes) {
        beats += take.beats;
    }
    const std::size_t cells = graph.cells.size();
    return "<table><tbody>\n" + row("cells", fmt::format("{} of {} labelled beats", cells, beats)) +
           row("states",
               fmt::format("{}: {} a beat, of each part of the body",
                           motion::kStatesPerBeat * beats,
                           motion::kStatesPerBeat)) +
           row("arcs",
               fmt::format("{}: {:.1f} a cell, at most {}; {} cells have none",
                           graph.arcs.size(),
                           static_cast<double>(graph.arcs.size()) / static_cast<double>(cells),
                           survey.most_arcs,
                           survey.without)) +
           row("reach each other",
               fmt::format("{} ({})", survey.connected, percent_of(survey.connected, cells))) +
           row("a take ends after", fmt::format("{} cells", survey.ends)) +
           row("rests", text_of(survey.rest)) + row("endings", text_of(survey.ending)) +
           row("the greatest tenth", text_of(survey.greatest)) +
           row("tempo", fmt::format("{:.0f} BPM", 60.0 / graph.beat_seconds)) +
           row("licence of the takes",
               dance.licence.empty() ? std::string("none is given") : xml_text(dance.licence)) +
           "</tbody></table>\n";
}

// Cells by how far apart the moments are that arcs join.
std::string distances(const CellSurvey& survey) {
    const std::size_t most = *std::max_element(survey.distances.begin(), survey.distances.end());
    Chart chart({.width = 560.0,
                 .height = 180.0,
                 .x = {0.0, static_cast<double>(CellSurvey::kSteps)},
                 .y = {0.0, static_cast<double>(std::max<std::size_t>(most, 1))},
                 .x_label = "distance of the moments that an arc joins"});
    chart.grid_y(4);
    for (std::size_t i = 0; i < CellSurvey::kSteps; ++i) {
        const auto left = static_cast<double>(i);
        chart.tick_x(left, fmt::format("{:g}", CellSurvey::kStep * left));
        chart.box({left + 0.08, 0.0},
                  {left + 0.92, static_cast<double>(survey.distances[i])},
                  "fill=\"#2563eb\"");
    }
    return "<h2>How alike the joined moments are</h2>\n" + chart.svg();
}

std::string takes_table(const CellGraph& graph, const CellSurvey& survey) {
    std::string table =
        "<h2>Takes</h2>\n<table><thead><tr><th>take</th><th>beats</th><th>cells</th>"
        "<th>arcs that leave</th><th>that arrive</th><th>of these from itself</th>"
        "<th>mean energy, m/s</th><th>rests</th></tr></thead><tbody>\n";
    for (std::size_t take = 0; take < graph.takes.size(); ++take) {
        std::size_t cells = 0;
        std::size_t rests = 0;
        double energy = 0.0;
        for (std::size_t i = 0; i < graph.cells.size(); ++i) {
            if (graph.cells[i].take == take) {
                ++cells;
                energy += static_cast<double>(graph.cells[i].energy);
                rests += is_rest(graph, i) ? 1U : 0U;
            }
        }
        std::size_t leave = 0;
        std::size_t arrive = 0;
        for (std::size_t other = 0; other < graph.takes.size(); ++other) {
            leave += survey.between[take][other];
            arrive += survey.between[other][take];
        }
        table += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
            "<td>{}</td></tr>\n",
            xml_text(graph.takes[take].name),
            graph.takes[take].beats,
            cells,
            leave,
            arrive,
            survey.between[take][take],
            cells == 0 ? std::string("-")
                       : fmt::format("{:.2f}", energy / static_cast<double>(cells)),
            rests);
    }
    return table + "</tbody></table>\n";
}

// Rows lead, columns are led to.
std::string between_table(const CellGraph& graph, const CellSurvey& survey) {
    const std::size_t takes = std::min(graph.takes.size(), kMostTakes);
    std::string table =
        "<h2>Arcs from take to take</h2>\n<p>Rows: where an arc leaves; columns: where it leads, "
        "by the number of the row.</p>\n<table><thead><tr><th>take</th>";
    for (std::size_t to = 0; to < takes; ++to) {
        table += fmt::format("<th>{}</th>", to + 1);
    }
    table += "</tr></thead><tbody>\n";
    for (std::size_t from = 0; from < takes; ++from) {
        table += fmt::format("<tr><td>{} {}</td>", from + 1, xml_text(graph.takes[from].name));
        for (std::size_t to = 0; to < takes; ++to) {
            const std::size_t arcs = survey.between[from][to];
            table += fmt::format("<td class=\"{}\">{}</td>",
                                 arcs == 0    ? "none"
                                 : from == to ? "own"
                                              : "",
                                 arcs);
        }
        table += "</tr>\n";
    }
    table += "</tbody></table>\n";
    if (takes < graph.takes.size()) {
        table += fmt::format("<p>The first {} of {} takes.</p>\n", takes, graph.takes.size());
    }
    return table;
}

// The energy of a take's cells over its beats, how many arcs leave each, and where it rests.
std::string take_chart(const CellGraph& graph, std::size_t take, std::size_t most_arcs) {
    const double greatest = std::max(1e-3, static_cast<double>(graph.energies.back()));
    const auto beats = static_cast<double>(graph.takes[take].beats);
    // The names of the colours stand above all charts.
    Chart chart({.width = kTakeWidth,
                 .height = 120.0,
                 .x = {0.0, beats},
                 .y = {0.0, 1.15 * greatest},
                 .x_label = "beats of the take",
                 .top = 4.0});
    chart.grid_y(3);
    for (double beat = 0.0; beat <= beats; beat += 4.0) {
        chart.tick_x(beat, fmt::format("{:g}", beat));
    }
    for (std::size_t i = 0; i < graph.cells.size(); ++i) {
        const Cell& cell = graph.cells[i];
        if (cell.take != take) {
            continue;
        }
        const double beat = cell.beat;
        chart.box({beat + 0.1, 0.0},
                  {beat + 0.9, static_cast<double>(cell.energy)},
                  is_greatest(graph, i) ? "fill=\"#dc2626\"" : "fill=\"#93c5fd\"");
        const double arcs = static_cast<double>(graph.arcs_of(i).size()) /
                            static_cast<double>(std::max<std::size_t>(most_arcs, 1));
        chart.dot({beat + 1.0, greatest * arcs}, 2.6, "fill=\"#1e3a8a\"");
        if (is_rest(graph, i)) {
            chart.mark({beat + 1.0, 1.15 * greatest},
                       12.0,
                       "#16a34a",
                       is_ending(graph, i) ? "end" : "hold");
        }
    }
    return chart.svg();
}

std::string take_charts(const CellGraph& graph, const CellSurvey& survey) {
    std::string section = fmt::format(
        "<h2>Cells</h2>\n<p>Bars: the energy of each cell, metres a second (red: the greatest "
        "tenth). Dots: arcs that leave as the cell ends; at the height of the highest bar there "
        "are {}. A gap: a beat that is no cell.</p>\n",
        survey.most_arcs);
    for (std::size_t take = 0; take < graph.takes.size(); ++take) {
        section += fmt::format("<h3>{}</h3>\n{}\n",
                               xml_text(graph.takes[take].name),
                               take_chart(graph, take, survey.most_arcs));
    }
    return section;
}

}  // namespace

std::string draw_cell_report(const CellDance& dance, const CellSurvey& survey) {
    return web_page("How " + dance.dance + " hangs together",
                    "<p class=\"sub\">A dance of whole takes: beats of people as cells of hidden "
                    "Markov states, joined where one ends as another begins.</p>\n" +
                        overview(dance, survey) + takes_table(dance.graph, survey) +
                        between_table(dance.graph, survey) + distances(survey) +
                        take_charts(dance.graph, survey));
}

}  // namespace raks::apps
