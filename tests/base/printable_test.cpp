#include "base/printable.hpp"

#include <gtest/gtest.h>

namespace raks {
namespace {

TEST(Printable, what_can_be_shown_stays) {
    EXPECT_EQ(printable("x.wav: line 3"), "x.wav: line 3");
    EXPECT_EQ(printable("\u00fc\u4e2d\U0001f483"), "\u00fc\u4e2d\U0001f483");
    EXPECT_EQ(printable(""), "");
}

TEST(Printable, what_would_break_the_line_or_the_terminal_is_shown_as_a_question_mark) {
    EXPECT_EQ(printable("a\nb\r\tc"), "a?b??c");
    EXPECT_EQ(printable("\x1b[31m"), "?[31m");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a?b");
    EXPECT_EQ(printable("\x7f"), "?");
    EXPECT_EQ(printable("\xc2\x9b"), "??");  // a control character of two bytes
}

TEST(Printable, what_turns_the_direction_of_a_line_or_ends_it_does_not_come_through) {
    EXPECT_EQ(printable("song\u202e3pm.exe"), "song???3pm.exe");
    EXPECT_EQ(printable("a\u2028b\u2029c\u2066d\u2069e"), "a???b???c???d???e");
    // Its neighbours are letters, marks and dashes of names.
    EXPECT_EQ(printable("\u2014\u2027\u202f\u2065\u206a\u05d0\u200f"),
              "\u2014\u2027\u202f\u2065\u206a\u05d0\u200f");
}

TEST(Printable, bytes_that_are_not_utf8_do_not_come_through) {
    EXPECT_EQ(printable("a\xff"), "a?");
    EXPECT_EQ(printable("\xc3"), "?");                 // cut off
    EXPECT_EQ(printable("\xc0\xaf"), "??");            // longer than need be
    EXPECT_EQ(printable("\xe0\x80\xaf"), "???");       // the same
    EXPECT_EQ(printable("\xed\xa0\x80"), "???");       // half of a pair of UTF-16
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????");  // beyond Unicode
}

TEST(Printable, of_long_text_both_ends_are_shown) {
    const std::string text = std::string(1000, 'a') + "end";
    EXPECT_EQ(printable(text, 20), "aaaaaaaaaa...aaaaaaaend");
    std::string umlauts;
    for (int i = 0; i < 1000; ++i) {
        umlauts += "\u00fc";
    }
    for (std::size_t longest = 0; longest < 30; ++longest) {
        const std::string cut = printable(umlauts, longest);
        EXPECT_LE(cut.size(), longest + 3);
        EXPECT_EQ(printable(cut), cut) << "cut through a character";
    }
}

}  // namespace
}  // namespace raks
