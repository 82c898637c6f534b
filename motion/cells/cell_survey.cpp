#include "motion/cells/cell_survey.hpp"

#include <algorithm>
#include <utility>

namespace raks::motion {
namespace {

using Ways = std::vector<std::vector<std::size_t>>;

// Where a dance may go on after each cell; `backwards`: from where it may have come.
Ways ways_of(const CellGraph& graph, bool backwards) {
    Ways ways(graph.cells.size());
    const auto add = [&](std::size_t from, std::size_t to) {
        ways[backwards ? to : from].push_back(backwards ? from : to);
    };
    for (std::size_t i = 0; i < graph.cells.size(); ++i) {
        if (graph.has_successor(i)) {
            add(i, i + 1);
        }
        for (const CellArc& arc : graph.arcs_of(i)) {
            add(i, arc.to);
        }
    }
    return ways;
}

constexpr int kNever = -1;

// Beats from each cell along `ways` to the first of those where it begins; kNever: none is reached.
std::vector<int> beats_from(const std::vector<std::size_t>& begin, const Ways& ways) {
    std::vector<int> beats(ways.size(), kNever);
    std::vector<std::size_t> open = begin;
    for (const std::size_t cell : begin) {
        beats[cell] = 0;
    }
    for (std::size_t next = 0; next < open.size(); ++next) {
        const std::size_t from = open[next];
        for (const std::size_t to : ways[from]) {
            if (beats[to] == kNever) {
                beats[to] = beats[from] + 1;
                open.push_back(to);
            }
        }
    }
    return beats;
}

std::size_t largest_connected(const Ways& ahead, const Ways& behind) {
    std::vector<bool> is_done(ahead.size());
    std::size_t most = 0;
    for (std::size_t first = 0; first < ahead.size(); ++first) {
        if (is_done[first]) {
            continue;
        }
        const std::vector<int> reached = beats_from({first}, ahead);
        const std::vector<int> reaches = beats_from({first}, behind);
        std::size_t both = 0;
        for (std::size_t i = 0; i < ahead.size(); ++i) {
            if (reached[i] != kNever && reaches[i] != kNever) {
                is_done[i] = true;
                ++both;
            }
        }
        most = std::max(most, both);
    }
    return most;
}

template <typename Is>
CellSurvey::Kind kind_of(const CellGraph& graph, const Ways& behind, const Is& is) {
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < graph.cells.size(); ++i) {
        if (is(graph, i)) {
            own.push_back(i);
        }
    }
    CellSurvey::Kind kind;
    kind.cells = own.size();
    if (own.empty()) {
        return kind;
    }
    int sum = 0;
    std::size_t others = 0;
    for (const int beats : beats_from(own, behind)) {
        if (beats == kNever) {
            ++kind.cut_off;
        } else if (beats > 0) {
            sum += beats;
            ++others;
            kind.farthest = std::max(kind.farthest, beats);
            kind.far += beats > kBeatsToKind ? 1U : 0U;
        }
    }
    kind.mean_beats = others > 0 ? static_cast<double>(sum) / static_cast<double>(others) : 0.0;
    return kind;
}

}  // namespace

CellSurvey survey(const CellGraph& graph) {
    const Ways ahead = ways_of(graph, false);
    const Ways behind = ways_of(graph, true);
    CellSurvey found;
    found.connected = largest_connected(ahead, behind);
    found.between.assign(graph.takes.size(), std::vector<std::size_t>(graph.takes.size()));
    for (std::size_t i = 0; i < graph.cells.size(); ++i) {
        const auto arcs = graph.arcs_of(i);
        found.ends += graph.has_successor(i) ? 0U : 1U;
        found.without += arcs.empty() ? 1U : 0U;
        found.most_arcs = std::max(found.most_arcs, arcs.size());
        for (const CellArc& arc : arcs) {
            ++found.between[graph.cells[i].take][graph.cells[arc.to].take];
            const double step = std::clamp(static_cast<double>(arc.distance) / CellSurvey::kStep,
                                           0.0,
                                           static_cast<double>(CellSurvey::kSteps - 1));
            ++found.distances[static_cast<std::size_t>(step)];
        }
    }
    found.rest = kind_of(graph, behind, is_rest);
    found.ending = kind_of(graph, behind, is_ending);
    found.greatest = kind_of(graph, behind, is_greatest);
    return found;
}

}  // namespace raks::motion
