#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace raks {

inline constexpr std::size_t kLongestPlainName = 64;  ///< bytes

/// May this text be a name of a dance, a figure or a style, or of a part of a file's name made from
/// one? UTF-8, 1 to kLongestPlainName bytes, no '/', no '\', no control characters, not "." or
/// "..": a name can then never leave its folder nor write to a terminal. Names that people type
/// are held to less still: is_dance_name (base/dance_list.hpp), is_figure_name.
/// Threads: any. Real-time: no.
[[nodiscard]] bool is_plain_name(std::string_view name);

/// One line that quotes the name and says what a name may be; for error messages.
[[nodiscard]] std::string why_no_plain_name(std::string_view name);

}  // namespace raks
