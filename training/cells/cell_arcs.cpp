#include "training/cells/cell_arcs.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

#include "base/parallel.hpp"
#include "training/cells/cell_reach.hpp"

namespace raks::motion {
namespace {

// Whether `to` is the same moment as what follows `from` in its take, or one beside it.
bool is_near(const Cell& from, const Cell& to) noexcept {
    return from.take == to.take && std::abs(from.beat + 1 - to.beat) <= 1;
}

bool follows(const Cell& from, const Cell& to) noexcept {
    return from.take == to.take && from.beat + 1 == to.beat;
}

// The arcs of one cell, the nearest first.
struct ArcsOfCell {
    std::vector<CellArc> near;
    std::vector<CellArc> more;  // that it could have besides
};

// `images`: the starts of all cells, mirrored.
ArcsOfCell arcs_from(std::size_t from,
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
    const auto count_within = [&](double limit) {
        const auto beyond = std::find_if(arcs.begin(), arcs.end(), [&](const CellArc& arc) {
            return static_cast<double>(arc.distance) >= limit;
        });
        return beyond - arcs.begin();
    };
    const auto near =
        std::min(count_within(options.farthest), static_cast<std::ptrdiff_t>(options.most_arcs));
    const auto all = std::max(near, count_within(options.widest));
    return {{arcs.begin(), arcs.begin() + near}, {arcs.begin() + near, arcs.begin() + all}};
}

CellGraph graph_of(std::span<const CellSource> cells, std::span<const ArcsOfCell> lists) {
    CellGraph graph;
    for (std::size_t from = 0; from < cells.size(); ++from) {
        graph.cells.push_back(cells[from].cell);
        graph.first_arc.push_back(static_cast<std::uint32_t>(graph.arcs.size()));
        graph.arcs.insert(graph.arcs.end(), lists[from].near.begin(), lists[from].near.end());
    }
    graph.first_arc.push_back(static_cast<std::uint32_t>(graph.arcs.size()));
    return graph;
}

// Adds arcs until the largest part of the cells reaches the others and they reach it, as far
// as there are such arcs.
class CellBridges {
 public:
    CellBridges(std::span<const CellSource> cells, std::span<ArcsOfCell> lists)
        : cells_(cells), lists_(lists), part_(largest_part(graph_of(cells, lists))) {}

    void build() {
        build_from(false);
        build_from(true);
    }

 private:
    struct Bridge {
        bool is_inside = true;  // of what was danced in a row, where its end would be better
        CellArc arc;
        std::size_t from = 0;
    };

    // `backwards`: cells that do not lead back to the part; else those that it does not reach.
    void build_from(bool backwards) {
        std::vector<bool> is_linked = part_;
        spread(backwards, is_linked);
        while (const auto bridge = nearest(backwards, is_linked)) {
            lists_[bridge->from].near.push_back(bridge->arc);
            is_linked[backwards ? bridge->from : bridge->arc.to] = true;
            spread(backwards, is_linked);
        }
    }

    // Adds what the linked cells reach, or are reached from.
    void spread(bool backwards, std::vector<bool>& is_linked) const {
        const auto link = [&](std::size_t from, std::size_t to) {
            const std::size_t known = backwards ? to : from;
            const std::size_t other = backwards ? from : to;
            const bool is_new = is_linked[known] && !is_linked[other];
            is_linked[other] = is_linked[other] || is_new;
            return is_new;
        };
        for (bool has_changed = true; has_changed;) {
            has_changed = false;
            for (std::size_t from = 0; from < cells_.size(); ++from) {
                for (const CellArc& arc : lists_[from].near) {
                    has_changed = link(from, arc.to) || has_changed;
                }
                if (has_next(from)) {
                    has_changed = link(from, from + 1) || has_changed;
                }
            }
        }
    }

    [[nodiscard]] std::optional<Bridge> nearest(bool backwards,
                                                const std::vector<bool>& is_linked) const {
        std::optional<Bridge> best;
        for (std::size_t from = 0; from < cells_.size(); ++from) {
            for (const CellArc& arc : lists_[from].more) {
                if (is_linked[from] == backwards || is_linked[arc.to] != backwards) {
                    continue;
                }
                const bool is_inside =
                    backwards ? has_next(from) : arc.to > 0 && has_next(arc.to - std::size_t{1});
                if (!best || std::pair(is_inside, arc.distance) <
                                 std::pair(best->is_inside, best->arc.distance)) {
                    best = {is_inside, arc, from};
                }
            }
        }
        return best;
    }

    [[nodiscard]] bool has_next(std::size_t cell) const {
        return cell + 1 < cells_.size() && follows(cells_[cell].cell, cells_[cell + 1].cell);
    }

    std::span<const CellSource> cells_;
    std::span<ArcsOfCell> lists_;
    std::vector<bool> part_;  // by cell
};

}  // namespace

JoinedCells join_cells(std::span<const CellSource> cells, const ArcOptions& options) {
    if (cells.empty()) {
        return {};
    }
    std::vector<TakeMoment> images;
    images.reserve(cells.size());
    for (const CellSource& cell : cells) {
        images.push_back(mirrored(cell.start));
    }
    std::vector<ArcsOfCell> lists(cells.size());
    run_parallel(cells.size(), options.threads, [&](std::size_t from) {
        lists[from] = arcs_from(from, cells, images, options);
    });
    JoinedCells joined;
    CellBridges(cells, lists).build();
    joined.graph = graph_of(cells, lists);
    joined.wide_joins = static_cast<std::size_t>(
        std::count_if(joined.graph.arcs.begin(), joined.graph.arcs.end(), [&](const CellArc& arc) {
            return static_cast<double>(arc.distance) >= options.farthest;
        }));
    return joined;
}

}  // namespace raks::motion
