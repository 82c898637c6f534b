#pragma once

#include <string_view>

namespace raks::fuzz {

/// Ends the program where a promise is broken.
inline void must(bool is_kept) {
    if (!is_kept) {
        __builtin_trap();
    }
}

/// Errors and warnings are one line each.
inline void must_be_one_line(std::string_view text) {
    must(text.find_first_of("\n\r") == std::string_view::npos);
}

}  // namespace raks::fuzz
