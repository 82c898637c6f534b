#pragma once

#include <string>
#include <string_view>

namespace raks {

/// Text of unknown origin (a file's name, a word of a damaged file) as one line for people: control
/// characters and bytes that are not UTF-8 become '?', of more than `longest` bytes the middle is
/// left out. What is printable already is returned as it is.
///
///     printable("a\nb") == "a?b"
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = 600);

}  // namespace raks
