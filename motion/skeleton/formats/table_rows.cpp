#include "motion/skeleton/formats/table_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "base/printable.hpp"
#include "motion/skeleton/text_lines.hpp"

namespace raks::motion {
namespace {

std::string_view plain_cell(std::string_view cell) {
    cell = trimmed(cell);
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
        cell = trimmed(cell.substr(1, cell.size() - 2));
    }
    return cell;
}

}  // namespace

bool TableRows::next(TableRow& row) {
    while (!rest_.empty()) {
        const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
        std::string_view line = rest_.substr(0, end);
        const bool is_crlf = end + 1 < rest_.size() && rest_[end] == '\r' && rest_[end + 1] == '\n';
        rest_.remove_prefix(std::min(rest_.size(), end + (is_crlf ? 2U : 1U)));
        ++number_;
        if (trimmed(line).empty()) {
            continue;
        }
        row.cells.clear();
        row.number = number_;
        while (true) {
            const std::size_t cut = std::min(line.find(separator_), line.size());
            row.cells.push_back(plain_cell(line.substr(0, cut)));
            if (cut == line.size()) {
                return true;
            }
            line.remove_prefix(cut + 1);
        }
    }
    return false;
}

Expected<double> number_of_cell(std::string_view cell) {
    if (cell.empty() || lower(cell.substr(0, 8)) == "nan") {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const std::string_view word = cell.front() == '+' ? cell.substr(1) : cell;
    double value = 0.0;
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value);
    if (parsed.ec != std::errc{} || parsed.ptr != word.data() + word.size()) {
        return fail(fmt::format("\"{}\" is not a number", printable(cell, 40)));
    }
    return value;
}

std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    return text.substr(0, kByteOrderMark.size()) == kByteOrderMark
               ? text.substr(kByteOrderMark.size())
               : text;
}

}  // namespace raks::motion
