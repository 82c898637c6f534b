#include "engine/import/collada_text.hpp"

#include <cstdint>

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr std::size_t kDeepestElement = 256;

void append_utf8(std::uint32_t point, std::string& text) {
    const auto part = [&](std::uint32_t bits) { text += static_cast<char>(bits); };
    if (point < 0x80U) {
        part(point);
    } else if (point < 0x800U) {
        part(0xC0U | point >> 6U);
        part(0x80U | (point & 0x3FU));
    } else if (point < 0x10000U) {
        part(0xE0U | point >> 12U);
        part(0x80U | (point >> 6U & 0x3FU));
        part(0x80U | (point & 0x3FU));
    } else {
        part(0xF0U | point >> 18U);
        part(0x80U | (point >> 12U & 0x3FU));
        part(0x80U | (point >> 6U & 0x3FU));
        part(0x80U | (point & 0x3FU));
    }
}

/// From UTF-16 after its mark. Halves of pairs that stand alone become U+FFFD.
std::string from_utf16(std::string_view bytes, bool is_big_endian) {
    const auto unit = [&](std::size_t at) {
        const auto first = static_cast<unsigned char>(bytes[at]);
        const auto second = static_cast<unsigned char>(bytes[at + 1]);
        return static_cast<std::uint32_t>(is_big_endian ? first << 8U | second
                                                        : second << 8U | first);
    };
    std::string text;
    for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
        std::uint32_t point = unit(at);
        const bool is_high = point >= 0xD800U && point < 0xDC00U;
        const std::uint32_t low = is_high && at + 3 < bytes.size() ? unit(at + 2) : 0;
        if (low >= 0xDC00U && low < 0xE000U) {
            point = 0x10000U + ((point - 0xD800U) << 10U) + (low - 0xDC00U);
            at += 2;
        } else if (point >= 0xD800U && point < 0xE000U) {
            point = 0xFFFDU;
        }
        append_utf8(point, text);
    }
    return text;
}

/// Says that the file is in UTF-8, which it is now.
void set_encoding(std::string& text) {
    constexpr std::string_view kEncoding = "encoding=";
    const std::size_t head = text.find("?>");
    const std::size_t at = text.find(kEncoding);
    if (at == std::string::npos || head == std::string::npos || at > head) {
        return;
    }
    const std::size_t quote = at + kEncoding.size();
    const std::size_t end = text.find(text[quote], quote + 1);
    if (end != std::string::npos && end < head) {
        text.replace(quote + 1, end - quote - 1, "utf-8");
    }
}

Expected<std::string> as_utf8(std::string_view bytes) {
    const std::string_view mark = bytes.substr(0, 2);
    if (mark == "\xFF\xFE" || mark == "\xFE\xFF") {
        if (bytes.size() % 2 != 0) {
            return fail("is UTF-16 that is cut off");
        }
        std::string text = from_utf16(bytes.substr(2), mark == "\xFE\xFF");
        set_encoding(text);
        return text;
    }
    return std::string(bytes);
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool begins_number(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.'; }

/// Without blanks between a tag and the number that follows it.
std::string without_blanks(std::string_view text) {
    std::string tight;
    tight.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
        tight += text[at];
        const bool is_tag_end = text[at] == '>';
        ++at;
        if (!is_tag_end) {
            continue;
        }
        std::size_t next = at;
        while (next < text.size() && is_space(text[next])) {
            ++next;
        }
        if (next < text.size() && begins_number(text[next])) {
            at = next;
        }
    }
    return tight;
}

/// Elements inside one another, by their tags alone: assimp goes down by calling itself.
Expected<void> check_depth(std::string_view text) {
    std::size_t depth = 0;
    for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at + 1)) {
        const std::size_t end = text.find('>', at);
        if (end == std::string_view::npos) {
            return fail("is cut off within an element");
        }
        const char next = text[at + 1];
        if (next == '/') {
            depth -= depth > 0 ? 1 : 0;
        } else if (next != '!' && next != '?' && text[end - 1] != '/' &&
                   ++depth > kDeepestElement) {
            return fail(
                fmt::format("has more than {} elements inside one another", kDeepestElement));
        }
    }
    return {};
}

/// What assimp reads past in silence: corners before the first, and steps of no length.
Expected<void> check_numbers(std::string_view text) {
    for (std::size_t at = text.find("<p>"); at < text.size(); at = text.find("<p>", at + 1)) {
        const std::string_view list = text.substr(at, text.find('<', at + 1) - at);
        if (list.find('-') != std::string_view::npos) {
            return fail("has a corner with a negative number");
        }
    }
    if (text.find("stride=\"0\"") != std::string_view::npos) {
        return fail("has a source with stride 0");
    }
    return {};
}

}  // namespace

Expected<std::string> mended_collada(std::string_view bytes) {
    auto text = as_utf8(bytes);
    if (!text) {
        return fail(text.error());
    }
    if (text->find("<COLLADA") == std::string::npos || text->find('\0') != std::string::npos) {
        return fail("is not Collada");
    }
    if (text->find("<!ENTITY") != std::string::npos) {
        return fail("it defines entities of its own, which are not read");
    }
    if (auto good = check_depth(*text); !good) {
        return fail(good.error());
    }
    if (auto good = check_numbers(*text); !good) {
        return fail(good.error());
    }
    return without_blanks(*text);
}

}  // namespace raks::engine
