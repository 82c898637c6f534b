#include "motion/figures/label_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "base/file.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kMaxTableBytes = std::size_t{64} << 20U;  // 64 MiB
constexpr double kLastFrame = 1e9;                              // so that frames fit an int

// Cells between separators; empty ones count.
std::vector<std::string_view> split(std::string_view line, char separator) {
    std::vector<std::string_view> cells;
    for (;;) {
        const std::size_t at = line.find(separator);
        cells.push_back(line.substr(0, at));
        if (at == std::string_view::npos) {
            return cells;
        }
        line.remove_prefix(at + 1);
    }
}

/// Walks over the rows of a table. It remembers the first fault only, so that callers may read a
/// whole row before they look.
class Table {
 public:
    Table(std::string_view text, const std::string& name) : rest_(text), name_(name) {
        if (next_line()) {
            // The first line with content names the columns.
            for (std::size_t i = 0; i < cells_.size(); ++i) {
                columns_.emplace(std::string(cells_[i]), i);
            }
        } else {
            complain_about_file("is empty, must start with a line of column names");
        }
    }

    /// Complains about columns that are missing.
    void require(std::initializer_list<const char*> columns) {
        for (const char* column : columns) {
            if (!has(column)) {
                complain_about_file(fmt::format("has no column \"{}\" (tab-separated)", column));
            }
        }
    }
    [[nodiscard]] bool has(const std::string& column) const { return columns_.count(column) > 0; }

    /// Moves to the next row; false at the end or after a fault.
    bool next() { return !fault_ && next_line(); }

    /// The cell of a column, which must exist, in this row.
    [[nodiscard]] std::string text(const std::string& column) {
        const std::size_t at = columns_.at(column);
        if (at >= cells_.size()) {
            complain(fmt::format("has no {}", column));
            return {};
        }
        return std::string(cells_[at]);
    }
    /// The cell as a number in [lowest, highest]; after a complaint `lowest`, a valid value.
    [[nodiscard]] double number(const std::string& column, double lowest, double highest) {
        const std::string cell = text(column);
        double value = 0.0;
        // from_chars does not depend on the locale, and the whole cell must be the number.
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (error != std::errc() || end != cell.data() + cell.size()) {
            complain(fmt::format("{} is \"{:.20}\", must be a number", column, cell));
            return lowest;
        }
        // NaN fails, too.
        if (!(value >= lowest && value <= highest)) {
            complain(
                fmt::format("{} is {:.20}, must lie in [{}, {}]", column, cell, lowest, highest));
            return lowest;
        }
        return value;
    }
    /// The cell as an integer.
    [[nodiscard]] int whole(const std::string& column, double lowest, double highest) {
        const double value = number(column, lowest, highest);
        if (value != std::floor(value)) {
            complain(fmt::format("{} is {}, must be a whole number", column, value));
        }
        return static_cast<int>(value);
    }
    /// The cell as a frame number.
    [[nodiscard]] std::size_t frame(const std::string& column) {
        return static_cast<std::size_t>(whole(column, 0, kLastFrame));
    }

    /// Records a fault in this row, unless there is one already.
    void complain(const std::string& what) {
        if (!fault_) {
            fault_ = Error{fmt::format("{}: line {}: {}", name_, line_, what)};
        }
    }
    [[nodiscard]] std::size_t line() const noexcept { return line_; }
    [[nodiscard]] const std::optional<Error>& fault() const noexcept { return fault_; }

 private:
    /// Records a fault that has no row.
    void complain_about_file(const std::string& what) {
        if (!fault_) {
            fault_ = Error{fmt::format("{}: {}", name_, what)};
        }
    }
    /// Moves to the next line with content and splits it into cells.
    bool next_line() {
        while (!rest_.empty()) {
            const std::size_t end = std::min(rest_.find('\n'), rest_.size());
            std::string_view line = rest_.substr(0, end);
            rest_.remove_prefix(std::min(end + 1, rest_.size()));
            ++line_;
            // Tables from Windows end their lines with CRLF.
            if (!line.empty() && line.back() == '\r') {
                line.remove_suffix(1);
            }
            if (!line.empty() && line.front() != '#') {
                cells_ = split(line, '\t');
                return true;
            }
        }
        return false;
    }

    std::string_view rest_;  // what is not read yet
    std::string name_;
    std::size_t line_ = 0;                        // number of the line last read
    std::vector<std::string_view> cells_;         // of that line; views into the text
    std::map<std::string, std::size_t> columns_;  // index by name
    std::optional<Error> fault_;
};

// Lead, with a complaint, where the role is unknown.
DanceRole role_in(Table& table) {
    const std::string role = table.text("role");
    const auto found = std::find(kRoleNames.begin(), kRoleNames.end(), role);
    if (found == kRoleNames.end()) {
        table.complain(fmt::format("role is \"{:.20}\", must be lead or follow", role));
        return DanceRole::lead;
    }
    return static_cast<DanceRole>(found - kRoleNames.begin());
}

// One row of a label table.
FigureLabel label_in(Table& table) {
    FigureLabel label;
    label.line = table.line();
    label.take = table.text("take");
    label.role = role_in(table);
    label.start = table.frame("start");
    label.end = table.frame("end");
    label.figure = table.text("figure");
    label.beats = table.has("beats") ? table.whole("beats", 1, 64) : 0;
    // Without a length at least one beat is assumed.
    const std::size_t beats = static_cast<std::size_t>(std::max(label.beats, 1));
    if (table.has("start_count")) {
        // A count lies within the figure; without its length only the longest figure limits it.
        label.start_count = table.whole("start_count", 1, label.beats == 0 ? 64 : label.beats);
    }
    if (table.has("confidence")) {
        label.confidence = table.number("confidence", 0.0, 1.0);
    }
    if (table.has("split")) {
        label.split = table.text("split");
    }
    if (label.end <= label.start) {
        table.complain(fmt::format("end is {}, must be after start ({})", label.end, label.start));
    } else if (label.end - label.start < 4 * beats) {
        table.complain(fmt::format(
            "{} frames for {} beats: must be at least 4 a beat", label.end - label.start, beats));
    }
    return label;
}

/// The first overlap between two labels of one take: labels of a take are sorted by start, so only
/// neighbours need comparing.
std::optional<Error> overlap_in(const std::vector<FigureLabel>& labels, const std::string& name) {
    // By take.
    std::map<std::string, std::vector<const FigureLabel*>> takes;
    for (const FigureLabel& label : labels) {
        takes[label.take].push_back(&label);
    }
    for (auto& [take, list] : takes) {
        std::sort(list.begin(), list.end(), [](const FigureLabel* a, const FigureLabel* b) {
            return a->start < b->start;
        });
        for (std::size_t i = 1; i < list.size(); ++i) {
            if (list[i]->start < list[i - 1]->end) {
                return Error{fmt::format("{}: line {}: {} {}-{} overlaps line {} ({}-{})",
                                         name,
                                         list[i]->line,
                                         take,
                                         list[i]->start,
                                         list[i]->end,
                                         list[i - 1]->line,
                                         list[i - 1]->start,
                                         list[i - 1]->end)};
            }
        }
    }
    return std::nullopt;
}

// Reads a file and passes it to one of the parsers.
template <typename Parse>
auto load(const std::filesystem::path& path, const Parse& parse)
    -> decltype(parse(std::string_view(), std::string())) {
    const Expected<std::string> text = read_text_file(path, kMaxTableBytes);
    if (!text) {
        return fail(text.error());
    }
    return parse(*text, path.filename().string());
}

}  // namespace

Expected<std::vector<FigureLabel>> parse_labels(std::string_view text,
                                                const std::string& name,
                                                BeatsColumn beats) {
    Table table(text, name);
    table.require({"take", "role", "start", "end", "figure"});
    if (beats == BeatsColumn::required) {
        table.require({"beats"});
    }
    std::vector<FigureLabel> labels;
    while (table.next()) {
        labels.push_back(label_in(table));
    }
    if (table.fault()) {
        return fail(*table.fault());
    }
    // Faults of single rows come first.
    if (const std::optional<Error> fault = overlap_in(labels, name)) {
        return fail(*fault);
    }
    return labels;
}

std::string labels_text(std::span<const FigureLabel> labels, std::span<const std::string> remarks) {
    std::string text;
    for (const std::string& remark : remarks) {
        text += "# " + remark + "\n";
    }
    text += "take\trole\tstart\tend\tfigure\tbeats\tconfidence\n";
    for (const FigureLabel& label : labels) {
        text += fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\n",
                            label.take,
                            kRoleNames[static_cast<std::size_t>(label.role)],
                            label.start,
                            label.end,
                            label.figure,
                            label.beats,
                            label.confidence);
    }
    return text;
}

Expected<std::vector<CountTime>> parse_counts(std::string_view text, const std::string& name) {
    Table table(text, name);
    // Counts may be common to a pair of takes, lead's and follow's.
    const std::string take = table.has("take_pair") ? "take_pair" : "take";
    table.require({take.c_str(), "count", "frame"});
    std::vector<CountTime> counts;
    // Last frame by take.
    std::map<std::string, double> last;
    while (table.next()) {
        CountTime time{table.text(take),
                       table.whole("count", 1, 64),
                       table.number("frame", -kLastFrame, kLastFrame)};
        const auto found = last.find(time.take);
        // Counts follow one another in time.
        if (found != last.end() && !(time.frame > found->second)) {
            table.complain(fmt::format(
                "frame is {}, must be after the count before ({})", time.frame, found->second));
        }
        last[time.take] = time.frame;
        counts.push_back(std::move(time));
    }
    if (table.fault()) {
        return fail(*table.fault());
    }
    return counts;
}

Expected<std::vector<TakeBeat>> parse_take_beats(std::string_view text, const std::string& name) {
    constexpr double kLongestTake = 24.0 * 3600.0;  // seconds
    Table table(text, name);
    table.require({"take", "time", "half", "used"});
    std::vector<TakeBeat> beats;
    std::map<std::string, double> last;
    while (table.next()) {
        TakeBeat beat{table.text("take"),
                      table.number("time", 0.0, kLongestTake),
                      table.whole("half", 1, 2),
                      table.whole("used", 0, 1) == 1,
                      table.line()};
        if (beat.take.empty()) {
            table.complain("take is empty, must be the clip's name");
        }
        const auto found = last.find(beat.take);
        if (found != last.end() && !(beat.time > found->second)) {
            table.complain(fmt::format(
                "time is {}, must be after the beat before ({})", beat.time, found->second));
        }
        last[beat.take] = beat.time;
        beats.push_back(std::move(beat));
    }
    if (table.fault()) {
        return fail(*table.fault());
    }
    if (beats.empty()) {
        return fail(name + ": holds no beats, must have a row for each");
    }
    return beats;
}

Expected<std::vector<CaptureFault>> parse_faults(std::string_view text, const std::string& name) {
    Table table(text, name);
    table.require({"take", "from", "to", "joints"});
    std::vector<CaptureFault> faults;
    while (table.next()) {
        CaptureFault fault{
            table.text("take"), table.frame("from"), table.frame("to"), table.text("joints")};
        if (fault.to < fault.from) {
            table.complain(
                fmt::format("to is {}, must not be before from ({})", fault.to, fault.from));
        }
        faults.push_back(std::move(fault));
    }
    if (table.fault()) {
        return fail(*table.fault());
    }
    return faults;
}

Expected<std::vector<FigureLabel>> load_labels(const std::filesystem::path& path,
                                               BeatsColumn beats) {
    return load(path, [beats](std::string_view text, const std::string& name) {
        return parse_labels(text, name, beats);
    });
}
Expected<std::vector<CountTime>> load_counts(const std::filesystem::path& path) {
    return load(path, parse_counts);
}
Expected<std::vector<TakeBeat>> load_take_beats(const std::filesystem::path& path) {
    return load(path, parse_take_beats);
}
Expected<std::vector<CaptureFault>> load_faults(const std::filesystem::path& path) {
    return load(path, parse_faults);
}

}  // namespace raks::motion
