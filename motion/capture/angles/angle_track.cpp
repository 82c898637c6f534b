#include "motion/capture/angles/angle_track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "base/printable.hpp"
#include "motion/skeleton/formats/table_rows.hpp"

namespace raks::capture {
namespace {

constexpr std::string_view kAnglesHead = "frame,time,joint,x,y,z,deviation";
constexpr std::size_t kCells = 7;
constexpr std::string_view kPlaceName = "place";
constexpr double kFarthestHips = 1000.0;   // metres
constexpr double kWidestTurn = 20.0;       // radians
constexpr double kLatestMoment = 86400.0;  // seconds
constexpr double kHighestFrameRate = 1000.0;

/// A row of the table.
struct AngleRow {
    double frame = 0.0;
    double time = 0.0;
    std::string_view joint;
    std::array<double, 3> values{};  // NaN: blank
    double deviation = 0.0;
};

Expected<AngleRow> angle_row_of(const std::vector<std::string_view>& cells) {
    if (cells.size() != kCells) {
        return fail(fmt::format("has {} cells, needs 7: {}", cells.size(), kAnglesHead));
    }
    std::array<double, kCells> numbers{};
    for (const std::size_t column : {0U, 1U, 3U, 4U, 5U, 6U}) {
        const Expected<double> number = motion::number_of_cell(cells[column]);
        if (!number) {
            return fail(number.error());
        }
        numbers[column] = *number;
    }
    if (!(std::abs(numbers[1]) <= kLatestMoment)) {
        return fail("its time must be a number of seconds within a day");
    }
    return AngleRow{
        numbers[0], numbers[1], cells[2], {numbers[3], numbers[4], numbers[5]}, numbers[6]};
}

/// Builds a track row by row.
class AnglesReader {
 public:
    explicit AnglesReader(const BodyModel& model) : model_(model) {}

    Expected<void> add(const AngleRow& row) {
        const std::size_t rows = model_.joints().size() + 1;
        const std::size_t due = rows_ % rows;
        if (due == 0) {
            track_.states.push_back(last_);
            track_.is_lost.push_back(false);
            track_.deviations.emplace_back(model_.variables());
            times_.push_back(row.time);
        }
        if (row.frame != static_cast<double>(rows_ / rows)) {
            return fail(fmt::format("frame {} is out of order", row.frame));
        }
        const std::string_view name =
            due == 0 ? kPlaceName : std::string_view(model_.joints()[due - 1].name);
        if (row.joint != name) {
            return fail(
                fmt::format("has joint \"{}\" where \"{}\" should follow; is it of another "
                            "body (raks capture track --method angles)?",
                            printable(row.joint, 40),
                            name));
        }
        ++rows_;
        if (std::isnan(row.values[0])) {
            track_.is_lost.back() = true;
            return {};
        }
        const double limit = due == 0 ? kFarthestHips : kWidestTurn;
        const bool is_single = due > 0 && model_.joints()[due - 1].is_hinge;
        for (std::size_t i = 0; i < (is_single ? 1U : 3U); ++i) {
            if (!(std::abs(row.values[i]) <= limit)) {
                return fail(due == 0 ? "x, y and z must be metres"
                                     : "x, y and z must be radians within three turns");
            }
        }
        set(due, row);
        return {};
    }

    Expected<AngleTrack> finish() {
        if (times_.size() < 2 || rows_ % (model_.joints().size() + 1) != 0) {
            return fail("needs two or more complete frames");
        }
        const auto found = std::find(track_.is_lost.begin(), track_.is_lost.end(), false);
        if (found == track_.is_lost.end()) {
            return fail("has no frame in which the body was found");
        }
        const auto first = static_cast<std::size_t>(found - track_.is_lost.begin());
        for (std::size_t frame = 0; frame < first; ++frame) {
            track_.states[frame] = track_.states[first];
        }
        for (std::size_t frame = first + 1; frame < track_.states.size(); ++frame) {
            if (track_.is_lost[frame]) {
                track_.states[frame] = track_.states[frame - 1];
            }
        }
        track_.first_time = times_.front();
        track_.frames_per_second =
            static_cast<double>(times_.size() - 1) / (times_.back() - times_.front());
        if (!(track_.frames_per_second > 0.0 && track_.frames_per_second <= kHighestFrameRate)) {
            return fail("its times do not rise");
        }
        return std::move(track_);
    }

 private:
    void set(std::size_t due, const AngleRow& row) {
        BodyState& state = track_.states.back();
        std::vector<double>& deviations = track_.deviations.back();
        const double deviation = std::isfinite(row.deviation) ? row.deviation : 0.0;
        const glm::dvec3 values(row.values[0], row.values[1], row.values[2]);
        if (due == 0) {
            state.hips = values;
            std::fill_n(deviations.begin(), 3, deviation);
            return;
        }
        const TurningJoint& joint = model_.joints()[due - 1];
        if (joint.is_hinge) {
            state.angles[due - 1] = row.values[0];
        } else {
            state.turns[due - 1] = turned_by(values / static_cast<double>(joint.count));
        }
        std::fill_n(
            deviations.begin() + static_cast<std::ptrdiff_t>(joint.first), joint.size(), deviation);
    }

    const BodyModel& model_;
    AngleTrack track_;
    BodyState last_;
    std::vector<double> times_;  ///< by frame
    std::size_t rows_ = 0;
};

std::string cells_of(const glm::dvec3& values, std::size_t count) {
    return count == 1 ? fmt::format("{},,", values.x)
                      : fmt::format("{},{},{}", values.x, values.y, values.z);
}

}  // namespace

std::string angles_text(const AngleTrack& track, const BodyModel& model) {
    std::string text = fmt::format("{}\n", kAnglesHead);
    const auto out = std::back_inserter(text);
    for (std::size_t frame = 0; frame < track.states.size(); ++frame) {
        const BodyState& state = track.states[frame];
        const std::vector<double>& deviations = track.deviations[frame];
        const auto write = [&](std::string_view name,
                               const glm::dvec3& values,
                               std::size_t first,
                               std::size_t count) {
            const auto from = deviations.begin() + static_cast<std::ptrdiff_t>(first);
            const double deviation =
                *std::max_element(from, from + static_cast<std::ptrdiff_t>(count));
            fmt::format_to(out,
                           "{},{},{},{},{:.6g}\n",
                           frame,
                           track.time_of(frame),
                           name,
                           track.is_lost[frame] ? std::string(",,") : cells_of(values, count),
                           deviation);
        };
        write(kPlaceName, state.hips, kHipsPlace, 3);
        for (std::size_t i = 0; i < model.joints().size(); ++i) {
            const TurningJoint& joint = model.joints()[i];
            write(joint.name, model.turn_of(state, i), joint.first, joint.size());
        }
    }
    return text;
}

bool is_of_body(std::string_view text, const BodyModel& model) {
    motion::TableRows rows(motion::without_byte_order_mark(text), ',');
    motion::TableRow cells;
    std::vector<std::string> names;
    std::string first;
    while (rows.next(cells) && cells.cells.size() == kCells) {
        const std::string frame(cells.cells[0]);
        const std::string_view name = cells.cells[2];
        if (name == "joint") {
            continue;  // the head
        }
        first = names.empty() && first.empty() ? frame : first;
        if (frame != first) {
            break;
        }
        if (name != kPlaceName) {
            names.emplace_back(name);
        }
        if (names.size() > kMostJoints) {
            break;
        }
    }
    return names.empty() || std::equal(names.begin(),
                                       names.end(),
                                       model.joints().begin(),
                                       model.joints().end(),
                                       [](const std::string& name, const TurningJoint& joint) {
                                           return name == joint.name;
                                       });
}

Expected<AngleTrack> read_angles(std::string_view text,
                                 const std::string& file,
                                 const BodyModel& model) {
    motion::TableRows rows(motion::without_byte_order_mark(text), ',');
    motion::TableRow cells;
    if (!rows.next(cells) || fmt::format("{}", fmt::join(cells.cells, ",")) != kAnglesHead) {
        return fail(fmt::format(
            "{}: is not a table of angles: its first line must be {}", file, kAnglesHead));
    }
    AnglesReader reader(model);
    while (rows.next(cells)) {
        const Expected<AngleRow> row = angle_row_of(cells.cells);
        const Expected<void> added = row ? reader.add(*row) : fail(row.error());
        if (!added) {
            return fail(fmt::format("{}: line {}: {}", file, cells.number, added.error().message));
        }
    }
    auto track = reader.finish();
    return track ? std::move(track) : fail(Error(track.error()).in(file));
}

}  // namespace raks::capture
