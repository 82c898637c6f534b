#include "engine/control/help_lines.hpp"

#include <array>
#include <cstddef>

namespace raks::engine {
namespace {

// More keys than this on one line are written as a range from the first to the last.
constexpr std::size_t kMostCaps = 3;

// Appends the lines of one action. Neighbouring keys with the same text share a line; a key without
// a text of its own has the row's. `first` keeps a line of the action before from being extended.
void add_keys(const ActionRow& row, std::vector<HelpLine>& lines) {
    const std::size_t first = lines.size();
    for (const ActionKey& key : row.keys()) {
        const std::string_view text = key.help.empty() ? row.help : key.help;
        if (lines.size() == first || lines.back().text != text) {
            lines.push_back({row.group, {}, text});
        }
        lines.back().keys.emplace_back(key.name);
    }
}

// Nine digits would not fit the panel: "1" to "9" become "1-9". The row's keys are consecutive.
void join_many(HelpLine& line) {
    if (line.keys.size() > kMostCaps) {
        line.keys = {line.keys.front() + "-" + line.keys.back()};
    }
}

}  // namespace

std::string_view title_of(ActionGroup group) noexcept {
    // In the order of ActionGroup.
    constexpr std::array<std::string_view, 5> kTitles = {
        "PLAYING", "TEMPO", "DANCE", "VIEW", "WINDOW"};
    return kTitles[static_cast<std::size_t>(group)];
}

std::vector<HelpLine> help_lines(const std::function<bool(Action)>& is_there) {
    std::vector<HelpLine> lines;
    for (const ActionRow& row : action_table()) {
        if (is_there(row.action)) {
            add_keys(row, lines);
        }
    }
    // Joined last: add_keys() extends a line key by key.
    for (HelpLine& line : lines) {
        join_many(line);
    }
    return lines;
}

}  // namespace raks::engine
