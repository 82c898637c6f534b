// Reading TOML: no text ends the program, and every fault has its line and column.
#include "base/toml_reader.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/mangled.hpp"

namespace raks {
namespace {

std::string fault_of(const std::string& text) {
    const auto parsed = parse_toml(text, "x.toml");
    return parsed ? "" : parsed.error().message;
}

TEST(TomlReader, says_line_and_column_of_a_slip) {
    const struct {
        std::string text;
        std::string fault;
    } cases[] = {
        {"a=[}", "x.toml: line 1, column 4: '}' cannot stand here"},
        {"tempo = [78, 90, }\n", "x.toml: line 1, column 18: '}' cannot stand here"},
        {"a = 1\n[\n", "x.toml: line 2, column 2: something is missing here"},
        {"[#]", "x.toml: line 1, column 2: '#' cannot stand here"},
        {"a = 1\na = 2\n", "x.toml: line 2, column 5: "},
        {"a = \"", "x.toml: line 1, column 6: "},
        {"a", "x.toml: line 1, column 2: "},
    };
    for (const auto& c : cases) {
        EXPECT_TRUE(fault_of(c.text).starts_with(c.fault)) << c.text << ": " << fault_of(c.text);
    }
}

TEST(TomlReader, reads_what_is_good) {
    const auto parsed = parse_toml("a.b = [1.5, 2]\n[\"c.d\"]\ne = 'x.y'\n", "x.toml");
    ASSERT_TRUE(parsed) << parsed.error().message;
    EXPECT_EQ(parsed->at_path("a.b[0]").value_or(0.0), 1.5);
    EXPECT_EQ((*parsed)["c.d"]["e"].value_or(std::string()), "x.y");
}

TEST(TomlReader, refuses_what_would_fill_the_stack) {
    const auto times = [](std::size_t count, const std::string& part) {
        std::string text;
        for (std::size_t i = 0; i < count; ++i) {
            text += part;
        }
        return text;
    };
    EXPECT_EQ(fault_of(times(200'000, "a.") + "a = 1"),
              "x.toml: line 1, column 32: a key of more than 16 parts");
    EXPECT_EQ(fault_of("b = 1\n[" + times(200'000, "'a'.") + "a]"),
              "x.toml: line 2, column 65: a key of more than 16 parts");
    EXPECT_TRUE(fault_of("a = " + times(200'000, "[")).find("nested") != std::string::npos);
    EXPECT_TRUE(fault_of("a = " + times(100'000, "{a=")).find("nested") != std::string::npos);
    EXPECT_TRUE(fault_of(std::string(kLongestToml + 1, '\n')).find("more than") !=
                std::string::npos);
    // As many parts as are allowed, and dots that are in no key.
    EXPECT_EQ(fault_of(times(15, "a.") + "a = 1"), "");
    EXPECT_EQ(fault_of("a = '" + times(100, "..") + "' # " + times(100, "a.")), "");
    EXPECT_EQ(fault_of("a = [" + times(100, "0.5, ") + "1.5]"), "");
    EXPECT_EQ(fault_of("a = \"\"\"\n" + times(100, "..\n") + "\"\"\"\nb = 1"), "");
}

// toml++ 3.3 takes some of them, such as U+010F, for impossible.
TEST(TomlReader, has_letters_beyond_ascii_in_quotes_and_comments_only) {
    EXPECT_EQ(fault_of("a = 1\nb \xC4\x8F= 2"),
              "x.toml: line 2, column 3: letters beyond ASCII stand only in quotes and comments");
    EXPECT_EQ(fault_of("\xEF\xBB\xBF\"\xC4\x8F\" = '\xC4\x8F' # \xC4\x8F"), "");
}

// Cut at every byte and with bytes of any value: it is read or refused, in one line.
TEST(TomlReader, ends_with_every_text) {
    const std::string good =
        "a = [1, 2.5, { b = 'c' }]\n[d.\"e f\"]\ng = \"\"\"h\\u00e4\"\"\"\n[[i]]\nj = 1979-05-27\n";
    for (std::size_t size = 0; size <= good.size(); ++size) {
        EXPECT_EQ(fault_of(good.substr(0, size)).find('\n'), std::string::npos) << size;
    }
    for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
        const std::string text = test::mangled(good, {.seed = seed, .bytes = 1 + seed % 4});
        EXPECT_EQ(fault_of(text).find('\n'), std::string::npos) << seed;
    }
}

}  // namespace
}  // namespace raks
