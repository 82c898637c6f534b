#include "engine/setup/presets.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "engine/setup/settings_table.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

using Names = std::vector<std::string>;

Preset party() {
    Preset preset;
    preset.theme = "plain";
    preset.camera = "wide";
    preset.backdrop = "#00ff00";
    preset.view = "stick";
    preset.avatars = Names{"anna.vrm", "mannequin"};
    preset.dance = "salsa";
    preset.formation = "ring";
    preset.forbidden = Names{"rock"};
    preset.outputs = Names{"pipewire"};
    preset.told = Names{"osc 127.0.0.1:9000,lead=30", "wled multicast"};
    return preset;
}

std::string fault_of_preset(const std::string& toml) {
    const auto loaded = parse_preset(toml, "party.toml");
    return loaded ? "" : loaded.error().message;
}

TEST(PresetText, says_what_was_written) {
    for (const Preset& preset : {Preset{}, party()}) {
        const auto loaded = parse_preset(toml_of(preset), "party.toml");
        ASSERT_TRUE(loaded) << loaded.error().message << '\n' << toml_of(preset);
        EXPECT_EQ(loaded->preset, preset);
        EXPECT_TRUE(loaded->notes.empty());
    }
}

TEST(PresetText, holds_what_it_names_and_nothing_else) {
    const auto loaded =
        parse_preset("[dance]\nforbidden = []\n[picture]\ntheme = \"plain\"\n", "party.toml");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->preset.theme, "plain");
    EXPECT_EQ(loaded->preset.forbidden, Names{}) << "that no dance is forbidden";
    EXPECT_EQ(loaded->preset.camera, std::nullopt);
    EXPECT_EQ(loaded->preset.outputs, std::nullopt);
}

TEST(PresetText, faults_name_file_line_and_what_is_meant) {
    const struct {
        const char* toml;
        const char* fault;
    } cases[] = {
        {"[picture]\ncamera = \"frnt\"\n",
         "party.toml: picture.camera \"frnt\" is unknown; did you mean \"front\"?"},
        {"[picture]\ntheme = 3\n", "party.toml: line 2: picture.theme must be a text"},
        {"[dance]\nforbidden = \"rock\"\n",
         "party.toml: line 2: dance.forbidden must be a list of up to 250 texts"},
        {"[dance]\nforbidden = [1]\n",
         "party.toml: line 2: dance.forbidden must be a list of texts"},
        {"[video]\noutputs = [\"\"]\n",
         "party.toml: line 2: video.outputs: an output must be a text of printable characters"},
        {"format = \"raks-config\"\n",
         "party.toml: format is not \"raks-preset\"; this is another kind of file"},
        {"version = 2\n", "party.toml: version 2 is not known to this Raks (it reads version 1)"},
    };
    for (const auto& c : cases) {
        EXPECT_EQ(fault_of_preset(c.toml), c.fault) << c.toml;
    }
    EXPECT_NE(fault_of_preset("[dance]\nforbidden = [\"a/b\"]\n").find("line 2"),
              std::string::npos);
}

TEST(PresetText, keys_of_a_newer_version_and_other_settings_are_said_and_passed_over) {
    const auto loaded = parse_preset(
        "[picture]\nfps = 60\ntheme = \"plain\"\n[lights]\nstrobe = true\n", "party.toml");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->preset.theme, "plain");
    ASSERT_EQ(loaded->notes.size(), 2U);
    EXPECT_TRUE(loaded->notes[0].starts_with("party.toml: line 4: key \"lights\" is unknown"))
        << loaded->notes[0];
    EXPECT_TRUE(loaded->notes[1].starts_with("party.toml: line 2: key \"picture.fps\" is unknown"))
        << loaded->notes[1];
}

TEST(PresetText, that_is_damaged_ends_in_one_line) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const std::string fault =
            fault_of_preset(test::mangled(toml_of(party()), {.seed = seed, .bytes = 1 + seed % 7}));
        EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
    }
    const std::string whole = toml_of(party());
    for (std::size_t i = 0; i < whole.size(); ++i) {
        EXPECT_EQ(fault_of_preset(whole.substr(0, i)).find('\n'), std::string::npos) << i;
    }
}

TEST(PresetOverSettings, wins_over_files_and_yields_to_options) {
    Settings settings;
    ASSERT_TRUE(parse_settings(
        "[picture]\ntheme = \"stage\"\ncamera = \"front\"\nfps = 60\n", "c.toml", settings));
    settings.camera = "side";
    settings.origins.set("picture.camera", {SettingRank::option, {}, 0});
    const auto loaded = parse_preset(toml_of(party()), "party.toml");
    ASSERT_TRUE(loaded);
    apply_preset(*loaded, settings);
    EXPECT_EQ(settings.theme, "plain");
    EXPECT_EQ(settings.camera, "side") << "an option";
    EXPECT_EQ(settings.fps, 60.0) << "not of the preset";
    EXPECT_EQ(settings.avatars, (Names{"anna.vrm", "mannequin"}));
    EXPECT_EQ(settings.forbidden_dances, Names{"rock"});
    EXPECT_EQ(in_words(origin_of(settings, &Settings::theme)), "preset party.toml:12");
    Preset now = preset_of(settings);
    EXPECT_EQ(now.camera, "side");
    now.camera = "wide";
    now.outputs = Names{"pipewire"};
    now.told = party().told;
    EXPECT_EQ(now, party()) << "what is shown can be kept again";
}

TEST(PresetName, is_one_that_can_name_a_file) {
    for (const char* good : {"party", "Saal 2", "90er", "h\xc3\xb6rsaal", "a.b"}) {
        EXPECT_EQ(fault_of_preset_name(good), "") << good;
    }
    const std::string too_long(65, 'a');
    for (const char* bad : {"", ".", "..", ".hidden", "a/b", "/etc/x", "a\nb", too_long.c_str()}) {
        const std::string fault = fault_of_preset_name(bad);
        EXPECT_NE(fault, "") << bad;
        EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
    }
}

/// A folder of settings of its own.
class PresetFiles : public ::testing::Test {
 protected:
    void SetUp() override {
        const char* const before = std::getenv("XDG_CONFIG_HOME");  // NOLINT(concurrency-mt-unsafe)
        before_ = before != nullptr ? std::optional<std::string>(before) : std::nullopt;
        setenv("XDG_CONFIG_HOME", folder_.path().c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
    }
    void TearDown() override {
        // NOLINTNEXTLINE(concurrency-mt-unsafe)
        before_ ? setenv("XDG_CONFIG_HOME", before_->c_str(), 1) : unsetenv("XDG_CONFIG_HOME");
    }
    [[nodiscard]] std::filesystem::path file(const std::string& name) const {
        return folder_ / ("raks/presets/" + name + ".toml");
    }
    /// Saving under the name is refused in one line, and the file stays.
    void expect_is_kept(const std::string& name) {
        const auto saved = save_preset(name, party());
        ASSERT_FALSE(saved) << name;
        EXPECT_EQ(saved.error().message.find('\n'), std::string::npos) << saved.error().message;
        EXPECT_NE(saved.error().message.find("is left as it is"), std::string::npos)
            << saved.error().message;
    }

    test::TemporaryFolder folder_;
    std::optional<std::string> before_;
};

TEST_F(PresetFiles, are_saved_listed_loaded_and_replaced) {
    EXPECT_TRUE(preset_names().empty()) << "there is no folder yet";
    ASSERT_EQ(save_preset("party", party()).value_or(""), file("party"));
    ASSERT_TRUE(save_preset("Ball", Preset{}));
    ASSERT_TRUE(write_file(folder_ / "raks/presets/note.txt", "no preset"));
    ASSERT_TRUE(write_file(folder_ / "raks/presets/.hidden.toml", ""));
    EXPECT_EQ(preset_names(), (Names{"Ball", "party"}));
    const auto loaded = load_preset("party");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->preset, party());
    Preset other = party();
    other.theme = "stage";
    ASSERT_TRUE(save_preset("party", other));
    EXPECT_EQ(load_preset("party")->preset, other);
}

TEST_F(PresetFiles, an_unknown_name_is_told_with_the_nearest) {
    EXPECT_TRUE(load_preset("party").error().message.starts_with(
        "preset \"party\" is unknown: there are none yet in "));
    ASSERT_TRUE(save_preset("party", party()));
    EXPECT_EQ(load_preset("prty").error().message,
              "preset \"prty\" is unknown; did you mean \"party\"?");
    EXPECT_EQ(why_unknown_preset("party"), "");
    EXPECT_NE(load_preset("../config").error().message.find("cannot be a name"), std::string::npos);
    EXPECT_FALSE(save_preset("../config", party()));
    EXPECT_FALSE(is_there(folder_ / "raks/config.toml"));
}

TEST_F(PresetFiles, that_cannot_be_read_or_are_of_a_newer_version_are_never_overwritten) {
    ASSERT_TRUE(make_folders(file("x").parent_path()));
    const std::string newer = toml_of(party()) + "[lights]\nstrobe = true\n";
    for (const std::string& text : {std::string("[picture"), std::string("version = 2\n"), newer}) {
        ASSERT_TRUE(write_file(file("x"), text));
        expect_is_kept("x");
        EXPECT_EQ(read_file(file("x")).value_or(""), text);
    }
    ASSERT_TRUE(write_file(file("large"), ""));
    std::filesystem::resize_file(file("large"), 100'000'000);
    expect_is_kept("large");
    EXPECT_FALSE(load_preset("large"));
    std::filesystem::create_directory(file("folder"));
    expect_is_kept("folder");
    ASSERT_EQ(mkfifo(file("fifo").c_str(), 0600), 0);
    expect_is_kept("fifo");
    EXPECT_FALSE(load_preset("fifo")) << "and nobody waits for it";
    EXPECT_EQ(preset_names(), (Names{"large", "x"}));
}

}  // namespace
}  // namespace raks::engine
