#include "engine/setup/window_memory.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/setup/settings_table.hpp"
#include "tests/support/mangled.hpp"

namespace raks::engine {
namespace {

WindowMemory remembered() {
    WindowMemory memory;
    memory.place = WindowMemory::Place{100, -40, "DP-1", 0, -1080};
    memory.size = PictureSize{1280, 720};
    memory.device = "Monitor of \"Speakers\"";
    memory.output = "H\xc3\xb6rer";
    memory.avatars = std::vector<std::string>{"/home/anna/a.vrm", "mannequin"};
    return memory;
}

std::string fault_of_memory(const std::string& toml) {
    const auto loaded = parse_window_memory(toml, "window.toml");
    return loaded ? "" : loaded.error().message;
}

TEST(WindowMemoryText, says_what_was_written) {
    WindowMemory place_alone;
    place_alone.place = remembered().place;
    for (const WindowMemory& memory : {WindowMemory(), place_alone, remembered()}) {
        const auto loaded = parse_window_memory(toml_of(memory), "window.toml");
        ASSERT_TRUE(loaded) << loaded.error().message << '\n' << toml_of(memory);
        EXPECT_EQ(loaded->memory, memory);
        EXPECT_TRUE(loaded->notes.empty());
    }
}

TEST(WindowMemoryText, keeps_what_is_printable_of_names_of_any_bytes) {
    WindowMemory memory;
    memory.device = "a\nb\x80";
    const auto loaded = parse_window_memory(toml_of(memory), "window.toml");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->memory.device, "a?b?");
}

TEST(WindowMemoryText, half_a_place_or_size_is_none) {
    const auto loaded = parse_window_memory("[window]\nx = 5\nwidth = 5\n", "window.toml");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->memory, WindowMemory());
}

TEST(WindowMemoryText, faults_name_file_line_and_what_is_meant) {
    const struct {
        const char* toml;
        const char* fault;
    } cases[] = {
        {"[window]\nx = 1e9\ny = 0\n",
         "window.toml: line 2: x is 1000000000, must be -1000000 to 1000000"},
        {"[window]\nwidth = 0\n", "window.toml: line 2: width is 0, must be 1 to 100000"},
        {"[window]\nx = 0.5\n", "window.toml: line 2: x is 0.5, must be a whole number"},
        {"[window]\nx = 0\ny = 0\nmonitor = 1\n",
         "window.toml: line 4: monitor must be a text in quotes"},
        {"window = 1\n", "window.toml: line 1: window must be a section"},
        {"[picture]\navatar = 3\n",
         "window.toml: line 2: picture.avatar must be a text, or a list of texts"},
        {"format = \"raks-preset\"\n",
         "window.toml: format is not \"raks-window\"; this is another kind of file"},
        {"version = 2\n", "window.toml: version 2 is not known to this Raks (it reads version 1)"},
    };
    for (const auto& c : cases) {
        EXPECT_EQ(fault_of_memory(c.toml), c.fault) << c.toml;
    }
}

TEST(WindowMemoryText, keys_of_a_newer_version_are_said_and_passed_over) {
    const auto loaded =
        parse_window_memory("[window]\nwidth = 5\nheight = 6\nshade = 1\n", "window.toml");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->memory.size, (PictureSize{5, 6}));
    ASSERT_EQ(loaded->notes.size(), 1U);
    EXPECT_TRUE(loaded->notes.front().starts_with("window.toml: line 4: key \"window.shade\""));
}

TEST(WindowMemoryText, that_is_damaged_ends_in_one_line) {
    const std::string whole = toml_of(remembered());
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const std::string fault =
            fault_of_memory(test::mangled(whole, {.seed = seed, .bytes = 1 + seed % 7}));
        EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
    }
    for (std::size_t i = 0; i < whole.size(); ++i) {
        EXPECT_EQ(fault_of_memory(whole.substr(0, i)).find('\n'), std::string::npos) << i;
    }
}

TEST(WindowMemoryUnderSettings, yields_to_what_a_person_has_set) {
    Settings settings;
    ASSERT_TRUE(parse_settings(to_toml({}), "default.toml", settings, SettingRank::installed));
    ASSERT_TRUE(parse_settings("[audio]\noutput = \"Hall\"\n", "config.toml", settings));
    const auto loaded = parse_window_memory(toml_of(remembered()), "window.toml");
    ASSERT_TRUE(loaded);
    apply_window_memory(*loaded, settings);
    EXPECT_EQ(settings.output, "Hall");
    EXPECT_EQ(settings.device, remembered().device);
    EXPECT_EQ(settings.avatars, remembered().avatars);
    EXPECT_EQ(origin_of(settings, &Settings::device).rank, SettingRank::window);
    EXPECT_EQ(settings.size, Settings{}.size) << "that of films, too: the window's is its own";
}

}  // namespace
}  // namespace raks::engine
