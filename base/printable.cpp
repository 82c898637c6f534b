#include "base/printable.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace raks {
namespace {

// Unsigned, so that comparisons with 0x80 and above work.
std::uint8_t byte_at(std::string_view text, std::size_t index) {
    return static_cast<std::uint8_t>(text[index]);
}

bool is_continuation(std::uint8_t byte) { return (byte & 0xC0U) == 0x80U; }

/// Bytes of the UTF-8 character at the start of `text`; 0 where there is none that can be shown.
std::size_t character_size(std::string_view text) {
    const std::uint8_t first = byte_at(text, 0);
    if (first < 0x80U) {
        // ASCII, without control characters and delete.
        return first >= ' ' && first != 0x7FU ? 1 : 0;
    }
    const std::size_t size = first >= 0xF0U ? 4 : first >= 0xE0U ? 3 : 2;
    // 0xC0 and 0xC1 would be overlong; above 0xF4 lies beyond U+10FFFF.
    if (first < 0xC2U || first > 0xF4U || text.size() < size) {
        return 0;
    }
    for (std::size_t i = 1; i < size; ++i) {
        if (!is_continuation(byte_at(text, i))) {
            return 0;
        }
    }
    // Faults that show in the second byte: C1 controls, overlong forms, surrogates, beyond
    // U+10FFFF.
    const std::uint8_t second = byte_at(text, 1);
    const bool is_control = first == 0xC2U && second < 0xA0U;
    const bool is_too_long =
        (first == 0xE0U && second < 0xA0U) || (first == 0xF0U && second < 0x90U);
    const bool is_surrogate = first == 0xEDU && second >= 0xA0U;
    const bool is_beyond = first == 0xF4U && second >= 0x90U;
    return is_control || is_too_long || is_surrogate || is_beyond ? 0 : size;
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
    while (head > 0 && is_continuation(byte_at(result, head))) {
        --head;
    }
    while (tail < result.size() && is_continuation(byte_at(result, tail))) {
        ++tail;
    }
    return result.substr(0, head) + "..." + result.substr(tail);
}

}  // namespace raks
