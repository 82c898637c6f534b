#pragma once

#include <string>
#include <vector>

namespace raks::apps {

using Row = std::vector<std::string>;

/// A table in Markdown: columns as wide as their widest cell, the first aligned left. The first row
/// is the heads; there is at least that one, and none is longer.
[[nodiscard]] std::string text_table(const std::vector<Row>& rows);

}  // namespace raks::apps
