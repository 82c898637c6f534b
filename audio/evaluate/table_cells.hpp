#pragma once

#include <string_view>
#include <vector>

namespace raks::audio {

/// The tab-separated cells of a line; an empty line has one empty cell.
[[nodiscard]] inline std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> cells;
    for (;;) {
        const std::size_t tab = line.find('\t');
        cells.push_back(line.substr(0, tab));
        if (tab == std::string_view::npos) {
            return cells;
        }
        line.remove_prefix(tab + 1);
    }
}

}  // namespace raks::audio
