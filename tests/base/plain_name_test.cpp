#include "base/plain_name.hpp"

#include <gtest/gtest.h>

#include <string>

namespace raks {
namespace {

TEST(PlainName, is_what_stays_in_its_folder) {
    for (const char* const name : {"a", "hip_drop", "R&B", "a.b", "...", "M\xc3\xbcnchen", "a b"}) {
        EXPECT_TRUE(is_plain_name(name)) << name;
    }
    EXPECT_TRUE(is_plain_name(std::string(kLongestPlainName, 'a')));
    for (const char* const name :
         {"", ".", "..", "/", "a/b", "../a", "/etc/x", "a\\b", "a\nb", "\x1b[2J", "\xff", "\x7f"}) {
        EXPECT_FALSE(is_plain_name(name)) << name;
    }
    EXPECT_FALSE(is_plain_name(std::string(kLongestPlainName + 1, 'a')));
    EXPECT_FALSE(is_plain_name(std::string("a\0b", 3)));
}

TEST(PlainName, says_why_in_one_printable_line) {
    EXPECT_EQ(why_no_plain_name("../\x1b\n"),
              "\"../??\" cannot be a name: 1 to 64 bytes, no '/', '\\' or control characters, not "
              "\".\" or "
              "\"..\"");
}

}  // namespace
}  // namespace raks
