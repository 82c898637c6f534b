#include "motion/capture/markers/observations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "base/printable.hpp"
#include "motion/skeleton/formats/table_rows.hpp"

namespace raks::capture {
namespace {

constexpr std::string_view kObservationsHead = "camera,picture,time,colour,u,v,area";
constexpr std::size_t kMostFilmed = 100;
constexpr std::size_t kMostColours = 256;
constexpr double kFarthestPixel = 1e5;
constexpr double kLongestTime = 86400.0;

/// The numbers of a row.
struct RowNumbers {
    double picture = 0.0;
    double time = 0.0;
    double u = 0.0;
    double v = 0.0;
    double area = 0.0;
};

Expected<RowNumbers> numbers_of(const std::vector<std::string_view>& cells) {
    RowNumbers row;
    const std::array<std::pair<std::size_t, double*>, 5> columns = {
        {{1, &row.picture}, {2, &row.time}, {4, &row.u}, {5, &row.v}, {6, &row.area}}};
    for (const auto& [column, target] : columns) {
        const Expected<double> number = motion::number_of_cell(cells[column]);
        if (!number) {
            return fail(number.error());
        }
        *target = *number;
    }
    return row;
}

// What no detection may be; empty: it is sound.
std::string fault_of(const RowNumbers& row, bool has_colour) {
    if (!(std::abs(row.time) <= kLongestTime)) {
        return "its time must be a number of seconds within a day";
    }
    if (has_colour && !(std::abs(row.u) <= kFarthestPixel && std::abs(row.v) <= kFarthestPixel)) {
        return "u and v must be pixels";
    }
    if (has_colour && !(row.area >= 0.0 && row.area <= kFarthestPixel * kFarthestPixel)) {
        return "area must be a number of pixels";
    }
    return {};
}

/// Builds observations row by row.
class ObservationsReader {
 public:
    Expected<void> add(const std::vector<std::string_view>& cells) {
        if (cells.size() != 7) {
            return fail(fmt::format("has {} cells, needs 7: {}", cells.size(), kObservationsHead));
        }
        const Expected<RowNumbers> row = numbers_of(cells);
        if (!row) {
            return fail(row.error());
        }
        const bool has_colour = !cells[3].empty();
        if (std::string fault = fault_of(*row, has_colour); !fault.empty()) {
            return fail(std::move(fault));
        }
        if (auto placed = enter_picture(cells[0], *row); !placed) {
            return placed;
        }
        if (!has_colour) {
            return {};
        }
        const std::optional<std::size_t> colour = index_of(cells[3]);
        if (!colour) {
            return fail(fmt::format("more than {} colours", kMostColours));
        }
        result_.films.back().pictures.back().detections.push_back(
            {{row->u, row->v}, *colour, row->area});
        return {};
    }
    Observations take() { return std::move(result_); }

 private:
    // Makes the row's picture the last one of the last film.
    Expected<void> enter_picture(std::string_view camera, const RowNumbers& row) {
        if (result_.films.empty() || result_.films.back().camera != camera) {
            for (const SeenFilm& film : result_.films) {
                if (film.camera == camera) {
                    return fail(
                        fmt::format("rows of camera \"{}\" must lie together", printable(camera)));
                }
            }
            if (result_.films.size() == kMostFilmed) {
                return fail(fmt::format("more than {} cameras", kMostFilmed));
            }
            result_.films.push_back({std::string(camera), {}});
        }
        std::vector<SeenPicture>& pictures = result_.films.back().pictures;
        const auto next = static_cast<double>(pictures.size());
        if (!pictures.empty() && row.picture == next - 1.0 && row.time == pictures.back().time) {
            return {};
        }
        if (row.picture != next) {
            return fail(
                fmt::format("has picture {} where picture {} should follow", row.picture, next));
        }
        if (!pictures.empty() && !(row.time > pictures.back().time)) {
            return fail(fmt::format("its time {} does not come after the one before", row.time));
        }
        pictures.push_back({row.time, {}});
        return {};
    }

    std::optional<std::size_t> index_of(std::string_view colour) {
        const auto found = std::find(result_.colours.begin(), result_.colours.end(), colour);
        if (found != result_.colours.end()) {
            return static_cast<std::size_t>(found - result_.colours.begin());
        }
        if (result_.colours.size() == kMostColours) {
            return std::nullopt;
        }
        result_.colours.emplace_back(colour);
        return result_.colours.size() - 1;
    }

    Observations result_;
};

}  // namespace

std::string observations_text(const Observations& observations) {
    std::string text = fmt::format("{}\n", kObservationsHead);
    const auto out = std::back_inserter(text);
    for (const SeenFilm& film : observations.films) {
        for (std::size_t i = 0; i < film.pictures.size(); ++i) {
            const SeenPicture& picture = film.pictures[i];
            if (picture.detections.empty()) {
                fmt::format_to(out, "{},{},{},,,,\n", film.camera, i, picture.time);
            }
            for (const Detection& detection : picture.detections) {
                fmt::format_to(out,
                               "{},{},{},{},{},{},{}\n",
                               film.camera,
                               i,
                               picture.time,
                               observations.colours[detection.colour],
                               detection.pixel.x,
                               detection.pixel.y,
                               detection.area);
            }
        }
    }
    return text;
}

Expected<Observations> read_observations(std::string_view text, const std::string& file) {
    motion::TableRows rows(motion::without_byte_order_mark(text), ',');
    motion::TableRow row;
    if (!rows.next(row) || fmt::format("{}", fmt::join(row.cells, ",")) != kObservationsHead) {
        return fail(fmt::format("{}: is not a table of detections: its first line must be {}",
                                file,
                                kObservationsHead));
    }
    ObservationsReader reader;
    while (rows.next(row)) {
        if (auto added = reader.add(row.cells); !added) {
            return fail(fmt::format("{}: line {}: {}", file, row.number, added.error().message));
        }
    }
    return reader.take();
}

}  // namespace raks::capture
