// A real window on a display of our own; keys through xdotool, pictures read back from the screen.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "audio/io/audio_file.hpp"
#include "audio/synth/music_generator.hpp"
#include "tests/end_to_end/program.hpp"
#include "tests/support/program.hpp"
#include "tests/support/xvfb.hpp"

namespace raks::test {
namespace {

using std::chrono::milliseconds;

class WindowTest : public ProgramTest {
 protected:
    void SetUp() override {
        ProgramTest::SetUp();
        display_.emplace(640, 360);
        audio::MusicPlan plan;
        plan.seconds = 60.0;
        const auto music = audio::generate(plan);
        ASSERT_TRUE(music);
        for (const char* name : {"one.wav", "two.wav"}) {
            ASSERT_TRUE(audio::write_wav(path(name), music->samples, music->channels, music->rate));
        }
    }

    [[nodiscard]] ProcessPlan in_window(std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"--no-sound", "--size", "640x360"});
        ProcessPlan result = plan(std::move(arguments));
        std::erase(result.unset, "DISPLAY");
        result.folder = folder_;
        return result;
    }

    /// Waits for the window, gives it the keyboard and presses the keys.
    static void press(const std::vector<std::string>& keys) {
        std::vector<std::string> command = {
            "xdotool", "search", "--sync", "--name", "Raks", "windowfocus", "--sync"};
        for (const std::string& key : keys) {
            command.insert(command.end(), {"key", key});
        }
        run_program(command);
    }

    /// The screen as raw RGB.
    static std::string screen() {
        return run_program({"import", "-window", "root", "-depth", "8", "rgb:-"});
    }

    std::optional<Xvfb> display_;
};

double difference(const std::string& a, const std::string& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        sum += std::abs(static_cast<unsigned char>(a[i]) - static_cast<unsigned char>(b[i]));
    }
    return sum / static_cast<double>(a.size());
}

TEST_F(WindowTest, draws_the_dancer_and_obeys_the_keys) {
    CapturedProcess raks(in_window({"play", path("one.wav"), path("two.wav")}));
    ASSERT_TRUE(raks.wait_for_output("one.wav"));
    press({"p"});
    ASSERT_TRUE(raks.wait_for_output("screenshot saved")) << "it has drawn by then";
    const std::string picture = screen();
    ASSERT_EQ(picture.size(), 640U * 360U * 3U);
    EXPECT_GT(difference(picture, std::string(picture.size(), '\0')), 10.0) << "not black";
    // Help lies over the picture; the mean changes by far more than a step of the dance does.
    press({"question"});
    press({"p"});
    press({"s"});
    EXPECT_GT(difference(picture, screen()), 3.0);
    press({"question", "o", "space", "space", "Right", "Up", "t", "bracketleft", "c"});
    press({"n"});
    ASSERT_TRUE(raks.wait_for_output("two.wav")) << "the next file plays";
    press({"q"});
    const ProcessResult result = raks.wait(milliseconds(4'000));
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const auto names = files();
    EXPECT_EQ(std::count_if(names.begin(),
                            names.end(),
                            [](const std::string& name) { return name.rfind("raks-", 0) == 0; }),
              2)
        << "screenshots, in the folder where it was started, none overwritten";
}

TEST_F(WindowTest, ends_when_told_by_a_signal) {
    CapturedProcess raks(in_window({"play", path("one.wav")}));
    ASSERT_TRUE(raks.wait_for_output("one.wav"));
    raks.send(SIGTERM);
    const ProcessResult result = raks.wait(milliseconds(2'000));
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.exit_code, 143);
}

}  // namespace
}  // namespace raks::test
