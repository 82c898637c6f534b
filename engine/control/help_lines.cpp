#include "engine/control/help_lines.hpp"

#include <array>
#include <cstddef>

namespace raks::engine {
namespace {

constexpr std::size_t kMostCaps = 3;  // more keys on a line become a range

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

void join_many(HelpLine& line) {
    if (line.keys.size() > kMostCaps) {
        line.keys = {line.keys.front() + "-" + line.keys.back()};
    }
}

}  // namespace

std::string_view title_of(ActionGroup group) noexcept {
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
    for (HelpLine& line : lines) {
        join_many(line);
    }
    return lines;
}

}  // namespace raks::engine
