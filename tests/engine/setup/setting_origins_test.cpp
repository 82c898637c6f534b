#include "engine/setup/setting_origins.hpp"

#include <gtest/gtest.h>

#include <string>

#include "engine/setup/settings.hpp"
#include "engine/setup/settings_table.hpp"

namespace raks::engine {
namespace {

TEST(SettingOrigins, name_file_and_line_of_each_value) {
    Settings settings;
    ASSERT_TRUE(parse_settings("version = 1\n\n[picture]\ntheme = \"plain\"\nfps = 60\n",
                               "/etc/default.toml",
                               settings,
                               SettingRank::installed));
    ASSERT_TRUE(parse_settings(
        "[picture]\nfps = 25\navatar = [\n\"a\",\n\"b\"]\n", "/home/anna/config.toml", settings));
    EXPECT_EQ(origin_of(settings, &Settings::theme),
              (SettingOrigin{SettingRank::installed, "/etc/default.toml", 4}));
    EXPECT_EQ(origin_of(settings, &Settings::fps),
              (SettingOrigin{SettingRank::config, "/home/anna/config.toml", 2}));
    EXPECT_EQ(in_words(origin_of(settings, &Settings::avatars)), "/home/anna/config.toml:3");
    EXPECT_EQ(origin_of(settings, &Settings::size), SettingOrigin{});
}

TEST(SettingOrigins, of_a_file_that_is_refused_are_not_noted) {
    Settings settings;
    EXPECT_FALSE(parse_settings("[picture]\nfps = 60\nsize = \"huge\"\n", "x", settings));
    EXPECT_EQ(origin_of(settings, &Settings::fps).rank, SettingRank::built_in);
}

TEST(SettingOrigins, are_one_line_in_words_whatever_the_name_of_the_file) {
    EXPECT_EQ(in_words(SettingOrigin{}), "default");
    EXPECT_EQ(in_words(SettingOrigin{SettingRank::preset, "a\nb.toml", 7}), "preset a?b.toml:7");
    EXPECT_EQ(in_words(SettingOrigin{SettingRank::window, "w.toml", 1}), "window w.toml:1");
    EXPECT_EQ(in_words(SettingOrigin{SettingRank::option, {}, 0}), "option");
}

TEST(SettingOrigins, stand_beside_each_value_that_is_shown) {
    Settings settings;
    ASSERT_TRUE(parse_settings(to_toml({}), "d.toml", settings, SettingRank::installed));
    ASSERT_TRUE(parse_settings(
        "[audio]\nvolume = 0.5\n[picture]\ntheme = \"stage\"\n", "c.toml", settings));
    const std::string shown = to_toml(settings, TomlComments::origins);
    EXPECT_NE(shown.find("volume = 0.5  # c.toml:2\n"), std::string::npos) << shown;
    EXPECT_NE(shown.find("theme = \"stage\"  # c.toml:4\n"), std::string::npos)
        << "who has said the default, too";
    EXPECT_NE(shown.find("fps = 30.0  # default\n"), std::string::npos) << shown;
    Settings back;
    EXPECT_TRUE(parse_settings(shown, "x", back)) << "it is such a file itself";
}

TEST(SettingOrigins, an_installed_value_that_is_no_default_names_its_file) {
    Settings settings;
    ASSERT_TRUE(
        parse_settings("[picture]\nfps = 50\n", "d.toml", settings, SettingRank::installed));
    EXPECT_NE(to_toml(settings, TomlComments::origins).find("fps = 50.0  # d.toml:2\n"),
              std::string::npos);
}

// The table: who is there already, who comes, whose value it is then.
TEST(SettingOrigins, the_higher_rank_wins_in_whatever_order_they_come) {
    const auto with = [](SettingRank rank, double fps) {
        Settings settings;
        settings.fps = fps;
        settings.origins.set("picture.fps", {rank, "f", 1});
        return settings;
    };
    for (const auto first :
         {SettingRank::window, SettingRank::config, SettingRank::preset, SettingRank::option}) {
        for (const auto second :
             {SettingRank::window, SettingRank::config, SettingRank::preset, SettingRank::option}) {
            Settings settings = with(first, 25.0);
            take_setting(&Settings::fps, with(second, 60.0), settings);
            EXPECT_EQ(settings.fps, second >= first ? 60.0 : 25.0);
            EXPECT_EQ(origin_of(settings, &Settings::fps).rank, std::max(first, second));
        }
    }
}

}  // namespace
}  // namespace raks::engine
