#include "engine/setup/settings.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/random.hpp"

namespace raks::engine {
namespace {

std::string error_of(const std::string& toml) {
    Settings settings;
    const auto result = parse_settings(toml, "config.toml", settings);
    return result ? "" : result.error().message;
}

TEST(Settings, written_settings_read_back_the_same) {
    Settings settings;
    settings.device = "Monitor of \"Built-in\" audio";
    settings.latency_offset_ms = -12.5;
    settings.seed = 42;
    settings.overlay = false;
    settings.dancers = 12;
    settings.avatars = {"anna.vrm", "mannequin"};
    Settings back;
    const auto read = parse_settings(to_toml(settings), "x", back);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(to_toml(back), to_toml(settings));
    EXPECT_EQ(back.device, settings.device);
    EXPECT_EQ(back.seed, 42);
    EXPECT_EQ(back.dancers, 12);
    EXPECT_EQ(back.avatars, settings.avatars);
}

TEST(Settings, a_file_changes_only_what_it_names) {
    Settings settings;
    settings.volume = 0.5;
    ASSERT_TRUE(parse_settings("[picture]\nfps = 60\n", "x", settings));
    EXPECT_EQ(settings.fps, 60.0);
    EXPECT_EQ(settings.volume, 0.5);
}

TEST(Settings, an_avatar_is_a_text_and_several_are_a_list) {
    Settings settings;
    ASSERT_TRUE(parse_settings("[picture]\navatar = \"a.vrm\"\n", "x", settings));
    EXPECT_EQ(settings.avatars, std::vector<std::string>({"a.vrm"}));
    ASSERT_TRUE(parse_settings("[picture]\navatar = [\"a.vrm\", \"b.glb\"]\n", "x", settings));
    EXPECT_EQ(settings.avatars, std::vector<std::string>({"a.vrm", "b.glb"}));
    for (const char* value : {"[]", "1", "[\"a.vrm\", 1]", "[[\"a.vrm\"]]"}) {
        EXPECT_EQ(error_of(std::string("[picture]\navatar = ") + value + "\n"),
                  "config.toml: line 2: picture.avatar must be a text, or a list of texts");
    }
    std::string many = "\"a\"";
    for (std::size_t i = 0; i < kMostAvatars; ++i) {
        many += ", \"a\"";
    }
    EXPECT_EQ(error_of("[picture]\navatar = [" + many + "]\n"),
              "config.toml: picture.avatar names 33 avatars, at most 32");
}

TEST(Settings, errors_name_file_line_key_and_what_is_meant) {
    const struct {
        const char* toml;
        const char* error;
    } cases[] = {
        {"audio = 1\n", "config.toml: line 1: audio must be a section"},
        {"[picture]\nfps = \"fast\"\n", "config.toml: line 2: picture.fps must be a number"},
        {"[picture]\nfps = 1000\n", "config.toml: picture.fps is 1000, must be 0, or 1 to 240"},
        {"[picture]\nfps = nan\n", "config.toml: picture.fps is nan, must be 0, or 1 to 240"},
        {"[picture]\nsize = \"huge\"\n",
         "config.toml: picture.size: \"huge\" is not a picture size; write WIDTHxHEIGHT, 16 to "
         "7680 "
         "each, such as 1280x720"},
        {"[dance]\nseed = -1\n", "config.toml: dance.seed is -1, must be 0 to 9000000000000000"},
        {"[picture]\noverlay = 1\n", "config.toml: line 2: picture.overlay must be true or false"},
        {"version = 2\n", "config.toml: version 2 is not known to this Raks (it reads version 1)"},
        {"version = 2\n[camera]\nlens = 1\n",
         "config.toml: version 2 is not known to this Raks (it reads version 1)"},
    };
    for (const auto& c : cases) {
        EXPECT_EQ(error_of(c.toml), c.error) << c.toml;
    }
    EXPECT_NE(error_of("[picture\n").find("config.toml: line 1"), std::string::npos);
    // Headers that break the parser itself.
    for (const char* header : {"[", "[[", "[[[picture]]]", "[=", "[[ #"}) {
        EXPECT_TRUE(
            error_of("\n" + std::string(header)).starts_with("config.toml: line 2, column "))
            << header;
    }
}

TEST(Settings, unknown_keys_are_said_and_passed_over) {
    const struct {
        const char* toml;
        const char* note;
    } cases[] = {
        {"[picture]\nthme = \"stage\"\nfps = 60\n",
         "x: line 2: key \"picture.thme\" is unknown and ignored; did you mean "
         "\"picture.theme\"?"},
        {"[pictures]\nfps = 30\n[picture]\nfps = 60\n",
         "x: line 1: key \"pictures\" is unknown and ignored; did you mean \"picture\"?"},
    };
    for (const auto& c : cases) {
        Settings settings;
        const auto notes = parse_settings(c.toml, "x", settings);
        ASSERT_TRUE(notes) << notes.error().message;
        EXPECT_EQ(*notes, SettingsNotes{c.note});
        EXPECT_EQ(settings.fps, 60.0) << "the others hold";
    }
    std::string many = "[dance]\n";
    for (int i = 0; i < 300; ++i) {
        many += "k" + std::to_string(i) + " = 1\n";
    }
    Settings settings;
    const auto notes = parse_settings(many, "x", settings);
    ASSERT_TRUE(notes);
    EXPECT_EQ(notes->size(), 6U);
    EXPECT_EQ(notes->back(), "x: 295 more keys are unknown");
}

TEST(Settings, pictures_a_second_of_0_are_the_monitors_and_of_a_film_30) {
    Settings settings;
    for (const char* bad : {"0.5", "-1", "240.5"}) {
        EXPECT_FALSE(parse_settings(std::string("[picture]\nfps = ") + bad + "\n", "x", settings))
            << bad;
    }
    ASSERT_TRUE(parse_settings("[picture]\nfps = 0\n", "x", settings));
    EXPECT_EQ(settings.fps, 0.0);
    EXPECT_EQ(film_fps(settings), 30.0);
    settings.fps = 60.0;
    EXPECT_EQ(film_fps(settings), 60.0);
}

TEST(Settings, an_error_leaves_the_settings_alone) {
    Settings settings;
    EXPECT_FALSE(parse_settings("[picture]\nfps = 60\nsize = 1\n", "x", settings));
    EXPECT_EQ(settings.fps, Settings{}.fps);
}

TEST(Settings, every_truncation_of_a_file_is_read_or_refused) {
    const std::string whole = to_toml({});
    for (std::size_t i = 0; i < whole.size(); ++i) {
        Settings settings;
        const auto result = parse_settings(whole.substr(0, i), "x", settings);
        if (!result) {
            EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
        }
    }
}

TEST(Settings, mangled_files_are_read_or_refused_in_one_line) {
    const std::string whole = to_toml({});
    for (std::uint64_t round = 0; round < 2000; ++round) {
        const CounterRandom random(round, 1);
        std::string text = whole;
        for (std::uint64_t i = 0; i < 4; ++i) {
            text[random.below(2 * i, text.size())] =
                static_cast<char>(random.below(2 * i + 1, 256));
        }
        Settings settings;
        const auto result = parse_settings(text, "x", settings);
        if (!result) {
            EXPECT_EQ(result.error().message.find('\n'), std::string::npos) << round;
        }
    }
}

TEST(Backdrop, is_a_word_or_a_colour_of_six_digits) {
    EXPECT_TRUE(parse_backdrop("stage")->is_stage);
    EXPECT_FALSE(parse_backdrop("transparent")->is_stage);
    EXPECT_FALSE(parse_backdrop("transparent")->key);
    const std::array<std::uint8_t, 3> green = {0, 255, 16};
    EXPECT_EQ(parse_backdrop("#00ff10")->key, green);
    EXPECT_EQ(parse_backdrop("#00FF10")->key, green);
    for (const char* bad : {"", "green", "#00ff", "00ff00", "#00ff000", "#00gg00", "#-0ff00"}) {
        EXPECT_FALSE(parse_backdrop(bad)) << bad;
    }
}

TEST(PictureSize, takes_two_numbers_only) {
    EXPECT_EQ(parse_size("640x360")->width, 640);
    EXPECT_EQ(parse_size("640x360")->height, 360);
    for (const char* bad :
         {"", "x", "640", "640x", "x360", "640x360x2", "-1x5", "8x8", "9999x10"}) {
        EXPECT_FALSE(parse_size(bad)) << bad;
    }
}

}  // namespace
}  // namespace raks::engine
