// A real window on a display of our own; keys through xdotool, pictures read back from the screen.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "tests/end_to_end/window.hpp"
#include "tests/support/file_drop.hpp"
#include "tests/support/run_program.hpp"

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
    const auto names = screenshots();
    EXPECT_EQ(std::count_if(names.begin(),
                            names.end(),
                            [](const std::string& name) { return name.rfind("raks-", 0) == 0; }),
              2)
        << "screenshots, in the user's folder of pictures, none overwritten";
}

/// A piece of two seconds in a window, at the end of which it stays.
TEST_F(WindowTest, stays_at_the_end_of_the_last_file_and_plays_it_once_more) {
    write_clicks("short.wav", 2.0);
    CapturedProcess raks(in_window({"-v", "play", "--no-sound", path("short.wav"), "--overlay"}));
    const auto ends = [&](int times) {
        return raks.wait_until([&](const ProcessResult& so_far) {
            return count_of("at the end of the last file", so_far.err) == times;
        });
    };
    ASSERT_TRUE(ends(1));
    EXPECT_GT(difference(still_picture(), std::string(3U * kWindowWidth * kWindowHeight, '\0')),
              10.0)
        << "the dancer is still there";
    press({"n"});
    ASSERT_TRUE(raks.wait_for_output("there is no file after this one (Q quits)"));
    press({"space"});
    EXPECT_TRUE(ends(2)) << "it has played once more";
    press({"q"});
    const ProcessResult result = raks.wait();
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(WindowTest, quits_at_the_end_where_that_is_asked_for) {
    write_clicks("short.wav", 2.0);
    const ProcessResult result = run_process(
        in_window({"play", "--no-sound", path("short.wav"), path("short.wav"), "--quit"}));
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(WindowTest, the_position_bar_and_the_play_sign_can_be_clicked) {
    CapturedProcess raks(in_window({"-v", "play", "--no-sound", path("one.wav"), "--overlay"}));
    ASSERT_TRUE(raks.wait_for_output("one.wav"));
    const std::string paused = lower(pause(raks));
    // In a window of 640x360 a unit of the overlay is 0.75 pixels: the card begins at 18, 285.
    constexpr int kBarY = 315;
    click(180, kBarY);
    EXPECT_TRUE(shows([&](const auto& now) { return lower(now) != paused; }));
    const std::string there = lower(still_picture());
    click(100, kBarY, 80);
    EXPECT_TRUE(shows([&](const auto& now) { return lower(now) == there; })) << "dragged there";
    click(32, 315);
    EXPECT_TRUE(shows([&](const auto& now) { return lower(now) != there; })) << "it plays on";
    press({"q"});
    EXPECT_EQ(raks.wait().exit_code, 0);
}

TEST_F(WindowTest, a_model_that_is_dropped_dances_on_and_a_goes_back_to_the_mannequin) {
    const std::string model =
        std::string(RAKS_SOURCE_DIR) + "/tests/data/avatars/Godette_vrm_v4.vrm";
    CapturedProcess raks(in_window({"play", "--no-sound", path("one.wav")}));
    ASSERT_TRUE(raks.wait_for_output("one.wav"));
    std::string id = run_program({"xdotool", "search", "--sync", "--name", "Raks"});
    id.erase(id.find('\n'));
    drop_files(id, {model});
    ASSERT_TRUE(raks.wait_for_output("avatar: Low-Poly Godette by SirRichard94"));
    press({"a"});
    ASSERT_TRUE(raks.wait_for_output("avatar: mannequin"));
    press({"q"});
    const ProcessResult result = raks.wait();
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.exit_code, 0) << result.err;
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
