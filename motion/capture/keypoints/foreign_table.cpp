// Joints in pictures as tables of other programs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <vector>

#include "base/printable.hpp"
#include "motion/capture/keypoints/foreign_keypoints.hpp"
#include "motion/skeleton/formats/table_rows.hpp"

namespace raks::capture {
namespace {

constexpr std::size_t kNoColumn = static_cast<std::size_t>(-1);
constexpr double kFarthestPlace = 1e5;  // pixels
constexpr std::size_t kMostTableColumns = 4096;
constexpr const char* kKnownLayouts =
    "known: a head with NAME_x, NAME_y and NAME_v (or _score, _likelihood, _confidence), "
    "DeepLabCut, OpenPose's folder of JSON, keypoints of Raks";

/// The columns of one joint.
struct PointColumns {
    std::size_t x = kNoColumn;
    std::size_t y = kNoColumn;
    std::size_t likelihood = kNoColumn;
};

/// Which columns hold what.
struct TableLayout {
    std::array<PointColumns, kBodyPoints> points{};
    std::size_t picture = kNoColumn;
    std::size_t time = kNoColumn;
    std::size_t width = 0;
    std::string other_name;               // the first that is none of ours
    std::vector<std::string_view> names;  // what its columns of joints are called
};

std::string in_lower_case(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return lower;
}

// The separator of a head: the most frequent one.
char separator_in(std::string_view text) {
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

std::size_t* column_for(PointColumns& columns, std::string_view axis) {
    constexpr std::array<std::string_view, 8> kLikelihoods = {
        "v", "c", "p", "score", "conf", "confidence", "likelihood", "visibility"};
    if (axis == "x") {
        return &columns.x;
    }
    if (axis == "y") {
        return &columns.y;
    }
    return std::find(kLikelihoods.begin(), kLikelihoods.end(), axis) != kLikelihoods.end()
               ? &columns.likelihood
               : nullptr;
}

// Enters the column of a joint's axis. Errors: it is there twice.
Expected<void> enter_column(TableLayout& layout,
                            std::string_view name,
                            std::string_view axis,
                            std::size_t column,
                            const PointNameMap& map) {
    PointColumns unused;
    if (column_for(unused, axis) == nullptr) {
        return {};
    }
    layout.names.push_back(name);
    const auto point = body_point_meant(name, map);
    if (!point) {
        layout.other_name = layout.other_name.empty() ? std::string(name) : layout.other_name;
        return {};
    }
    std::size_t& place = *column_for(layout.points[static_cast<std::size_t>(*point)], axis);
    if (place != kNoColumn) {
        return fail(
            fmt::format("{} is there twice: say by a map which column it is", name_of(*point)));
    }
    place = column;
    return {};
}

Expected<void> enter_title(TableLayout& layout,
                           std::string_view title,
                           std::size_t column,
                           const PointNameMap& map) {
    const std::string plain = in_lower_case(title);
    if (plain == "frame" || plain == "picture" || plain == "image") {
        layout.picture = column;
        return {};
    }
    if (plain == "time" || plain == "timestamp" || plain == "seconds") {
        layout.time = column;
        return {};
    }
    const std::size_t cut = plain.find_last_of("_.:- ");
    return cut == std::string::npos
               ? Expected<void>{}
               : enter_column(layout, title.substr(0, cut), plain.substr(cut + 1), column, map);
}

/// Reads a table of either layout.
class ForeignTableReader {
 public:
    ForeignTableReader(std::string_view text, const std::string& file, const ForeignFilm& film)
        : rows_(text, separator_in(text)), file_(file), film_(film) {}

    Expected<KeypointFilm> read() {
        motion::TableRow row;
        if (!rows_.next(row)) {
            return fail(file_ + ": is empty");
        }
        if (row.cells.size() > kMostTableColumns) {
            return fault(row, "has too many columns");
        }
        if (auto read = read_head(row); !read) {
            return fault(row, read.error().message);
        }
        KeypointFilm film{film_.camera, film_.width, film_.height, "table", {}};
        while (rows_.next(row)) {
            if (auto added = add_row(row.cells, film); !added) {
                return fault(row, added.error().message);
            }
        }
        scale_shares(film);
        return film;
    }

 private:
    tl::unexpected<Error> fault(const motion::TableRow& row, const std::string& what) const {
        return fail(fmt::format("{}: line {}: {}", file_, row.number, what));
    }

    Expected<void> read_head(motion::TableRow& row) {
        if (in_lower_case(row.cells.front()) == "scorer") {
            if (auto read = read_deeplabcut_head(row); !read) {
                return read;
            }
        } else {
            for (std::size_t column = 0; column < row.cells.size(); ++column) {
                if (auto entered = enter_title(layout_, row.cells[column], column, film_.names);
                    !entered) {
                    return entered;
                }
            }
        }
        layout_.width = row.cells.size();
        const bool has_points =
            std::any_of(layout_.points.begin(), layout_.points.end(), [](const auto& point) {
                return point.x != kNoColumn && point.y != kNoColumn;
            });
        if (has_points) {
            return check_map();
        }
        return layout_.other_name.empty()
                   ? fail(fmt::format("is of an unknown layout; {}", kKnownLayouts))
                   : fail(fmt::format(
                         "has no joint that is known: what is \"{}\"? say it by a map (--map "
                         "names.tsv: their name, a tab, left_wrist)",
                         printable(layout_.other_name, 40)));
    }

    // A map that names what is not there has a slip in it.
    Expected<void> check_map() const {
        for (const auto& [name, point] : film_.names) {
            if (std::find(layout_.names.begin(), layout_.names.end(), name) ==
                layout_.names.end()) {
                return fail(fmt::format("no column is called \"{}\", which the map (--map) names",
                                        printable(name, 40)));
            }
        }
        return {};
    }

    // Rows: scorer, bodyparts, coords; the first column numbers the pictures.
    Expected<void> read_deeplabcut_head(motion::TableRow& row) {
        motion::TableRow axes;
        if (!rows_.next(row) || in_lower_case(row.cells.front()) != "bodyparts" ||
            !rows_.next(axes) || in_lower_case(axes.cells.front()) != "coords" ||
            axes.cells.size() != row.cells.size()) {
            return fail(
                "is of an unknown layout: behind scorer must follow rows bodyparts and coords");
        }
        layout_.picture = 0;
        for (std::size_t column = 1; column < row.cells.size(); ++column) {
            if (auto entered = enter_column(layout_,
                                            row.cells[column],
                                            in_lower_case(axes.cells[column]),
                                            column,
                                            film_.names);
                !entered) {
                return entered;
            }
        }
        return {};
    }

    Expected<void> add_row(const std::vector<std::string_view>& cells, KeypointFilm& film) const {
        if (cells.size() != layout_.width) {
            return fail(fmt::format("has {} cells, needs {}", cells.size(), layout_.width));
        }
        KeypointPicture picture;
        if (auto numbered = number_picture(cells, film, picture); !numbered) {
            return numbered;
        }
        for (std::size_t point = 0; point < kBodyPoints; ++point) {
            const auto keypoint = read_point(cells, layout_.points[point]);
            if (!keypoint) {
                return fail(
                    fmt::format("{}: {}", body_point_names()[point], keypoint.error().message));
            }
            picture.points[point] = *keypoint;
            picture.score = keypoint->visibility > 0.0 ? 1.0 : picture.score;
        }
        film.pictures.push_back(picture);
        return {};
    }

    Expected<void> number_picture(const std::vector<std::string_view>& cells,
                                  const KeypointFilm& film,
                                  KeypointPicture& picture) const {
        constexpr double kMostNumber = 1e8;
        constexpr double kLongest = 86400.0;
        const bool is_first = film.pictures.empty();
        double number = is_first ? 0.0 : static_cast<double>(film.pictures.back().number) + 1.0;
        if (layout_.picture != kNoColumn) {
            const auto cell = motion::number_of_cell(cells[layout_.picture]);
            number = cell.value_or(std::numeric_limits<double>::quiet_NaN());
        }
        double time = number / film_.pictures_per_second;
        if (layout_.time != kNoColumn) {
            const auto cell = motion::number_of_cell(cells[layout_.time]);
            time = cell.value_or(std::numeric_limits<double>::quiet_NaN());
        }
        if (!(number >= 0.0 && number <= kMostNumber && number == std::floor(number))) {
            return fail("the picture's number must be a whole number");
        }
        if (!(std::abs(time) <= kLongest)) {
            return fail("its time must be a number of seconds within a day");
        }
        picture.number = static_cast<std::size_t>(number);
        picture.time = time;
        if (!is_first && (picture.number <= film.pictures.back().number ||
                          !(picture.time > film.pictures.back().time))) {
            return fail("its picture or time does not come after the one before");
        }
        return {};
    }

    static Expected<Keypoint> read_point(const std::vector<std::string_view>& cells,
                                         const PointColumns& columns) {
        if (columns.x == kNoColumn || columns.y == kNoColumn) {
            return Keypoint{};
        }
        const auto x = motion::number_of_cell(cells[columns.x]);
        const auto y = motion::number_of_cell(cells[columns.y]);
        const auto likelihood = columns.likelihood == kNoColumn
                                    ? Expected<double>(1.0)
                                    : motion::number_of_cell(cells[columns.likelihood]);
        for (const auto* const one : {&x, &y, &likelihood}) {
            if (!*one) {
                return fail(one->error());
            }
        }
        if (std::isnan(*x) || std::isnan(*y) || std::isnan(*likelihood) || *likelihood == 0.0) {
            return Keypoint{};
        }
        if (!(*likelihood > 0.0 && *likelihood <= 1.0)) {
            return fail(fmt::format("its likelihood is {}, must be from 0 to 1", *likelihood));
        }
        if (!(std::abs(*x) <= kFarthestPlace && std::abs(*y) <= kFarthestPlace)) {
            return fail("does not lie in a picture");
        }
        return Keypoint{{*x, *y}, *likelihood};
    }

    // Places that all lie within [0, 1] are shares of the picture.
    void scale_shares(KeypointFilm& film) const {
        constexpr double kMostShare = 2.0;  // joints may lie beside the picture
        for (const KeypointPicture& picture : film.pictures) {
            for (const Keypoint& point : picture.points) {
                if (std::abs(point.pixel.x) > kMostShare || std::abs(point.pixel.y) > kMostShare) {
                    return;
                }
            }
        }
        for (KeypointPicture& picture : film.pictures) {
            for (Keypoint& point : picture.points) {
                if (point.visibility > 0.0) {
                    point.pixel = point.pixel * glm::dvec2(film.width, film.height) - 0.5;
                }
            }
        }
    }

    motion::TableRows rows_;
    const std::string& file_;
    const ForeignFilm& film_;
    TableLayout layout_;
};

}  // namespace

Expected<KeypointFilm> read_foreign_table(std::string_view text,
                                          const std::string& file,
                                          const ForeignFilm& film) {
    return ForeignTableReader(motion::without_byte_order_mark(text), file, film).read();
}

}  // namespace raks::capture
