#include "training/cells/cell_repeats.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

namespace raks::motion {
namespace {

CellSource mirror_of(const CellSource& cell) {
    CellSource image = cell;
    image.start = mirrored(cell.start);
    image.end = mirrored(cell.end);
    for (TakeMoment& moment : image.course) {
        moment = mirrored(moment);
    }
    return image;
}

// Whether two courses are nearer than `farthest` on the mean, and nowhere much farther: else cells
// that only end alike would pass.
bool run_alike(const CellSource& a, const CellSource& b, double farthest) {
    constexpr double kMoments = 2.0 + static_cast<double>(std::tuple_size_v<decltype(a.course)>);
    constexpr double kAnywhere = 1.5;
    double sum = 0.0;
    const auto is_close = [&](const TakeMoment& one, const TakeMoment& other) {
        const double apart = distance(one, other);
        sum += apart;
        return apart < kAnywhere * farthest;
    };
    return is_close(a.start, b.start) && is_close(a.end, b.end) &&
           std::equal(a.course.begin(), a.course.end(), b.course.begin(), is_close) &&
           sum < kMoments * farthest;
}

// Which pairs of cells agree, as they are and mirrored.
class AgreeingCells {
 public:
    AgreeingCells(std::span<const CellSource> cells, double farthest)
        : count_(cells.size()), agrees_(2 * count_ * count_) {
        std::vector<CellSource> images;
        images.reserve(count_);
        std::transform(cells.begin(), cells.end(), std::back_inserter(images), mirror_of);
        for (std::size_t a = 0; a < count_; ++a) {
            for (std::size_t b = a + 1; b < count_; ++b) {
                const Cell& own = cells[a].cell;
                const Cell& other = cells[b].cell;
                const bool is_beside = own.take == other.take && other.beat - own.beat < 2;
                if (is_beside || own.is_second_half != other.is_second_half) {
                    continue;
                }
                for (const bool is_mirrored : {false, true}) {
                    const CellSource& image = is_mirrored ? images[b] : cells[b];
                    const bool agrees = run_alike(cells[a], image, farthest);
                    agrees_[index(a, b, is_mirrored)] = agrees;
                    agrees_[index(b, a, is_mirrored)] = agrees;
                }
            }
        }
    }
    [[nodiscard]] bool operator()(std::size_t a, std::size_t b, bool is_mirrored) const {
        return agrees_[index(a, b, is_mirrored)];
    }

 private:
    [[nodiscard]] std::size_t index(std::size_t a, std::size_t b, bool is_mirrored) const {
        return 2 * (a * count_ + b) + (is_mirrored ? 1U : 0U);
    }

    std::size_t count_;
    std::vector<bool> agrees_;
};

// Cells a, a + 1, ... that agree with b, b + 1, ...
struct AgreeingRun {
    std::size_t a = 0;
    std::size_t b = 0;
    bool is_mirrored = false;
    std::size_t length = 0;
};

// All runs that are as long as they can be, the longest first.
std::vector<AgreeingRun> runs_of(std::span<const CellSource> cells,
                                 const AgreeingCells& agree,
                                 std::size_t shortest) {
    std::vector<AgreeingRun> runs;
    for (std::size_t a = 0; a < cells.size(); ++a) {
        for (std::size_t b = a + 1; b < cells.size(); ++b) {
            for (const bool is_mirrored : {false, true}) {
                const bool began_before = a > 0 && goes_on(cells, a - 1) && goes_on(cells, b - 1) &&
                                          agree(a - 1, b - 1, is_mirrored);
                if (began_before || !agree(a, b, is_mirrored)) {
                    continue;
                }
                std::size_t length = 1;
                while (goes_on(cells, a + length - 1) && goes_on(cells, b + length - 1) &&
                       agree(a + length, b + length, is_mirrored)) {
                    ++length;
                }
                if (length >= shortest) {
                    runs.push_back({a, b, is_mirrored, length});
                }
            }
        }
    }
    std::stable_sort(runs.begin(), runs.end(), [](const AgreeingRun& x, const AgreeingRun& y) {
        return x.length > y.length;
    });
    return runs;
}

// Groups of cells that all agree with each other; each cell begins in one of its own.
class RepeatGroups {
 public:
    explicit RepeatGroups(std::size_t cells) : members_(cells), group_(cells) {
        std::iota(group_.begin(), group_.end(), std::size_t{0});
        for (std::size_t cell = 0; cell < cells; ++cell) {
            members_[cell].push_back({cell, false});
        }
    }
    // Makes the groups of both cells one, if all their members agree.
    void merge(std::size_t a, std::size_t b, bool is_mirrored, const AgreeingCells& agree) {
        const std::size_t into = group_[a];
        const std::size_t from = group_[b];
        if (into == from) {
            return;
        }
        // Of members of `from` against those of `into`.
        const bool flip = (side_of(a) != side_of(b)) != is_mirrored;
        for (const TiedCell& one : members_[into]) {
            for (const TiedCell& other : members_[from]) {
                if (!agree(one.cell, other.cell, (one.is_mirrored != other.is_mirrored) != flip)) {
                    return;
                }
            }
        }
        for (const TiedCell& other : members_[from]) {
            group_[other.cell] = into;
            members_[into].push_back({other.cell, other.is_mirrored != flip});
        }
        members_[from].clear();
    }
    [[nodiscard]] const CellRepeats& members(std::size_t cell) const {
        return members_[group_[cell]];
    }
    // Leaves a cell alone again.
    void release(std::size_t cell) {
        CellRepeats& old = members_[group_[cell]];
        old.erase(std::find_if(
            old.begin(), old.end(), [&](const TiedCell& member) { return member.cell == cell; }));
        members_.push_back({{cell, false}});
        group_[cell] = members_.size() - 1;
    }
    [[nodiscard]] bool is_tied(std::size_t cell) const { return members(cell).size() > 1; }

 private:
    [[nodiscard]] bool side_of(std::size_t cell) const {
        const CellRepeats& own = members(cell);
        return std::find_if(own.begin(),
                            own.end(),
                            [&](const TiedCell& member) { return member.cell == cell; })
            ->is_mirrored;
    }

    std::vector<CellRepeats> members_;
    std::vector<std::size_t> group_;  // by cell
};

// Lets go of cells of which too few in a row are tied, until none is.
void release_short_runs(std::span<const CellSource> cells,
                        std::size_t shortest,
                        RepeatGroups& groups) {
    for (bool has_changed = true; has_changed;) {
        has_changed = false;
        for (std::size_t first = 0; first < cells.size();) {
            if (!groups.is_tied(first)) {
                ++first;
                continue;
            }
            std::size_t end = first + 1;
            while (goes_on(cells, end - 1) && groups.is_tied(end)) {
                ++end;
            }
            for (std::size_t cell = first; end - first < shortest && cell < end; ++cell) {
                groups.release(cell);
                has_changed = true;
            }
            first = end;
        }
    }
}

}  // namespace

bool goes_on(std::span<const CellSource> cells, std::size_t cell) noexcept {
    return cell + 1 < cells.size() && cells[cell].cell.take == cells[cell + 1].cell.take &&
           cells[cell].cell.beat + 1 == cells[cell + 1].cell.beat;
}

std::vector<CellRepeats> find_cell_repeats(std::span<const CellSource> cells,
                                           const TieOptions& options) {
    if (!(options.farthest > 0.0)) {
        return {};
    }
    const AgreeingCells agree(cells, options.farthest);
    RepeatGroups groups(cells.size());
    for (const AgreeingRun& run : runs_of(cells, agree, options.shortest_run)) {
        for (std::size_t i = 0; i < run.length; ++i) {
            groups.merge(run.a + i, run.b + i, run.is_mirrored, agree);
        }
    }
    release_short_runs(cells, options.shortest_run, groups);
    std::vector<CellRepeats> repeats;
    std::vector<bool> is_done(cells.size());
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        if (is_done[cell] || !groups.is_tied(cell)) {
            continue;
        }
        CellRepeats own = groups.members(cell);
        std::sort(own.begin(), own.end(), [](const TiedCell& a, const TiedCell& b) {
            return a.cell < b.cell;
        });
        const bool flip = own.front().is_mirrored;
        for (TiedCell& member : own) {
            is_done[member.cell] = true;
            member.is_mirrored = member.is_mirrored != flip;
        }
        repeats.push_back(std::move(own));
    }
    return repeats;
}

}  // namespace raks::motion
