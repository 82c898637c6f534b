// Themes by name, from files that may be mangled.
#include "engine/show/themes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "base/pending_file.hpp"
#include "engine/show/picture.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

constexpr const char* kHead = "format = \"raks-theme\"\nversion = 1\n";

std::string error_of_theme(const std::string& text) {
    const auto theme = render::parse_theme(text, "mine", "mine.toml");
    return theme ? "" : theme.error().message;
}

TEST(Themes, come_with_the_program_the_default_first) {
    const std::vector<std::string> names = theme_names();
    EXPECT_EQ(names.front(), "stage");
    for (const char* const name :
         {"stage", "workshop_dark", "studio_light", "plain", "club", "dance_floor"}) {
        EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
        const auto theme = find_theme(name);
        ASSERT_TRUE(theme) << theme.error().message;
        EXPECT_EQ((*theme)->name, name);
        EXPECT_EQ(*find_theme(name), *theme) << "it stays where it is";
    }
}

TEST(Themes, an_unknown_name_is_answered_with_the_nearest_one_and_the_default_is_shown) {
    EXPECT_EQ(find_theme("stge").error().message,
              "theme \"stge\" is unknown; did you mean \"stage\"?");
    EXPECT_EQ(find_theme("studio-light").error().message,
              "theme \"studio-light\" is unknown; did you mean \"studio_light\"?");
    EXPECT_FALSE(find_theme("").has_value());
    EXPECT_FALSE(find_theme("../themes/stage").has_value());
    EXPECT_LT(find_theme(std::string(1'000'000, 'x')).error().message.size(), 300U);
    Settings settings;
    settings.theme = "stge";
    const auto look = read_look(settings);
    ASSERT_TRUE(look) << look.error().message;
    EXPECT_EQ(look->scene.theme->name, "stage");
    ASSERT_EQ(look->notes.size(), 1U);
    EXPECT_EQ(look->notes.front().find('\n'), std::string::npos);
}

TEST(Themes, a_key_goes_through_those_that_are_listed_and_comes_back) {
    std::vector<std::string> lines;
    std::vector<std::string> seen;
    const render::Theme* theme = &render::default_theme();
    do {
        theme = &theme_after(theme->name, lines);
        seen.push_back(theme->name);
    } while (theme->name != "stage" && seen.size() < 20);
    EXPECT_EQ(seen.size(), 5U);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), "plain"), 0);
    EXPECT_TRUE(lines.empty());
}

TEST(Themes, a_file_is_found_by_its_path) {
    const test::TemporaryFolder folder;
    const std::string file = folder.path() / "mine.toml";
    ASSERT_TRUE(write_file(file, std::string(kHead) + "exposure = 0.5\n"));
    const auto theme = find_theme(file);
    ASSERT_TRUE(theme) << theme.error().message;
    EXPECT_EQ((*theme)->exposure, 0.5F);
    EXPECT_EQ((*theme)->key_light, render::default_theme().key_light) << "as in the default";
    EXPECT_FALSE(find_theme(std::string(folder.path() / "other.toml")));
}

TEST(Themes, a_mangled_file_is_told_in_one_line_that_names_the_place) {
    const std::pair<std::string, std::string> cases[] = {
        {"exposure = 1.0\n", "mine.toml: format must be \"raks-theme\""},
        {std::string(kHead) + "exposur = 1.0\n",
         "mine.toml: line 3: key \"exposur\" is unknown; did you mean \"exposure\"?"},
        {std::string(kHead) + "exposure = -1\n",
         "mine.toml: line 3: exposure is -1, must be 0.05 to 10"},
        {std::string(kHead) + "[floor]\ncentre = \"blue\"\n",
         "mine.toml: line 4: centre must be a colour such as \"#a61b33\""},
        {std::string(kHead) + "[floor]\ncentre = \"#12345g\"\n",
         "mine.toml: line 4: centre must be a colour such as \"#a61b33\""},
        {std::string(kHead) + "[lights]\nkey = [1, 2]\n",
         "mine.toml: line 4: key must be [red, green, blue]"},
        {std::string(kHead) + "[lights]\nkey = [1, nan, 2]\n",
         "mine.toml: line 4: key is nan, must be 0 to 10"},
        {std::string(kHead) + "floor = 3\n", "mine.toml: line 3: floor must be a table [floor]"},
        {std::string(kHead) + "listed = 1\n", "mine.toml: line 3: listed must be true or false"},
        {std::string(kHead) + "[tiles]\ncolours = [\"#000000\"]\n",
         "mine.toml: line 4: colours must be a list of 4 colours"},
        {std::string(kHead) + "[beams]\ncount = 99\n",
         "mine.toml: line 4: count is 99, must be 0 to 12"},
        {std::string(kHead) + "[[outfits]]\nskin = \"#000000\"\n",
         "mine.toml: line 3: outfits must be 6 tables [[outfits]]"},
    };
    for (const auto& [text, error] : cases) {
        EXPECT_EQ(error_of_theme(text), error) << text;
    }
    EXPECT_FALSE(error_of_theme("format = [").empty());
}

}  // namespace
}  // namespace raks::engine
