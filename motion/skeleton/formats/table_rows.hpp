// Table rows: the cells of a text table, whose blank cells count.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::motion {

/// One row with content.
struct TableRow {
    std::vector<std::string_view> cells;  ///< without blanks and quotes around them
    std::size_t number = 0;               ///< of its line, counted from 1
};

/// Takes rows off a text, line by line, as views into it; rows without content are passed over.
class TableRows {
 public:
    /// `text` without a byte order mark.
    TableRows(std::string_view text, char separator) : rest_(text), separator_(separator) {}

    /// The next row; false: there is none.
    [[nodiscard]] bool next(TableRow& row);

 private:
    std::string_view rest_;
    char separator_;
    std::size_t number_ = 0;
};

/// A cell as a number; NaN: blank or "nan". Errors: the word, without its place.
[[nodiscard]] Expected<double> number_of_cell(std::string_view cell);

/// The text without a byte order mark at its start.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);

}  // namespace raks::motion
