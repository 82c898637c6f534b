#include "motion/capture/markers/labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/printable.hpp"
#include "motion/skeleton/formats/table_rows.hpp"

namespace raks::capture {
namespace {

constexpr std::size_t kLabelColumns = 5;

Expected<MarkerLabel> label_of(const std::vector<std::string_view>& cells) {
    if (cells.size() != kLabelColumns) {
        return fail(fmt::format("has {} cells, needs camera, picture, marker, u, v", cells.size()));
    }
    const Expected<double> picture = motion::number_of_cell(cells[1]);
    const Expected<double> u = motion::number_of_cell(cells[3]);
    const Expected<double> v = motion::number_of_cell(cells[4]);
    for (const auto* number : {&picture, &u, &v}) {
        if (!*number) {
            return fail(number->error());
        }
    }
    constexpr double kMostPictures = 1e8;
    constexpr double kFarthestLabel = 1e5;
    if (!(*picture >= 0.0 && *picture <= kMostPictures) || *picture != std::floor(*picture)) {
        return fail("picture must be a whole number from 0");
    }
    if (!(std::abs(*u) <= kFarthestLabel && std::abs(*v) <= kFarthestLabel)) {
        return fail("u and v must be pixels");
    }
    return MarkerLabel{
        std::string(cells[0]), static_cast<std::size_t>(*picture), std::string(cells[2]), {*u, *v}};
}

bool is_same_place(const MarkerLabel& one, const MarkerLabel& other) {
    return one.camera == other.camera && one.picture == other.picture && one.marker == other.marker;
}

}  // namespace

std::string labels_text(const std::vector<MarkerLabel>& labels) {
    std::string text = "camera\tpicture\tmarker\tu\tv\n";
    for (const MarkerLabel& label : labels) {
        text += fmt::format("{}\t{}\t{}\t{}\t{}\n",
                            label.camera,
                            label.picture,
                            label.marker,
                            label.pixel.x,
                            label.pixel.y);
    }
    return text;
}

Expected<std::vector<MarkerLabel>> read_labels(std::string_view text, const std::string& file) {
    motion::TableRows rows(motion::without_byte_order_mark(text), '\t');
    motion::TableRow row;
    if (!rows.next(row) || row.cells.size() != kLabelColumns || row.cells[0] != "camera" ||
        row.cells[2] != "marker") {
        return fail(
            file +
            ": is not a table of labels: its first line must be camera, picture, marker, u, v, "
            "separated by tabs");
    }
    std::vector<MarkerLabel> labels;
    while (rows.next(row)) {
        Expected<MarkerLabel> label = label_of(row.cells);
        if (!label) {
            return fail(fmt::format("{}: line {}: {}", file, row.number, label.error().message));
        }
        if (std::any_of(labels.begin(), labels.end(), [&](const MarkerLabel& other) {
                return is_same_place(other, *label);
            })) {
            return fail(fmt::format("{}: line {}: marker \"{}\" is labelled twice in this picture",
                                    file,
                                    row.number,
                                    printable(label->marker, 40)));
        }
        labels.push_back(std::move(*label));
    }
    return labels;
}

}  // namespace raks::capture
