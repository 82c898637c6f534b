#pragma once

#include <cstddef>
#include <string_view>

namespace raks {

/// The first line, from 1, that begins as a table's header, "[" or "[[", with no name behind it; 0:
/// there is none before the first other fault. toml++ 3.3 breaks its own promise on such a line (an
/// assertion, or worse without assertions: marzer/tomlplusplus, pull request 301), so that a text
/// is asked this first.
[[nodiscard]] std::size_t line_of_nameless_header(std::string_view toml) noexcept;

}  // namespace raks
