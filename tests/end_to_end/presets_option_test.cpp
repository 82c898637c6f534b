// --preset and what of it raks config shows, as a person uses them.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

class PresetOption : public ProgramTest {
 protected:
    void SetUp() override {
        ProgramTest::SetUp();
        ASSERT_TRUE(make_folders(path("config/raks/presets")));
        write("party", "[picture]\ntheme = \"plain\"\n\n[dance]\nformation = \"ring\"\n");
    }
    [[nodiscard]] std::string preset(const std::string& name) const {
        return path("config/raks/presets/" + name + ".toml");
    }
    void write(const std::string& name, const std::string& text) const {
        ASSERT_TRUE(write_file(preset(name), text));
    }
    /// What it says of a file that is not there, with these options: what is wrong with them, else
    /// that it cannot be opened.
    [[nodiscard]] std::string said_with(const std::vector<std::string>& options) const {
        std::vector<std::string> words = {"play", "--headless", "--no-sound", path("none.wav")};
        words.insert(words.end(), options.begin(), options.end());
        return run(words).err;
    }
};

TEST_F(PresetOption, wins_over_files_and_yields_to_options_in_any_order) {
    ASSERT_TRUE(write_file(path("config/raks/config.toml"), "[dance]\ndance = \"of_the_file\"\n"));
    write("other", "[dance]\ndance = \"of_the_preset\"\n");
    const auto names = [&](const std::vector<std::string>& options, const std::string& dance) {
        return said_with(options).find("\"" + dance + "\" is unknown") != std::string::npos;
    };
    EXPECT_TRUE(names({}, "of_the_file"));
    EXPECT_TRUE(names({"--preset", "other"}, "of_the_preset"));
    EXPECT_TRUE(names({"--preset", "other", "--dance", "given"}, "given"));
    EXPECT_TRUE(names({"--dance", "given", "--preset", "other"}, "given"));
}

TEST_F(PresetOption, is_shown_with_file_and_line_of_each_value) {
    ASSERT_TRUE(write_file(path("config/raks/config.toml"),
                           "[audio]\nvolume = 0.5\n[picture]\ntheme = \"stage\"\n"));
    const ProcessResult shown = run({"config", "show", "--origin", "--preset", "party"});
    EXPECT_EQ(shown.exit_code, 0) << shown.err;
    for (const std::string& line : {"theme = \"plain\"  # preset " + preset("party") + ":2\n",
                                    "formation = \"ring\"  # preset " + preset("party") + ":5\n",
                                    "volume = 0.5  # " + path("config/raks/config.toml") + ":2\n",
                                    std::string("camera = \"director\"  # default\n")}) {
        EXPECT_NE(shown.out.find(line), std::string::npos) << line << shown.out;
    }
    expect_one_line({"config", "path", "--origin"}, 1, "belong to raks config show");
}

TEST_F(PresetOption, of_an_unknown_name_is_a_wrong_command_line) {
    for (const char* command : {"play", "live", "render", "sheet", "dance"}) {
        std::vector<std::string> words = {command, "--preset", "prty"};
        if (std::string(command) != "live" && std::string(command) != "sheet") {
            words.push_back(path("x.wav"));
        }
        if (std::string(command) != "play" && std::string(command) != "live") {
            words.insert(words.end(), {"-o", path("x.out")});
        }
        expect_one_line(words, 2, "preset \"prty\" is unknown; did you mean \"party\"?");
    }
    expect_one_line({"play", "--preset", "../config", path("x.wav")}, 2, "cannot be a name");
    expect_one_line({"config", "--preset", "prty"}, 1, "did you mean \"party\"?");
}

TEST_F(PresetOption, that_cannot_be_used_is_told_in_one_line_and_the_rest_holds) {
    const std::string usual = said_with({});
    ASSERT_TRUE(is_one_error_line(usual)) << usual;
    const auto expect_told = [&](const std::string& part) {
        const std::string said = said_with({"--preset", "bad"});
        ASSERT_TRUE(said.ends_with("\n" + usual)) << said;
        const std::string line = said.substr(0, said.size() - usual.size());
        EXPECT_TRUE(is_one_error_line(line)) << line;
        EXPECT_NE(line.find(part), std::string::npos) << line;
    };
    write("bad", "[picture\n");
    expect_told("bad.toml: line 1");
    write("bad", "[picture]\ncamera = \"wid\"\n");
    expect_told("did you mean \"wide\"?");
    write("bad", "[lights]\nstrobe = true\n");
    expect_told("key \"lights\" is unknown and ignored");
    fs::resize_file(preset("bad"), 100'000'000);
    expect_told("is larger than 1 MiB");
    fs::remove(preset("bad"));
    fs::create_directory(preset("bad"));
    expect_told("bad.toml");
    fs::remove(preset("bad"));
    ASSERT_EQ(mkfifo(preset("bad").c_str(), 0600), 0);
    expect_told("is not a plain file");
}

TEST_F(PresetOption, with_an_avatar_that_is_gone_has_the_mannequin) {
    write("anna", "[picture]\navatar = \"" + path("anna.vrm") + "\"\n");
    EXPECT_EQ(said_with({"--preset", "anna"}),
              "raks: " + path("anna.vrm") + ": not there any more; the mannequin dances instead\n" +
                  said_with({}));
}

TEST_F(PresetOption, a_film_where_windows_follow_the_monitor_has_30_pictures_a_second) {
    write_clicks("clicks.wav", 1.0);
    ASSERT_TRUE(write_file(path("config/raks/config.toml"), "[picture]\nfps = 0\n"));
    const std::vector<std::string> film = {
        "render", path("clicks.wav"), "-o", path("x.mkv"), "--size", "64x64", "--duration", "0.2"};
    const ProcessResult result = run(film);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::string said = "no monitor shows a film: it has 30 pictures a second (--fps)";
    const std::size_t at = result.err.find(said);
    ASSERT_NE(at, std::string::npos) << result.err;
    EXPECT_EQ(result.err.find(said, at + 1), std::string::npos) << result.err;
}

}  // namespace
}  // namespace raks::test
