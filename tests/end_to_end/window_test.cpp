// A real window on a display of our own; keys through xdotool, pictures read back from the screen.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "tests/end_to_end/window.hpp"

namespace raks::test {
namespace {

TEST_F(WindowTest, draws_the_dancer_and_obeys_the_keys) {
    CapturedProcess raks(in_window({"play", "--no-sound", path("one.wav"), path("two.wav")}));
    ASSERT_TRUE(raks.wait_for_output("one.wav"));
    press({"p"});
    ASSERT_TRUE(raks.wait_for_output("screenshot saved")) << "it has drawn by then";
    const std::string first = picture();
    ASSERT_EQ(first.size(), 3U * kWindowWidth * kWindowHeight);
    EXPECT_GT(difference(first, std::string(first.size(), '\0')), 10.0) << "not black";
    // Help lies over the picture; the mean changes by far more than a step of the dance does.
    press({"question"});
    press({"p"});
    press({"s"});
    EXPECT_TRUE(shows([&](const auto& now) { return difference(first, now) > 3.0; }));
    press({"question", "o", "space", "space", "Right", "Up", "t", "bracketleft", "c"});
    press({"n"});
    ASSERT_TRUE(raks.wait_for_output("two.wav")) << "the next file plays";
    press({"q"});
    const ProcessResult result = raks.wait();
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
    CapturedProcess raks(in_window({"play", "--no-sound", path("one.wav")}));
    ASSERT_TRUE(raks.wait_for_output("one.wav"));
    raks.send(SIGTERM);
    const ProcessResult result = raks.wait();
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.exit_code, 143);
}

TEST_F(WindowTest, plays_a_clip_and_goes_to_the_frame_asked_for) {
    const std::string clip = std::string(RAKS_SOURCE_DIR) + "/tests/data/bvh/odd/plain.bvh";
    CapturedProcess raks(in_window({"stick", clip, "--frame", "3"}));
    ASSERT_TRUE(raks.wait_for_output("--scale"));
    const std::string third = still_picture();
    EXPECT_GT(difference(third, std::string(third.size(), '\0')), 10.0) << "not black";
    press({"Right"});
    EXPECT_TRUE(shows([&](const auto& now) { return now != third; }));
    const std::string fourth = still_picture();
    press({"9", "Return"});
    EXPECT_TRUE(shows([&](const auto& now) { return now != fourth && now != third; }));
    press({"3", "Return"});
    EXPECT_TRUE(shows([&](const auto& now) { return now == third; })) << "the same frame again";
    press({"space"});
    EXPECT_TRUE(shows([&](const auto& now) { return now != third; })) << "it plays";
    press({"q"});
    const ProcessResult result = raks.wait();
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

}  // namespace
}  // namespace raks::test
