#pragma once

#include <cstddef>
#include <string_view>

namespace raks {

/// Guards the TOML parser: toml++ 3.3 runs into an assertion, or undefined behaviour without
/// assertions, on a line that begins as a table's header, "[" or "[[", with no name after it
/// (marzer/tomlplusplus, pull request 301). Returns the number of the first such line, from 1; 0
/// when there is none before the first other fault.
[[nodiscard]] std::size_t line_of_nameless_header(std::string_view toml) noexcept;

}  // namespace raks
