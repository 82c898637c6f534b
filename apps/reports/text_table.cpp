#include "apps/reports/text_table.hpp"

#include <algorithm>

#include "base/printable.hpp"

#include <fmt/format.h>

namespace raks::apps {

std::string text_table(const std::vector<Row>& cells) {
    // A cell may be a name out of a file, which must not end the line.
    std::vector<Row> rows = cells;
    for (Row& row : rows) {
        for (std::string& cell : row) {
            cell = printable(cell);
        }
    }
    // At least three characters, as the line below the heads needs.
    std::vector<std::size_t> widths(rows.front().size(), 3);
    for (const Row& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            widths[i] = std::max(widths[i], row[i].size());
        }
    }
    std::string text;
    // The first column holds names, the others numbers.
    for (std::size_t r = 0; r < rows.size(); ++r) {
        for (std::size_t i = 0; i < widths.size(); ++i) {
            text += i == 0 ? fmt::format("| {:<{}} ", rows[r][i], widths[i])
                           : fmt::format("| {:>{}} ", rows[r][i], widths[i]);
        }
        text += "|\n";
        // The line below the heads; ":" aligns a column right.
        if (r == 0) {
            for (std::size_t i = 0; i < widths.size(); ++i) {
                text += i == 0 ? "|" + std::string(widths[i] + 2, '-')
                               : "|" + std::string(widths[i] + 1, '-') + ":";
            }
            text += "|\n";
        }
    }
    return text;
}

}  // namespace raks::apps
