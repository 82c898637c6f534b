#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace raks::fuzz {

/// The text with one to three changes that keep most of its structure: a number, a text in quotes
/// or a list in brackets becomes another one that readers may stumble over (0, -1, 2^31, 1e308,
/// 1e-321, "", "../x", [], brackets nested deep), a line comes twice (a key, too), is missing or
/// stands elsewhere, or a byte is another one. For JSON, TOML and tables alike. The same `seed`
/// gives the same text.
[[nodiscard]] std::string mutated(std::string_view text, std::uint64_t seed);

}  // namespace raks::fuzz
