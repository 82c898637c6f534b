#include "motion/capture/keypoints/keypoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/printable.hpp"
#include "motion/skeleton/formats/table_rows.hpp"

namespace raks::capture {
namespace {

constexpr std::array<std::string_view, kBodyPoints> kBodyPointNames = {
    "nose",        "left_eye_inner",  "left_eye",        "left_eye_outer", "right_eye_inner",
    "right_eye",   "right_eye_outer", "left_ear",        "right_ear",      "mouth_left",
    "mouth_right", "left_shoulder",   "right_shoulder",  "left_elbow",     "right_elbow",
    "left_wrist",  "right_wrist",     "left_pinky",      "right_pinky",    "left_index",
    "right_index", "left_thumb",      "right_thumb",     "left_hip",       "right_hip",
    "left_knee",   "right_knee",      "left_ankle",      "right_ankle",    "left_heel",
    "right_heel",  "left_foot_index", "right_foot_index"};

constexpr std::string_view kKeypointsFormat = "# raks-keypoints";
constexpr std::size_t kPlainColumns = 4;  // picture, time, score, people
constexpr std::size_t kKeypointColumns = kPlainColumns + 3 * kBodyPoints;
constexpr std::string_view kBackgroundColumns = ",background_x,background_y,background_size";
constexpr std::size_t kAllColumns = kKeypointColumns + 3;
constexpr double kLargestGrowth = 100.0;
constexpr double kFarthestKeypoint = 1e5;  // pixels
constexpr double kLatestPicture = 86400.0;
constexpr int kLargestPicture = 16384;
constexpr double kMostPeople = 100.0;
constexpr double kLastPicture = 1e8;

std::string head_of_keypoints() {
    std::string head = "picture,time,score,people";
    for (const std::string_view name : kBodyPointNames) {
        head += fmt::format(",{0}_x,{0}_y,{0}_v", name);
    }
    return head;
}

// The first word of a text, which is shortened by it.
std::string_view take_word(std::string_view& text) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return word;
}

bool read_size(std::string_view word, int& size) {
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), size);
    return parsed.ec == std::errc{} && parsed.ptr == word.data() + word.size() && size >= 1 &&
           size <= kLargestPicture;
}

Expected<KeypointFilm> read_first_line(std::string_view line, const std::string& file) {
    if (!line.starts_with(kKeypointsFormat)) {
        return fail(
            fmt::format("{}: is not a table of keypoints: its first line must begin with {}",
                        file,
                        kKeypointsFormat));
    }
    line.remove_prefix(std::min(kKeypointsFormat.size() + 1, line.size()));
    const std::string_view version = take_word(line);
    if (version != "1") {
        return fail(fmt::format(
            "{}: is of version {}, this program reads version 1", file, printable(version, 20)));
    }
    KeypointFilm film;
    const bool is_sized =
        read_size(take_word(line), film.width) && read_size(take_word(line), film.height);
    film.network = printable(take_word(line), 40);
    film.camera = printable(line, 100);
    if (!is_sized || film.network.empty() || film.camera.empty()) {
        return fail(fmt::format(
            "{}: line 1 must be {} 1 WIDTH HEIGHT NETWORK CAMERA", file, kKeypointsFormat));
    }
    return film;
}

// A number of a row within limits.
Expected<double> number_within(std::string_view cell,
                               std::string_view what,
                               double least,
                               double greatest) {
    Expected<double> number = motion::number_of_cell(cell);
    if (!number) {
        return number;
    }
    if (!(*number >= least && *number <= greatest)) {
        return fail(fmt::format("its {} must be a number from {} to {}", what, least, greatest));
    }
    return number;
}

Expected<Keypoint> read_keypoint(const std::vector<std::string_view>& cells, std::size_t point) {
    const std::size_t first = kPlainColumns + 3 * point;
    const std::string_view name = kBodyPointNames[point];
    const auto x = number_within(cells[first], name, -kFarthestKeypoint, kFarthestKeypoint);
    const auto y = number_within(cells[first + 1], name, -kFarthestKeypoint, kFarthestKeypoint);
    const auto visibility =
        number_within(cells[first + 2], fmt::format("visibility of {}", name), 0.0, 1.0);
    for (const auto* const one : {&x, &y, &visibility}) {
        if (!*one) {
            return fail(one->error());
        }
    }
    return Keypoint{{*x, *y}, *visibility};
}

// Of the last three cells; nothing: they are empty.
Expected<std::optional<BackgroundPlace>> read_background(
    const std::vector<std::string_view>& cells) {
    const std::string_view* const cell = &cells[kKeypointColumns];
    if (cell[0].empty() && cell[1].empty() && cell[2].empty()) {
        return std::optional<BackgroundPlace>();
    }
    const auto x = number_within(cell[0], "background_x", -kFarthestKeypoint, kFarthestKeypoint);
    const auto y = number_within(cell[1], "background_y", -kFarthestKeypoint, kFarthestKeypoint);
    const auto size =
        number_within(cell[2], "background_size", 1.0 / kLargestGrowth, kLargestGrowth);
    for (const auto* const one : {&x, &y, &size}) {
        if (!*one) {
            return fail(one->error());
        }
    }
    return std::optional(BackgroundPlace{{*x, *y}, *size});
}

Expected<KeypointPicture> read_picture(const std::vector<std::string_view>& cells,
                                       std::size_t columns) {
    if (cells.size() != columns) {
        return fail(fmt::format("has {} cells, needs {}", cells.size(), columns));
    }
    const auto number = number_within(cells[0], "picture", 0.0, kLastPicture);
    const auto time = number_within(cells[1], "time", -kLatestPicture, kLatestPicture);
    const auto score = number_within(cells[2], "score", 0.0, 1.0);
    const auto people = cells[3].empty() ? Expected<double>(0.0)
                                         : number_within(cells[3], "people", 0.0, kMostPeople);
    for (const auto* const one : {&number, &time, &score, &people}) {
        if (!*one) {
            return fail(one->error());
        }
    }
    KeypointPicture picture;
    picture.number = static_cast<std::size_t>(*number);
    picture.time = *time;
    picture.score = *score;
    if (!cells[3].empty()) {
        picture.people = static_cast<std::size_t>(*people);
    }
    for (std::size_t point = 0; point < kBodyPoints; ++point) {
        const auto keypoint = read_keypoint(cells, point);
        if (!keypoint) {
            return fail(keypoint.error());
        }
        picture.points[point] = *keypoint;
    }
    if (columns == kAllColumns) {
        auto background = read_background(cells);
        if (!background) {
            return fail(std::move(background.error()));
        }
        picture.background = *background;
    }
    return picture;
}

}  // namespace

std::string_view name_of(BodyPoint point) noexcept {
    return kBodyPointNames[static_cast<std::size_t>(point)];
}

std::span<const std::string_view> body_point_names() noexcept { return kBodyPointNames; }

std::optional<BodyPoint> body_point_named(std::string_view name) noexcept {
    const auto found = std::find(kBodyPointNames.begin(), kBodyPointNames.end(), name);
    return found == kBodyPointNames.end()
               ? std::nullopt
               : std::optional(static_cast<BodyPoint>(found - kBodyPointNames.begin()));
}

std::string keypoints_text(const KeypointFilm& film) {
    std::string text = fmt::format("{} 1 {} {} {} {}\n{}{}\n",
                                   kKeypointsFormat,
                                   film.width,
                                   film.height,
                                   film.network,
                                   film.camera,
                                   head_of_keypoints(),
                                   kBackgroundColumns);
    const auto out = std::back_inserter(text);
    for (const KeypointPicture& picture : film.pictures) {
        fmt::format_to(out, "{},{},{:.3f},", picture.number, picture.time, picture.score);
        if (picture.people) {
            fmt::format_to(out, "{}", *picture.people);
        }
        for (const Keypoint& point : picture.points) {
            fmt::format_to(
                out, ",{:.2f},{:.2f},{:.3f}", point.pixel.x, point.pixel.y, point.visibility);
        }
        if (const auto& place = picture.background) {
            fmt::format_to(out, ",{:.2f},{:.2f},{:.5f}", place->move.x, place->move.y, place->size);
        } else {
            text += ",,,";
        }
        text += '\n';
    }
    return text;
}

Expected<KeypointFilm> read_keypoints(std::string_view text, const std::string& file) {
    text = motion::without_byte_order_mark(text);
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    Expected<KeypointFilm> film = read_first_line(text.substr(0, end), file);
    if (!film) {
        return film;
    }
    motion::TableRows rows(text, ',');
    motion::TableRow row;
    static_cast<void>(rows.next(row));
    const std::string head =
        rows.next(row) ? fmt::format("{}", fmt::join(row.cells, ",")) : std::string();
    const bool has_background = head == head_of_keypoints().append(kBackgroundColumns);
    if (!has_background && head != head_of_keypoints()) {
        return fail(
            fmt::format("{}: line 2 must be picture,time,score,people,nose_x,nose_y,... "
                        "with the {} joints of BlazePose",
                        file,
                        kBodyPoints));
    }
    while (rows.next(row)) {
        const auto fault = [&](std::string_view what) {
            return fail(fmt::format("{}: line {}: {}", file, row.number, what));
        };
        auto picture = read_picture(row.cells, has_background ? kAllColumns : kKeypointColumns);
        if (!picture) {
            return fault(picture.error().message);
        }
        if (!film->pictures.empty() && (picture->number <= film->pictures.back().number ||
                                        !(picture->time > film->pictures.back().time))) {
            return fault("its picture or time does not come after the one before");
        }
        film->pictures.push_back(*picture);
    }
    return film;
}

}  // namespace raks::capture
