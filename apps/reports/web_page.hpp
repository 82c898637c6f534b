#pragma once

#include <string>
#include <string_view>

namespace raks::apps {

/// Text for XML: escaped, control characters as blanks, what is not UTF-8 as U+FFFD.
[[nodiscard]] std::string xml_text(std::string_view text);

/// An HTML page that needs nothing else, as all reports look: `title` as text above `body`, which
/// is HTML. Cells of classes `own`, `wrong` and `none` are green, red and pale.
[[nodiscard]] std::string web_page(std::string_view title, std::string_view body);

}  // namespace raks::apps
