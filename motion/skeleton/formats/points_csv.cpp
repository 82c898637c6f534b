#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "base/printable.hpp"
#include "motion/skeleton/formats/motion_limits.hpp"
#include "motion/skeleton/formats/points.hpp"
#include "motion/skeleton/formats/table_rows.hpp"
#include "motion/skeleton/text_lines.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kMostColumns = 4 * kMostJoints;
constexpr double kUnevenTimes = 0.25;  // of a step that times may differ without a word

// The separator of a head: the most frequent one.
char separator_of(std::string_view text) {
    const std::string_view head = text.substr(0, text.find_first_of("\r\n"));
    char best = ',';
    for (const char candidate : {'\t', ';', ','}) {
        if (std::count(head.begin(), head.end(), candidate) >
            std::count(head.begin(), head.end(), best)) {
            best = candidate;
        }
    }
    return best;
}

// The point and axis that a column is called by; none: another column.
struct PointColumn {
    std::string_view point;
    int axis = 0;
};
std::optional<PointColumn> point_column(std::string_view title) {
    if (title.size() < 3) {
        return std::nullopt;
    }
    const char letter = lower(title.substr(title.size() - 1))[0];
    const char before = title[title.size() - 2];
    if (letter < 'x' || letter > 'z' ||
        std::string_view("_.: -").find(before) == std::string::npos) {
        return std::nullopt;
    }
    return PointColumn{trimmed(title.substr(0, title.size() - 2)), letter - 'x'};
}

class PointTableReader {
 public:
    PointTableReader(std::string_view text, std::string_view name, std::optional<double> rate)
        : rows_(text, separator_of(text)), name_(name), rate_(rate) {}

    Expected<PointClip> read() {
        TableRow row;
        if (!rows_.next(row)) {
            return fail(name_ + ": is empty");
        }
        if (auto done = read_head(row); !done) {
            return fail(std::move(done.error()));
        }
        while (rows_.next(row)) {
            if (auto done = add_frame(row); !done) {
                return fail(std::move(done.error()));
            }
        }
        if (auto done = find_rate(); !done) {
            return fail(std::move(done.error()));
        }
        if (auto done = check_points(clip_); !done) {
            return fail(std::move(done.error()).in(name_));
        }
        return std::move(clip_);
    }

 private:
    tl::unexpected<Error> fault(const TableRow& row, const std::string& what) const {
        return fail(fmt::format("{}: line {}: {}", name_, row.number, what));
    }

    // Which columns hold what; each point needs all three of its axes.
    Expected<void> read_head(const TableRow& row) {
        if (row.cells.size() > kMostColumns) {
            return fault(row, fmt::format("more than {} columns", kMostColumns));
        }
        std::map<std::string, std::size_t> index;  // point by name
        std::vector<std::string> others;
        for (std::size_t column = 0; column < row.cells.size(); ++column) {
            const std::string_view title = row.cells[column];
            const std::string plain = lower(title);
            if (plain == "time" || plain == "time_s" || plain == "seconds" || plain == "t") {
                time_ = column;
                continue;
            }
            const auto found = point_column(title);
            if (!found) {
                others.push_back(printable(title, 30));
                continue;
            }
            const auto [at, is_new] =
                index.try_emplace(std::string(found->point), clip_.names.size());
            if (is_new) {
                clip_.names.emplace_back(found->point);
                columns_.push_back({kNone, kNone, kNone});
            }
            std::size_t& place = columns_[at->second][static_cast<std::size_t>(found->axis)];
            if (place != kNone) {
                return fault(row,
                             fmt::format("the column \"{}\" is there twice", printable(title, 40)));
            }
            place = column;
        }
        width_ = row.cells.size();
        return check_head(row, others);
    }

    Expected<void> check_head(const TableRow& row, const std::vector<std::string>& others) {
        if (clip_.names.empty()) {
            return fault(
                row,
                "has no columns of positions, which are called NAME_x, NAME_y, NAME_z (or NAME.x)");
        }
        for (std::size_t point = 0; point < columns_.size(); ++point) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (columns_[point][axis] == kNone) {
                    return fault(row,
                                 fmt::format("the point \"{}\" has no column for {}",
                                             printable(clip_.names[point], 40),
                                             std::string_view("xyz").substr(axis, 1)));
                }
            }
        }
        others_ = others;
        std::erase_if(others_, [](const std::string& title) {
            const std::string plain = lower(title);
            return plain == "frame" || plain == "frame#" || plain == "index" || plain.empty();
        });
        if (!others_.empty()) {
            clip_.warnings.push_back(
                fmt::format("{} columns that are not positions are left out: {}{}",
                            others_.size(),
                            others_[0],
                            others_.size() > 1 ? ", ..." : ""));
        }
        return {};
    }

    Expected<void> add_frame(const TableRow& row) {
        if (row.cells.size() != width_) {
            return fault(row, fmt::format("has {} cells for {} columns", row.cells.size(), width_));
        }
        if (time_ != kNone) {
            const auto time = number_of_cell(row.cells[time_]);
            if (!time || !std::isfinite(*time)) {
                return fault(row,
                             fmt::format("\"{}\" is not a time", printable(row.cells[time_], 40)));
            }
            if (!times_.empty() && *time <= times_.back()) {
                return fault(row,
                             fmt::format("the time {} does not come after the one before", *time));
            }
            times_.push_back(*time);
        }
        for (const auto& columns : columns_) {
            glm::dvec3 place(0.0);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto value = number_of_cell(row.cells[columns[axis]]);
                if (!value) {
                    return fault(row, value.error().message);
                }
                place[static_cast<int>(axis)] = *value;
            }
            clip_.positions.push_back(place);
        }
        ++clip_.frame_count;
        return {};
    }

    Expected<void> find_rate() {
        if (rate_) {
            clip_.frames_per_second = *rate_;
            return {};
        }
        if (times_.size() < 2) {
            return fail(name_ +
                        ": has no column \"time\", or only one row; give the rate with --fps");
        }
        const double step =
            (times_.back() - times_.front()) / static_cast<double>(times_.size() - 1);
        clip_.frames_per_second = 1.0 / step;
        double largest = 0.0;
        for (std::size_t i = 0; i < times_.size(); ++i) {
            const double even = times_.front() + step * static_cast<double>(i);
            largest = std::max(largest, std::abs(times_[i] - even));
        }
        if (largest > kUnevenTimes * step) {
            clip_.warnings.push_back(fmt::format(
                "its times are uneven by up to {:.3g} s; frames are taken as even", largest));
        }
        return {};
    }

    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

    TableRows rows_;
    std::string name_;
    std::optional<double> rate_;
    PointClip clip_;
    std::vector<std::array<std::size_t, 3>> columns_;  // by point and axis
    std::vector<std::string> others_;
    std::size_t time_ = kNone;
    std::size_t width_ = 0;
    std::vector<double> times_;
};

}  // namespace

Expected<PointClip> parse_points_csv(std::string_view text,
                                     std::string_view name,
                                     std::optional<double> frames_per_second) {
    return PointTableReader(without_byte_order_mark(text), name, frames_per_second).read();
}

}  // namespace raks::motion
