#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "motion/skeleton/formats/motion_limits.hpp"
#include "motion/skeleton/formats/points.hpp"
#include "motion/skeleton/formats/table_rows.hpp"
#include "motion/skeleton/text_lines.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kLeading = 2;  // columns before the markers': frame and time

class TrcReader {
 public:
    TrcReader(std::string_view text, std::string_view name, std::optional<double> rate)
        : rows_(text, '\t'), name_(name), rate_(rate) {}

    Expected<PointClip> read() {
        if (auto done = read_head(); !done) {
            return fail(std::move(done.error()));
        }
        TableRow row;
        while (rows_.next(row)) {
            if (auto done = add_frame(row); !done) {
                return fail(std::move(done.error()));
            }
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

    // Five lines: the mark, keys, their values, the markers' names, the axes' names.
    Expected<void> read_head() {
        TableRow mark;
        TableRow keys;
        TableRow values;
        TableRow names;
        TableRow axes;
        if (!rows_.next(mark) || lower(mark.cells[0]) != "pathfiletype" || !rows_.next(keys) ||
            !rows_.next(values) || !rows_.next(names) || !rows_.next(axes)) {
            return fail(name_ + ": is not TRC, or ends inside its header");
        }
        if (auto done = take_facts(keys, values); !done) {
            return done;
        }
        // Each name is followed by two blank cells, in some files by none.
        for (std::size_t i = kLeading; i < names.cells.size(); ++i) {
            if (!names.cells[i].empty()) {
                clip_.names.emplace_back(names.cells[i]);
            }
        }
        if (clip_.names.empty() || clip_.names.size() > kMostJoints) {
            return fault(
                names,
                fmt::format("names {} markers; 1 to {} are read", clip_.names.size(), kMostJoints));
        }
        return {};
    }

    Expected<void> take_facts(const TableRow& keys, const TableRow& values) {
        for (std::size_t i = 0; i < std::min(keys.cells.size(), values.cells.size()); ++i) {
            const std::string key = lower(keys.cells[i]);
            if (key == "datarate") {
                const auto rate = number_of_cell(values.cells[i]);
                if (!rate) {
                    return fault(values, "DataRate: " + rate.error().message);
                }
                clip_.frames_per_second = *rate;
            } else if (key == "units") {
                clip_.metres_per_unit = metres_of_unit(values.cells[i]);
            }
        }
        clip_.frames_per_second = rate_.value_or(clip_.frames_per_second);
        return {};
    }

    Expected<void> add_frame(const TableRow& row) {
        // Short rows are read, so the text does not bound the clip.
        if (clip_.positions.size() > kMostJointFrames) {
            return fault(row, "has too many frames");
        }
        const std::size_t numbers = 3 * clip_.names.size();
        std::size_t cells = row.cells.size();
        while (cells > 0 && row.cells[cells - 1].empty()) {
            --cells;
        }
        if (cells > kLeading + numbers) {
            return fault(row,
                         fmt::format("{} cells for {} markers: at most {}",
                                     cells,
                                     clip_.names.size(),
                                     kLeading + numbers));
        }
        if (cells == 0) {
            return {};  // nothing but tabs
        }
        const auto number = number_of_cell(row.cells.front());
        if (!number || !std::isfinite(*number)) {
            return fault(row, "does not begin with a frame's number: it is damaged, or no row");
        }
        for (std::size_t point = 0; point < clip_.names.size(); ++point) {
            glm::dvec3 place(std::numeric_limits<double>::quiet_NaN());
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::size_t at = kLeading + 3 * point + axis;
                const auto value = number_of_cell(at < cells ? row.cells[at] : std::string_view());
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

    TableRows rows_;
    std::string name_;
    std::optional<double> rate_;
    PointClip clip_;
};

}  // namespace

Expected<PointClip> parse_trc(std::string_view text,
                              std::string_view name,
                              std::optional<double> frames_per_second) {
    return TrcReader(without_byte_order_mark(text), name, frames_per_second).read();
}

}  // namespace raks::motion
