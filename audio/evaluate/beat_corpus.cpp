#include "audio/evaluate/beat_corpus.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>
#include <utility>

#include "audio/evaluate/table_cells.hpp"
#include "audio/evaluate/text_lines.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

// No index or annotation comes near this; a wrong file is refused before it fills the memory.
constexpr std::size_t kMaxBytes = std::size_t{16} << 20U;
// Bytes of a file name without extension; common file systems allow 255 with it.
constexpr std::size_t kLongestName = 200;
// Seconds: an annotation may extrapolate its first beat to before the start of the sound.
constexpr double kEarliest = -10.0;
constexpr double kLatest = 1e6;
constexpr int kLongestBar = 64;
// One line of a .beats file: seconds, and the bar position if there is one.
struct BeatLine {
    double time = 0.0;
    std::optional<int> bar_position;
};
// Checks both columns; the error does not name the line, which the caller adds.
Expected<BeatLine> parse_beat(std::string_view line) {
    BeatLine beat;
    const std::string_view time = take_word(line);
    const auto seconds = number_of(time);
    if (!seconds || *seconds < kEarliest || *seconds > kLatest) {
        return fail(fmt::format(
            "time is \"{}\", must be seconds from {} to {}", shown(time), kEarliest, kLatest));
    }
    beat.time = *seconds;
    // Read as a number, so that "1.0" counts as 1.
    if (const std::string_view position = take_word(line); !position.empty()) {
        const auto value = number_of(position);
        if (!value || *value != std::floor(*value) || *value < 0 || *value > kLongestBar) {
            return fail(fmt::format("bar position is \"{}\", must be a whole number from 0 to {}",
                                    shown(position),
                                    kLongestBar));
        }
        beat.bar_position = static_cast<int>(*value);
    }
    return beat;
}

// In order of time; the sort is stable, so beats at the same time keep their order.
BeatList sorted(const std::vector<BeatLine>& beats) {
    std::vector<BeatLine> order = beats;
    std::stable_sort(order.begin(), order.end(), [](const BeatLine& a, const BeatLine& b) {
        return a.time < b.time;
    });
    BeatList list;
    for (const BeatLine& beat : order) {
        list.times.push_back(beat.time);
        if (beat.bar_position) {
            list.bar_positions.push_back(*beat.bar_position);
        }
    }
    return list;
}

// Names become parts of paths: without separators and a leading dot they cannot leave the folder,
// and without control characters they print on one line.
bool is_plain_name(std::string_view name) {
    return name.size() <= kLongestName && name.front() != '.' &&
           std::none_of(name.begin(), name.end(), [](char c) {
               return c == '/' || c == '\\' || (c >= '\0' && c < ' ') || c == '\x7f';
           });
}

Expected<BeatIndexRow> row_of(const std::vector<std::string_view>& cells,
                              std::size_t name_column,
                              std::size_t class_column) {
    if (cells.size() <= std::max(name_column, class_column)) {
        return fail("is cut off: name or class is missing");
    }
    const std::string_view name = cells[name_column];
    const std::string_view category = cells[class_column];
    if (name.empty() || category.empty()) {
        return fail("name or class is empty");
    }
    if (!is_plain_name(name)) {
        return fail(fmt::format("name is \"{}\", must be a plain file name", shown(name)));
    }
    if (!is_plain_name(category)) {
        return fail(fmt::format("class is \"{}\", must be a plain name", shown(category)));
    }
    return BeatIndexRow{std::string(name), std::string(category)};
}

// Reads and parses one .beats or .pred file.
Expected<BeatList> load_beats(const fs::path& path) {
    const auto text = read_text_file(path, kMaxBytes);
    if (!text) {
        return fail(text.error());
    }
    return parse_beats(*text, path.string());
}

// An annotation is stricter than an estimate: an empty one has nothing to score against, and two
// beats at one time make an interval of 0.
Expected<BeatList> load_reference(const fs::path& path) {
    auto beats = load_beats(path);
    if (!beats) {
        return beats;
    }
    if (beats->times.empty()) {
        return fail(path.string() + ": has no beats; an annotation needs some");
    }
    const auto twice = std::adjacent_find(beats->times.begin(), beats->times.end());
    if (twice != beats->times.end()) {
        return fail(fmt::format("{}: has two beats at {} s", path.string(), *twice));
    }
    return beats;
}

}  // namespace

Expected<std::vector<BeatIndexRow>> parse_beat_index(std::string_view text,
                                                     const std::string& file) {
    TextLines lines(text);
    const std::vector<std::string_view> columns =
        lines.next() ? cells_of(lines.line()) : std::vector<std::string_view>{};
    // Number of the column, or the number of columns where it is missing.
    const auto column = [&](std::string_view name) {
        return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) -
                                        columns.begin());
    };
    for (const char* name : {"name", "class"}) {
        if (column(name) == columns.size()) {
            return fail(fmt::format("{}: has no column \"{}\" (tab-separated)", file, name));
        }
    }
    std::vector<BeatIndexRow> rows;
    std::set<std::string> names;
    while (lines.next()) {
        auto row = row_of(cells_of(lines.line()), column("name"), column("class"));
        if (!row) {
            return fail(std::move(row.error()).in(lines.place_in(file)));
        }
        // Two rows of one name would read, and count, the same excerpt twice.
        if (!names.insert(row->name).second) {
            return fail(fmt::format("{}: \"{}\" comes twice", lines.place_in(file), row->name));
        }
        rows.push_back(std::move(*row));
    }
    if (rows.empty()) {
        return fail(file + ": lists no excerpts");
    }
    return rows;
}

Expected<BeatList> parse_beats(std::string_view text, const std::string& file) {
    std::vector<BeatLine> beats;
    TextLines lines(text);
    while (lines.next()) {
        auto beat = parse_beat(lines.line());
        if (!beat) {
            return fail(std::move(beat.error()).in(lines.place_in(file)));
        }
        // A mixed file would leave bar_positions shorter than times.
        if (!beats.empty() && beat->bar_position.has_value() != beats[0].bar_position.has_value()) {
            return fail(fmt::format("{}: must have a bar position in all lines or none",
                                    lines.place_in(file)));
        }
        beats.push_back(*beat);
    }
    return sorted(beats);
}

std::string beats_text(const BeatList& beats) {
    std::string text;
    for (std::size_t i = 0; i < beats.times.size(); ++i) {
        text += fmt::format("{:.6f}", beats.times[i]);
        if (!beats.bar_positions.empty()) {
            text += fmt::format("\t{}", beats.bar_positions[i]);
        }
        text += '\n';
    }
    return text;
}

Expected<std::vector<BeatExcerpt>> load_beat_corpus(const fs::path& folder) {
    const fs::path index = folder / "index.tsv";
    const auto text = read_text_file(index, kMaxBytes);
    if (!text) {
        return fail(text.error());
    }
    auto rows = parse_beat_index(*text, index.string());
    if (!rows) {
        return fail(std::move(rows.error()));
    }
    std::vector<BeatExcerpt> excerpts;
    for (BeatIndexRow& row : *rows) {
        auto reference = load_reference(folder / (row.name + ".beats"));
        if (!reference) {
            return fail(std::move(reference.error()));
        }
        auto audio = find_sound(folder, row.name);
        if (!audio) {
            return fail(std::move(audio.error()));
        }
        excerpts.push_back({std::move(row.name),
                            std::move(row.category),
                            std::move(*reference),
                            std::move(*audio)});
    }
    return excerpts;
}

Expected<std::optional<BeatEstimate>> load_beat_estimate(const fs::path& folder,
                                                         const std::string& name) {
    std::error_code ignored;
    const fs::path beats_path = folder / (name + ".beats");
    // No estimate for this excerpt is not an error: a tracker may have been run on a part of the
    // corpus.
    if (!fs::exists(beats_path, ignored)) {
        return std::optional<BeatEstimate>();
    }
    auto beats = load_beats(beats_path);
    if (!beats) {
        return fail(std::move(beats.error()));
    }
    BeatEstimate estimate{std::move(*beats), std::nullopt};
    const fs::path predicted_path = folder / (name + ".pred");
    if (fs::exists(predicted_path, ignored)) {
        auto predicted = load_beats(predicted_path);
        if (!predicted) {
            return fail(std::move(predicted.error()));
        }
        estimate.predicted = std::move(predicted->times);
    }
    return std::optional(std::move(estimate));
}

// An estimate that does not predict leaves no .pred file, not an empty one.
Expected<void> save_beat_estimate(const fs::path& folder,
                                  const std::string& name,
                                  const BeatEstimate& estimate) {
    auto written = write_file(folder / (name + ".beats"), beats_text(estimate.beats));
    if (written && estimate.predicted) {
        written = write_file(folder / (name + ".pred"), beats_text({*estimate.predicted, {}}));
    }
    return written;
}

}  // namespace raks::audio
