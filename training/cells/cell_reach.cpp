#include "training/cells/cell_reach.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace raks::motion {
namespace {

using CellLists = std::vector<std::vector<std::size_t>>;

// By cell, what it leads to along arcs and successors; `backwards`: what leads to it.
CellLists neighbours_of(const CellGraph& graph, bool backwards) {
    CellLists lists(graph.cells.size());
    const auto add = [&](std::size_t from, std::size_t to) {
        backwards ? lists[to].push_back(from) : lists[from].push_back(to);
    };
    for (std::size_t from = 0; from < graph.cells.size(); ++from) {
        for (const CellArc& arc : graph.arcs_of(from)) {
            add(from, arc.to);
        }
        if (graph.has_successor(from)) {
            add(from, from + 1);
        }
    }
    return lists;
}

// Cells in the order in which a walk from each in turn leaves them for good.
std::vector<std::size_t> leaving_order(const CellLists& ahead) {
    std::vector<std::size_t> order;
    std::vector<bool> is_seen(ahead.size());
    std::vector<std::pair<std::size_t, std::size_t>> open;  // cell, its next neighbour
    for (std::size_t first = 0; first < ahead.size(); ++first) {
        if (is_seen[first]) {
            continue;
        }
        is_seen[first] = true;
        open.emplace_back(first, 0);
        while (!open.empty()) {
            auto& [cell, next] = open.back();
            if (next == ahead[cell].size()) {
                order.push_back(cell);
                open.pop_back();
                continue;
            }
            const std::size_t to = ahead[cell][next++];
            if (!is_seen[to]) {
                is_seen[to] = true;
                open.emplace_back(to, 0);
            }
        }
    }
    return order;
}

// The cells from which one of `goals` is at most kBeatsToKind beats away.
std::vector<bool> near_to(const std::vector<bool>& goals, const CellLists& behind) {
    std::vector<bool> is_close = goals;
    std::vector<std::size_t> edge;
    for (std::size_t cell = 0; cell < goals.size(); ++cell) {
        if (goals[cell]) {
            edge.push_back(cell);
        }
    }
    for (int beat = 0; beat < kBeatsToKind; ++beat) {
        std::vector<std::size_t> next;
        for (const std::size_t cell : edge) {
            for (const std::size_t from : behind[cell]) {
                if (!is_close[from]) {
                    is_close[from] = true;
                    next.push_back(from);
                }
            }
        }
        edge = std::move(next);
    }
    return is_close;
}

// A graph's cells that stay, renumbered. `origins`: by cell, its number in the whole graph.
CellGraph part_of_graph(const CellGraph& graph,
                        const std::vector<bool>& stays,
                        std::vector<std::size_t>& origins) {
    CellGraph part;
    part.takes = graph.takes;
    part.beat_seconds = graph.beat_seconds;
    std::vector<std::uint16_t> numbers(graph.cells.size());
    std::vector<std::size_t> left;
    for (std::size_t cell = 0; cell < graph.cells.size(); ++cell) {
        numbers[cell] = static_cast<std::uint16_t>(part.cells.size());
        if (stays[cell]) {
            part.cells.push_back(graph.cells[cell]);
            left.push_back(origins[cell]);
        }
    }
    for (std::size_t cell = 0; cell < graph.cells.size(); ++cell) {
        if (!stays[cell]) {
            continue;
        }
        part.first_arc.push_back(static_cast<std::uint32_t>(part.arcs.size()));
        for (CellArc arc : graph.arcs_of(cell)) {
            if (stays[arc.to]) {
                arc.to = numbers[arc.to];
                part.arcs.push_back(arc);
            }
        }
    }
    part.first_arc.push_back(static_cast<std::uint32_t>(part.arcs.size()));
    origins = std::move(left);
    return part;
}

// Takes the cells that are far from a kind out of `stays`. Returns whether the rule holds.
template <class Kind>
bool keep_near(const CellGraph& graph,
               const CellLists& behind,
               const Kind& is_kind,
               std::vector<bool>& stays) {
    std::vector<bool> goals(graph.cells.size());
    for (std::size_t cell = 0; cell < goals.size(); ++cell) {
        goals[cell] = is_kind(graph, cell);
    }
    if (std::find(goals.begin(), goals.end(), true) == goals.end()) {
        return false;
    }
    const std::vector<bool> is_close = near_to(goals, behind);
    if (2 * std::count(is_close.begin(), is_close.end(), true) < std::ssize(is_close)) {
        return false;
    }
    for (std::size_t cell = 0; cell < stays.size(); ++cell) {
        stays[cell] = stays[cell] && is_close[cell];
    }
    return true;
}

bool has_gaps(const std::vector<bool>& stays) {
    return std::find(stays.begin(), stays.end(), false) != stays.end();
}

}  // namespace

// Kosaraju's two passes.
std::vector<bool> largest_part(const CellGraph& graph) {
    const CellLists behind = neighbours_of(graph, true);
    const std::vector<std::size_t> order = leaving_order(neighbours_of(graph, false));
    constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    std::vector<std::size_t> part(graph.cells.size(), kNone);
    std::vector<std::size_t> sizes;
    for (auto root = order.rbegin(); root != order.rend(); ++root) {
        if (part[*root] != kNone) {
            continue;
        }
        const std::size_t number = sizes.size();
        sizes.push_back(0);
        std::vector<std::size_t> open = {*root};
        part[*root] = number;
        while (!open.empty()) {
            const std::size_t cell = open.back();
            open.pop_back();
            ++sizes[number];
            for (const std::size_t from : behind[cell]) {
                if (part[from] == kNone) {
                    part[from] = number;
                    open.push_back(from);
                }
            }
        }
    }
    std::vector<bool> stays(graph.cells.size());
    std::size_t best = kNone;
    for (const std::size_t number : part) {
        best = best == kNone || sizes[number] > sizes[best] ? number : best;
    }
    for (std::size_t cell = 0; cell < stays.size(); ++cell) {
        stays[cell] = part[cell] == best;
    }
    return stays;
}

ReachedCells reached_cells(CellGraph whole) {
    ReachedCells result;
    result.fates.assign(whole.cells.size(), CellFate::stays);
    std::vector<std::size_t> origins(whole.cells.size());
    std::iota(origins.begin(), origins.end(), std::size_t{0});
    result.graph = std::move(whole);
    const auto leave_out = [&](const std::vector<bool>& stays, CellFate fate) {
        for (std::size_t cell = 0; cell < stays.size(); ++cell) {
            if (!stays[cell]) {
                result.fates[origins[cell]] = fate;
            }
        }
        result.graph = part_of_graph(result.graph, stays, origins);
    };
    while (!result.graph.cells.empty()) {
        leave_out(largest_part(result.graph), CellFate::apart);
        sort_energies(result.graph);
        const CellLists behind = neighbours_of(result.graph, true);
        std::vector<bool> stays(result.graph.cells.size(), true);
        result.has_rests = keep_near(result.graph, behind, is_rest, stays);
        result.has_endings = keep_near(result.graph, behind, is_ending, stays);
        result.has_greatest = keep_near(result.graph, behind, is_greatest, stays);
        if (!has_gaps(stays)) {
            break;
        }
        leave_out(stays, CellFate::far);
    }
    return result;
}

}  // namespace raks::motion
