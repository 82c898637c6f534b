#pragma once

#include <string>
#include <vector>

namespace raks::apps {

/// One row of a table: its cells.
using Row = std::vector<std::string>;

/// A table in Markdown: columns as wide as their widest cell, the first aligned left, the others
/// right. `rows`: the first is the heads; there is at least that one, and no row is longer or
/// shorter.
[[nodiscard]] std::string text_table(const std::vector<Row>& rows);

}  // namespace raks::apps
