#pragma once

#include <string>
#include <string_view>

namespace raks {

/// Makes text of unknown origin (a file name, a word of a damaged file) fit for one line of output:
/// controls, also of direction (U+202E), and bytes that are not UTF-8 become '?'; of more than
/// `longest` bytes the middle is replaced by "...". Printable text is returned unchanged.
///
///     printable("a\nb") == "a?b"
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = 600);

}  // namespace raks
