#pragma once

#include <cstddef>
#include <string_view>

namespace raks {

/// Bytes of the UTF-8 character at the start of `text`, 1 to 4; 0 where there is none, or only a
/// part, or what looks like one (RFC 3629: overlong forms, surrogates, beyond U+10FFFF).
/// Threads: any. Real-time: yes.
[[nodiscard]] std::size_t utf8_size(std::string_view text) noexcept;

/// Whether all of a text is UTF-8; an empty one is. Threads: any. Real-time: no (as long as the
/// text).
[[nodiscard]] bool is_utf8(std::string_view text) noexcept;

/// Whether a byte is one of a UTF-8 character that is not its first: 10xxxxxx.
[[nodiscard]] constexpr bool is_utf8_continuation(char byte) noexcept {
    return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

}  // namespace raks
