#include "tests/end_to_end/program_fixture.hpp"

#include <algorithm>

#include "audio/io/wav_writer.hpp"
#include "base/pending_file.hpp"

namespace raks::test {

std::vector<std::string> ProgramTest::files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
        const std::string name = entry.path().filename().string();
        if (name != "cache" && name != "config" && name != "share") {
            names.push_back(name);
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

void ProgramTest::draw_small_pictures() const {
    std::filesystem::create_directories(folder_ / "config" / "raks");
    ASSERT_TRUE(write_file(folder_ / "config" / "raks" / "config.toml",
                           "[picture]\nsize = \"320x180\"\nfps = 15.0\nquality = \"fast\"\n"));
}

audio::GeneratedMusic ProgramTest::write_music(const std::string& name,
                                               const audio::MusicPlan& plan) const {
    auto music = audio::generate(plan);
    EXPECT_TRUE(music) << music.error().message;
    const auto written = audio::write_wav(path(name), music->samples, music->channels, music->rate);
    EXPECT_TRUE(written) << written.error().message;
    return *music;
}

void ProgramTest::write_clicks(const std::string& name, double seconds) const {
    audio::MusicPlan plan;
    plan.style = audio::Style::clicks;
    plan.seconds = seconds;
    write_music(name, plan);
}

void ProgramTest::expect_one_line(const std::vector<std::string>& arguments,
                                  int exit_code,
                                  const std::string& part) const {
    const ProcessResult result = run(arguments);
    std::string command;
    for (const std::string& argument : arguments) {
        command += argument + " ";
    }
    EXPECT_EQ(result.exit_code, exit_code) << command << "\n" << result.err;
    EXPECT_TRUE(is_one_error_line(result.err)) << command << "\n" << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << command << "\n" << result.err;
    EXPECT_EQ(result.out, "") << command;
}

bool is_one_error_line(const std::string& text) {
    return text.rfind("raks: ", 0) == 0 && std::count(text.begin(), text.end(), '\n') == 1 &&
           text.back() == '\n';
}

}  // namespace raks::test
