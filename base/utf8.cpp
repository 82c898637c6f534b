#include "base/utf8.hpp"

namespace raks {

std::size_t utf8_size(std::string_view text) noexcept {
    if (text.empty()) {
        return 0;
    }
    const auto first = static_cast<unsigned char>(text[0]);
    if (first < 0x80U) {
        return 1;
    }
    // 0xC0 and 0xC1 would be overlong; above 0xF4 lies beyond U+10FFFF.
    const std::size_t size = first >= 0xF0U ? 4 : first >= 0xE0U ? 3 : 2;
    if (first < 0xC2U || first > 0xF4U || text.size() < size) {
        return 0;
    }
    for (const char byte : text.substr(1, size - 1)) {
        if (!is_utf8_continuation(byte)) {
            return 0;
        }
    }
    // Faults that show in the second byte.
    const auto second = static_cast<unsigned char>(text[1]);
    const bool is_too_long =
        (first == 0xE0U && second < 0xA0U) || (first == 0xF0U && second < 0x90U);
    const bool is_surrogate = first == 0xEDU && second >= 0xA0U;
    const bool is_beyond = first == 0xF4U && second >= 0x90U;
    return is_too_long || is_surrogate || is_beyond ? 0 : size;
}

bool is_utf8(std::string_view text) noexcept {
    while (!text.empty()) {
        const std::size_t size = utf8_size(text);
        if (size == 0) {
            return false;
        }
        text.remove_prefix(size);
    }
    return true;
}

}  // namespace raks
