#include "base/text_file.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "base/file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks {
namespace {

class TextFile : public ::testing::Test {
 protected:
    Expected<std::string> read(std::string_view bytes) const {
        EXPECT_TRUE(write_file(path_, bytes));
        return read_text_file(path_, 1000);
    }
    void expect_refused(std::string_view bytes, const char* part) const {
        const auto text = read(bytes);
        ASSERT_FALSE(text) << *text;
        EXPECT_TRUE(text.error().message.starts_with(path_.string() + ": "));
        EXPECT_NE(text.error().message.find(part), std::string::npos) << text.error().message;
    }
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "text";
};

TEST_F(TextFile, lines_end_alike_whoever_wrote_them) {
    EXPECT_EQ(read("a\nb\n").value(), "a\nb\n");
    EXPECT_EQ(read("a\r\nb\r\n").value(), "a\nb\n");
    EXPECT_EQ(read("a\rb\r").value(), "a\nb\n");
    EXPECT_EQ(read("a\r\n\rb\n\r").value(), "a\n\nb\n\n");
    EXPECT_EQ(read("").value(), "");
}

TEST_F(TextFile, the_mark_of_utf8_is_taken_off) {
    EXPECT_EQ(read("\xef\xbb\xbftake\t\u00fc").value(), "take\t\u00fc");
}

TEST_F(TextFile, what_is_no_utf8_text_is_refused) {
    using namespace std::string_view_literals;
    expect_refused(
        "\xff\xfe"
        "a\0b\0"sv,
        "UTF-16");
    expect_refused("\xfe\xff\0a\0b"sv, "UTF-16");
    expect_refused("a\nb\0c"sv, "line 2: holds a zero byte");
    expect_refused(std::string(1001, 'x'), "larger than");
}

}  // namespace
}  // namespace raks
