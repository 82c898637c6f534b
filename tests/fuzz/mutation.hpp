#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace raks::fuzz {

/// The text with one to three changes that keep most of its structure. A number, a text in quotes
/// or a list in brackets becomes another one that readers may stumble over (0, -1, 2^31, 1e308,
/// 1e-321, "", "../x", []), of its own kind or of any; brackets, tables or dotted keys nest deep; a
/// line or a member comes twice (its key, too), is missing or stands elsewhere; or a byte is
/// another one. For JSON, TOML and tables alike. The same `seed` gives the same text.
[[nodiscard]] std::string mutated(std::string_view text, std::uint64_t seed);

/// The bytes with one to eight changes: a byte or a number of two or four bytes becomes one at the
/// edge of its range, a stretch comes twice, is missing or is zero, or the end is cut off. The
/// check sums of Ogg's pages are then made right again in three cases of four, so that readers look
/// at what is behind them. The same `seed` gives the same bytes.
[[nodiscard]] std::string mutated_bytes(std::string_view bytes, std::uint64_t seed);

}  // namespace raks::fuzz
