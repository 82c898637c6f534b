#include "base/utf8.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace raks {
namespace {

using namespace std::string_view_literals;

/// RFC 3629, section 3.
std::string encoded(std::uint32_t point) {
    const auto byte = [](std::uint32_t value) { return static_cast<char>(value); };
    const auto more = [&](std::uint32_t shift) { return byte(0x80U | (point >> shift & 0x3FU)); };
    if (point < 0x80U) {
        return {byte(point)};
    }
    if (point < 0x800U) {
        return {byte(0xC0U | point >> 6U), more(0)};
    }
    if (point < 0x1'0000U) {
        return {byte(0xE0U | point >> 12U), more(6), more(0)};
    }
    return {byte(0xF0U | point >> 18U), more(12), more(6), more(0)};
}

TEST(Utf8, every_character_has_its_size_and_is_cut_nowhere) {
    for (std::uint32_t point = 0; point < 0x11'0000U; ++point) {
        const std::string text = encoded(point) + "z";
        const bool is_surrogate = point >= 0xD800U && point < 0xE000U;
        ASSERT_EQ(utf8_size(text), is_surrogate ? 0 : text.size() - 1) << std::hex << point;
    }
    for (const std::uint32_t point : {0xE9U, 0x266BU, 0x1F57AU}) {
        const std::string text = encoded(point);
        for (std::size_t size = 0; size < text.size(); ++size) {
            EXPECT_EQ(utf8_size(std::string_view(text).substr(0, size)), 0U);
        }
    }
}

TEST(Utf8, what_is_none_has_no_size) {
    for (const std::string_view text : {""sv,
                                        "\x80"sv,
                                        "\xbfz"sv,
                                        "\xc0\x80"sv,  // overlong forms
                                        "\xc1\xbf"sv,
                                        "\xe0\x9f\xbf"sv,
                                        "\xf0\x8f\xbf\xbf"sv,
                                        "\xed\xa0\x80"sv,      // half of a pair of UTF-16
                                        "\xf4\x90\x80\x80"sv,  // beyond U+10FFFF
                                        "\xf5\x80\x80\x80"sv,
                                        "\xff"sv,
                                        "\xe2\x99z"sv}) {
        EXPECT_EQ(utf8_size(text), 0U) << text;
    }
    EXPECT_EQ(utf8_size("\0"sv), 1U);
    EXPECT_TRUE(is_utf8(""));
    EXPECT_TRUE(is_utf8("S\xC3\xA3o"));
    EXPECT_FALSE(is_utf8("S\xC3"));
    EXPECT_FALSE(is_utf8("\xE3o"));
}

}  // namespace
}  // namespace raks
