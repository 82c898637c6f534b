#include "base/printable.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/utf8.hpp"

namespace raks {
namespace {

/// Bytes of the UTF-8 character at the start of `text`; 0 where there is none that can be shown.
std::size_t character_size(std::string_view text) {
    const std::size_t size = utf8_size(text);
    // Unsigned, so that comparisons with 0x80 and above work.
    const auto byte_at = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    // Of ASCII with delete, and C1.
    const bool is_control = (size == 1 && (byte_at(0) < ' ' || byte_at(0) == 0x7FU)) ||
                            (size == 2 && byte_at(0) == 0xC2U && byte_at(1) < 0xA0U);
    // What ends a line or turns the direction of what follows (U+2028 to U+202E, U+2066 to U+2069):
    // a name with one of these makes the rest of a line read as something else.
    const bool turns_line = size == 3 && byte_at(0) == 0xE2U &&
                            ((byte_at(1) == 0x80U && byte_at(2) >= 0xA8U && byte_at(2) <= 0xAEU) ||
                             (byte_at(1) == 0x81U && byte_at(2) >= 0xA6U && byte_at(2) <= 0xA9U));
    return is_control || turns_line ? 0 : size;
}

}  // namespace

std::string printable(std::string_view text, std::size_t longest) {
    std::string result;
    // A bad byte is replaced alone; reading goes on at the next one.
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        result += size > 0 ? text.substr(0, size) : "?";
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    if (result.size() <= longest) {
        return result;
    }
    // Keeps both ends, and moves the cuts so that no character is split.
    std::size_t head = longest / 2;
    std::size_t tail = result.size() - longest / 2;
    while (head > 0 && is_utf8_continuation(result[head])) {
        --head;
    }
    while (tail < result.size() && is_utf8_continuation(result[tail])) {
        ++tail;
    }
    return result.substr(0, head) + "..." + result.substr(tail);
}

}  // namespace raks
