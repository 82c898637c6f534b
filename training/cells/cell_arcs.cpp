#include "training/cells/cell_arcs.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace raks::motion {
namespace {

// Arcs by cell, while cells are still numbered as they came.
using ArcLists = std::vector<std::vector<CellArc>>;

// Whether `to` is the same moment as what follows `from` in its take, or one beside it.
bool is_near(const Cell& from, const Cell& to) noexcept {
    return from.take == to.take && std::abs(from.beat + 1 - to.beat) <= 1;
}

bool follows(const Cell& from, const Cell& to) noexcept {
    return from.take == to.take && from.beat + 1 == to.beat;
}

// The arcs of one cell, the nearest first. `images`: the starts of all cells, mirrored.
std::vector<CellArc> arcs_from(std::size_t from,
                               std::span<const CellSource> cells,
                               std::span<const TakeMoment> images,
                               const ArcOptions& options) {
    const Cell& own = cells[from].cell;
    std::vector<CellArc> arcs;
    for (std::size_t to = 0; to < cells.size(); ++to) {
        const Cell& next = cells[to].cell;
        if (from == to || is_near(own, next) || next.is_second_half == own.is_second_half) {
            continue;
        }
        const auto number = static_cast<std::uint16_t>(to);
        for (const auto& [start, is_mirrored] :
             {std::pair(&cells[to].start, false), std::pair(&images[to], true)}) {
            arcs.push_back(
                {number, is_mirrored, static_cast<float>(distance(cells[from].end, *start))});
        }
    }
    std::stable_sort(arcs.begin(), arcs.end(), [](const CellArc& a, const CellArc& b) {
        return a.distance < b.distance;
    });
    const bool has_successor = from + 1 < cells.size() && follows(own, cells[from + 1].cell);
    const auto far = std::find_if(arcs.begin(), arcs.end(), [&](const CellArc& arc) {
        return static_cast<double>(arc.distance) >= options.farthest;
    });
    // Where nothing else follows, the nearest one does, whatever its distance.
    const auto least = has_successor ? 0 : std::min<std::ptrdiff_t>(1, std::ssize(arcs));
    const auto near = std::max<std::ptrdiff_t>(far - arcs.begin(), least);
    arcs.resize(std::min(static_cast<std::size_t>(near), options.most_arcs));
    return arcs;
}

ArcLists arcs_of(std::span<const CellSource> cells, const ArcOptions& options) {
    std::vector<TakeMoment> images;
    for (const CellSource& cell : cells) {
        images.push_back(mirrored(cell.start));
    }
    ArcLists lists(cells.size());
    for (std::size_t from = 0; from < cells.size(); ++from) {
        lists[from] = arcs_from(from, cells, images, options);
    }
    return lists;
}

// What is reached from `first` along arcs and successors; `backwards`: from what it is reached.
std::vector<bool> reached(std::span<const CellSource> cells,
                          const ArcLists& lists,
                          std::size_t first,
                          bool backwards) {
    std::vector<std::vector<std::size_t>> next(cells.size());
    const auto add = [&](std::size_t from, std::size_t to) {
        backwards ? next[to].push_back(from) : next[from].push_back(to);
    };
    for (std::size_t from = 0; from < cells.size(); ++from) {
        for (const CellArc& arc : lists[from]) {
            add(from, arc.to);
        }
        if (from + 1 < cells.size() && follows(cells[from].cell, cells[from + 1].cell)) {
            add(from, from + 1);
        }
    }
    std::vector<bool> is_reached(cells.size());
    std::vector<std::size_t> open = {first};
    is_reached[first] = true;
    while (!open.empty()) {
        const std::size_t from = open.back();
        open.pop_back();
        for (const std::size_t to : next[from]) {
            if (!is_reached[to]) {
                is_reached[to] = true;
                open.push_back(to);
            }
        }
    }
    return is_reached;
}

// The largest set of cells that all reach each other. A mirrored cell and the cell itself are one
// here: what leads to one leads, mirrored, to the other.
std::vector<bool> largest_part(std::span<const CellSource> cells, const ArcLists& lists) {
    std::vector<bool> is_done(cells.size());
    std::vector<bool> best(cells.size());
    std::ptrdiff_t most = 0;
    for (std::size_t first = 0; first < cells.size(); ++first) {
        if (is_done[first]) {
            continue;
        }
        const std::vector<bool> ahead = reached(cells, lists, first, false);
        const std::vector<bool> behind = reached(cells, lists, first, true);
        std::vector<bool> both(cells.size());
        for (std::size_t i = 0; i < cells.size(); ++i) {
            both[i] = ahead[i] && behind[i];
            is_done[i] = is_done[i] || both[i];
        }
        const auto size = std::count(both.begin(), both.end(), true);
        if (size > most) {
            most = size;
            best = both;
        }
    }
    return best;
}

}  // namespace

CellArcs join_cells(std::span<const CellSource> cells, const ArcOptions& options) {
    const ArcLists lists = arcs_of(cells, options);
    const std::vector<bool> stays = largest_part(cells, lists);
    CellArcs result;
    std::vector<std::uint16_t> numbers(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        numbers[i] = static_cast<std::uint16_t>(result.graph.cells.size());
        if (stays[i]) {
            result.graph.cells.push_back(cells[i].cell);
        }
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!stays[i]) {
            continue;
        }
        result.graph.first_arc.push_back(static_cast<std::uint32_t>(result.graph.arcs.size()));
        for (CellArc arc : lists[i]) {
            if (stays[arc.to]) {
                arc.to = numbers[arc.to];
                result.graph.arcs.push_back(arc);
            }
        }
    }
    result.graph.first_arc.push_back(static_cast<std::uint32_t>(result.graph.arcs.size()));
    result.left_out = cells.size() - result.graph.cells.size();
    result.connected = cells.empty() ? 0.0
                                     : static_cast<double>(result.graph.cells.size()) /
                                           static_cast<double>(cells.size());
    return result;
}

}  // namespace raks::motion
