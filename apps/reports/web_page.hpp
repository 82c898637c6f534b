#pragma once

#include <string>
#include <string_view>

namespace raks::apps {

/// Text for XML: escaped; control characters become blanks, bytes that are not UTF-8 U+FFFD.
[[nodiscard]] std::string xml_text(std::string_view text);

/// A self-contained HTML page with the style of all reports: `title` as text above `body`, which is
/// HTML. Cells of classes `own`, `wrong` and `none` are green, red and pale.
[[nodiscard]] std::string web_page(std::string_view title, std::string_view body);

}  // namespace raks::apps
