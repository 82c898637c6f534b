#include "engine/control/help_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace raks::engine {
namespace {

std::vector<HelpLine> all_lines() {
    return help_lines([](Action) { return true; });
}

const HelpLine* line_of(const std::vector<HelpLine>& lines, std::string_view text) {
    const auto at = std::find_if(
        lines.begin(), lines.end(), [&](const HelpLine& line) { return line.text == text; });
    return at == lines.end() ? nullptr : &*at;
}

TEST(HelpLines, say_each_thing_once_with_its_keys_group_by_group) {
    const auto lines = all_lines();
    std::set<std::string_view> texts;
    for (const HelpLine& line : lines) {
        EXPECT_TRUE(texts.insert(line.text).second) << line.text;
        EXPECT_FALSE(line.keys.empty()) << line.text;
        EXPECT_FALSE(title_of(line.group).empty());
    }
    EXPECT_TRUE(std::is_sorted(lines.begin(), lines.end(), [](const auto& a, const auto& b) {
        return a.group < b.group;
    }));
}

TEST(HelpLines, put_keys_of_one_thing_on_one_line) {
    using Keys = std::vector<std::string>;
    const auto lines = all_lines();
    ASSERT_NE(line_of(lines, "back, forward 5 s"), nullptr);
    EXPECT_EQ(line_of(lines, "back, forward 5 s")->keys, (Keys{"Left", "Right"}));
    EXPECT_EQ(line_of(lines, "back, forward 30 s")->keys, (Keys{"Shift+Left", "Shift+Right"}));
    EXPECT_EQ(line_of(lines, "full screen")->keys, (Keys{"F", "F11"}));
    EXPECT_EQ(line_of(lines, "this figure")->keys, (Keys{"1-9"}));
}

TEST(HelpLines, name_every_key_of_the_table) {
    std::set<std::string> named;
    for (const HelpLine& line : all_lines()) {
        named.insert(line.keys.begin(), line.keys.end());
    }
    for (const ActionRow& row : action_table()) {
        for (const ActionKey& key : row.keys()) {
            const bool is_digit = key.name >= "1" && key.name <= "9" && key.name.size() == 1;
            EXPECT_EQ(named.count(is_digit ? "1-9" : std::string(key.name)), 1U) << key.name;
        }
    }
}

TEST(HelpLines, leave_out_what_is_not_there) {
    const auto lines = help_lines([](Action action) { return action == Action::quit; });
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].text, "quit");
    EXPECT_TRUE(help_lines([](Action) { return false; }).empty());
}

}  // namespace
}  // namespace raks::engine
