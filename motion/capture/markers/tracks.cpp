#include "motion/capture/markers/tracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include "base/printable.hpp"
#include "motion/skeleton/formats/table_rows.hpp"

namespace raks::capture {
namespace {

constexpr std::string_view kTracksHead = "frame,time,marker,x,y,z,deviation,views,source";
constexpr std::array<std::string_view, 3> kSourceNames = {"seen", "filled", "lost"};
constexpr std::size_t kColumns = 9;
constexpr std::size_t kMostTracks = 1000;
constexpr double kFarthestPlace = 1000.0;  // metres
constexpr double kLatestTime = 86400.0;    // seconds
constexpr double kMostViews = 100.0;

/// A row of the table.
struct TrackRow {
    double frame = 0.0;
    double time = 0.0;
    std::string_view marker;
    MarkerPlace place;
};

Expected<MarkerPlace> place_in_row(const std::array<double, kColumns>& numbers,
                                   std::string_view source) {
    const auto* const name = std::find(kSourceNames.begin(), kSourceNames.end(), source);
    if (name == kSourceNames.end()) {
        return fail(
            fmt::format("source \"{}\" must be seen, filled or lost", printable(source, 40)));
    }
    MarkerPlace place;
    place.source = static_cast<PlaceSource>(name - kSourceNames.begin());
    if (place.source == PlaceSource::lost) {
        return place;
    }
    place.place = {numbers[3], numbers[4], numbers[5]};
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(place.place[axis]) <= kFarthestPlace)) {
            return fail("x, y and z must be metres");
        }
    }
    if (!(numbers[6] >= 0.0 && numbers[6] <= kFarthestPlace) ||
        !(numbers[7] >= 0.0 && numbers[7] <= kMostViews)) {
        return fail("deviation must be metres and views a count");
    }
    place.deviation = numbers[6];
    place.views = static_cast<std::uint8_t>(numbers[7]);
    return place;
}

Expected<TrackRow> row_of(const std::vector<std::string_view>& cells) {
    if (cells.size() != kColumns) {
        return fail(fmt::format("has {} cells, needs 9: {}", cells.size(), kTracksHead));
    }
    std::array<double, kColumns> numbers{};
    for (const std::size_t column : {0U, 1U, 3U, 4U, 5U, 6U, 7U}) {
        const Expected<double> number = motion::number_of_cell(cells[column]);
        if (!number) {
            return fail(number.error());
        }
        numbers[column] = *number;
    }
    if (!(std::abs(numbers[1]) <= kLatestTime)) {
        return fail("its time must be a number of seconds within a day");
    }
    Expected<MarkerPlace> place = place_in_row(numbers, cells[8]);
    if (!place) {
        return fail(place.error());
    }
    return TrackRow{numbers[0], numbers[1], cells[2], *place};
}

/// Builds tracks row by row: the first frame tells the markers.
class TracksReader {
 public:
    Expected<void> add(const TrackRow& row) {
        if (row.frame == 0.0) {
            return add_marker(row);
        }
        const std::size_t markers = tracks_.markers.size();
        if (markers == 0 || tracks_.places.size() % markers == 0) {
            times_.push_back(row.time);
        }
        const std::size_t due_frame = markers == 0 ? 0 : tracks_.places.size() / markers;
        if (markers == 0 || row.frame != static_cast<double>(due_frame)) {
            return fail(fmt::format("frame {} is out of order", row.frame));
        }
        const std::string& due = tracks_.markers[tracks_.places.size() % markers];
        if (row.marker != due) {
            return fail(fmt::format("has marker \"{}\" where \"{}\" should follow",
                                    printable(row.marker, 40),
                                    printable(due, 40)));
        }
        tracks_.places.push_back(row.place);
        return {};
    }

    Expected<Tracks> finish() {
        const std::size_t markers = tracks_.markers.size();
        if (markers == 0 || tracks_.places.size() % markers != 0 || times_.size() < 2) {
            return fail("needs two or more complete frames");
        }
        tracks_.frame_count = tracks_.places.size() / markers;
        tracks_.first_time = times_.front();
        const double span = times_.back() - times_.front();
        tracks_.frames_per_second = static_cast<double>(times_.size() - 1) / span;
        constexpr double kHighestRate = 1000.0;
        if (!(tracks_.frames_per_second > 0.0 && tracks_.frames_per_second <= kHighestRate)) {
            return fail("its times do not rise");
        }
        return std::move(tracks_);
    }

 private:
    Expected<void> add_marker(const TrackRow& row) {
        const auto& known = tracks_.markers;
        if (tracks_.places.size() != known.size() || known.size() == kMostTracks ||
            std::find(known.begin(), known.end(), row.marker) != known.end()) {
            return fail(fmt::format("marker \"{}\" is in frame 0 twice, or one of more than {}",
                                    printable(row.marker, 40),
                                    kMostTracks));
        }
        if (known.empty()) {
            times_.push_back(row.time);
        }
        tracks_.markers.emplace_back(row.marker);
        tracks_.places.push_back(row.place);
        return {};
    }

    Tracks tracks_;
    std::vector<double> times_;  ///< by frame
};

std::string place_cells(const MarkerPlace& place) {
    return place.source == PlaceSource::lost
               ? ",,"
               : fmt::format("{},{},{}", place.place.x, place.place.y, place.place.z);
}

Expected<std::size_t> frame_of(std::string_view cell, const Tracks& tracks) {
    const Expected<double> number = motion::number_of_cell(cell);
    if (!number || !(*number >= 0.0 && *number < static_cast<double>(tracks.frame_count))) {
        return fail(fmt::format("frame \"{}\" is not one of 0 to {}",
                                printable(cell, 40),
                                static_cast<double>(tracks.frame_count) - 1.0));
    }
    return static_cast<std::size_t>(*number);
}

Expected<Flag> flag_of(const std::vector<std::string_view>& cells, const Tracks& tracks) {
    if (cells.size() != 4 && cells.size() != 5) {
        return fail("needs doubt, marker, first, last and camera");
    }
    const auto* const doubt = std::find(std::begin(kDoubtNames), std::end(kDoubtNames), cells[0]);
    const auto marker = std::find(tracks.markers.begin(), tracks.markers.end(), cells[1]);
    if (doubt == std::end(kDoubtNames) || marker == tracks.markers.end()) {
        return fail("names a doubt or a marker that does not exist");
    }
    const Expected<std::size_t> first = frame_of(cells[2], tracks);
    const Expected<std::size_t> last = frame_of(cells[3], tracks);
    if (!first || !last) {
        return fail(first ? last.error() : first.error());
    }
    return Flag{static_cast<Doubt>(doubt - std::begin(kDoubtNames)),
                static_cast<std::size_t>(marker - tracks.markers.begin()),
                *first,
                *last,
                cells.size() > 4 ? std::string(cells[4]) : std::string()};
}

}  // namespace

void sort_flags(Tracks& tracks) {
    std::stable_sort(
        tracks.flags.begin(), tracks.flags.end(), [](const Flag& one, const Flag& other) {
            return std::tie(one.first, one.marker, one.doubt) <
                   std::tie(other.first, other.marker, other.doubt);
        });
}

std::string tracks_text(const Tracks& tracks) {
    std::string text = fmt::format("{}\n", kTracksHead);
    const auto out = std::back_inserter(text);
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
            const MarkerPlace& place = tracks.at(frame, marker);
            fmt::format_to(out,
                           "{},{},{},{},{},{},{}\n",
                           frame,
                           tracks.time_of(frame),
                           tracks.markers[marker],
                           place_cells(place),
                           place.deviation,
                           place.views,
                           kSourceNames[static_cast<std::size_t>(place.source)]);
        }
    }
    return text;
}

Expected<Tracks> read_tracks(std::string_view text, const std::string& file) {
    motion::TableRows rows(motion::without_byte_order_mark(text), ',');
    motion::TableRow cells;
    if (!rows.next(cells) || fmt::format("{}", fmt::join(cells.cells, ",")) != kTracksHead) {
        return fail(fmt::format(
            "{}: is not a table of tracks: its first line must be {}", file, kTracksHead));
    }
    TracksReader reader;
    while (rows.next(cells)) {
        const Expected<TrackRow> row = row_of(cells.cells);
        const Expected<void> added = row ? reader.add(*row) : fail(row.error());
        if (!added) {
            return fail(fmt::format("{}: line {}: {}", file, cells.number, added.error().message));
        }
    }
    Expected<Tracks> tracks = reader.finish();
    return tracks ? std::move(tracks) : fail(std::move(tracks.error()).in(file));
}

std::string flags_text(const Tracks& tracks) {
    std::string text = "doubt\tmarker\tfirst\tlast\tcamera\n";
    for (const Flag& flag : tracks.flags) {
        text += fmt::format("{}\t{}\t{}\t{}\t{}\n",
                            kDoubtNames[static_cast<std::size_t>(flag.doubt)],
                            tracks.markers[flag.marker],
                            flag.first,
                            flag.last,
                            flag.camera);
    }
    return text;
}

Expected<void> read_flags(std::string_view text, const std::string& file, Tracks& tracks) {
    motion::TableRows rows(motion::without_byte_order_mark(text), '\t');
    motion::TableRow cells;
    if (!rows.next(cells) || cells.cells[0] != "doubt" ||
        (cells.cells.size() != 4 && cells.cells.size() != 5)) {
        return fail(file +
                    ": is not a table of flags: its first line must be doubt, marker, first, last, "
                    "camera");
    }
    std::vector<Flag> flags;
    while (rows.next(cells)) {
        const Expected<Flag> flag = flag_of(cells.cells, tracks);
        if (!flag) {
            return fail(fmt::format("{}: line {}: {}", file, cells.number, flag.error().message));
        }
        flags.push_back(*flag);
    }
    tracks.flags = std::move(flags);
    return {};
}

std::string trc_text(const Tracks& tracks, std::string_view name) {
    std::string text = fmt::format("PathFileType\t4\t(X/Y/Z)\t{}\n", name);
    text +=
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
        "OrigNumFrames\n";
    text += fmt::format("{0}\t{0}\t{1}\t{2}\tm\t{0}\t1\t{1}\nFrame#\tTime",
                        tracks.frames_per_second,
                        tracks.frame_count,
                        tracks.markers.size());
    std::string axes = "\t";
    for (std::size_t i = 0; i < tracks.markers.size(); ++i) {
        text +=
            fmt::format("\t{}{}", tracks.markers[i], i + 1 < tracks.markers.size() ? "\t\t" : "");
        axes += fmt::format("\tX{0}\tY{0}\tZ{0}", i + 1);
    }
    text += fmt::format("\n{}\n\n", axes);
    const auto out = std::back_inserter(text);
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        fmt::format_to(out, "{}\t{:.6f}", frame + 1, tracks.time_of(frame));
        for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
            const MarkerPlace& place = tracks.at(frame, marker);
            if (place.source == PlaceSource::lost) {
                text += "\t\t\t";
            } else {
                fmt::format_to(
                    out, "\t{:.6f}\t{:.6f}\t{:.6f}", place.place.x, place.place.y, place.place.z);
            }
        }
        text += '\n';
    }
    return text;
}

}  // namespace raks::capture
