// Each key by itself, by what it alone changes in the picture, the files or the last line.
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/file.hpp"
#include "tests/end_to_end/window.hpp"
#include "tests/support/jack_server.hpp"
#include "tests/support/program.hpp"

namespace raks::test {
namespace {

/// Plays in a window, paused: what a key changes is all that changes. (Pictures are compared by
/// EXPECT_TRUE: nobody wants to read them.)
class Keys : public WindowTest {
 protected:
    void start(const std::string& overlay) {
        raks_.emplace(in_window({"play", path("one.wav"), path("two.wav"), "--no-sound", overlay}));
        ASSERT_TRUE(raks_->wait_for_output("one.wav"));
    }
    /// The picture in the pause.
    std::string start_and_pause(const std::string& overlay) {
        start(overlay);
        press({"space"});
        return still_picture();
    }
    static bool shows_again(const std::string& picture) {
        return shows([&](const std::string& now) { return now == picture; });
    }
    static bool shows_other_than(const std::string& picture) {
        return shows([&](const std::string& now) { return difference(now, picture) > 0.05; });
    }
    /// Presses, and what the lower part is then; it must have changed.
    static std::string changed_by(const std::string& key, const std::string& before) {
        press({key});
        EXPECT_TRUE(shows([&](const std::string& now) { return lower(now) != before; })) << key;
        return lower(still_picture());
    }

    std::optional<CapturedProcess> raks_;
};

TEST_F(Keys, space_stops_the_picture_and_lets_it_go_on) {
    const std::string still = start_and_pause("--no-overlay");
    EXPECT_TRUE(picture() == still);
    press({"space"});
    EXPECT_TRUE(shows_other_than(still));
}

TEST_F(Keys, s_draws_the_stick_figure_and_the_avatar_again) {
    const std::string avatar = start_and_pause("--no-overlay");
    press({"s"});
    EXPECT_TRUE(shows_other_than(avatar));
    press({"s"});
    EXPECT_TRUE(shows_again(avatar));
}

TEST_F(Keys, c_and_home_put_a_turned_camera_back) {
    const std::string first = start_and_pause("--no-overlay");
    for (const char* key : {"c", "Home"}) {
        run_program({"xdotool",
                     "search",
                     "--name",
                     "Raks",
                     "mousemove",
                     "--window",
                     "%1",
                     "300",
                     "150",
                     "mousedown",
                     "1",
                     "mousemove",
                     "--window",
                     "%1",
                     "420",
                     "150",
                     "mouseup",
                     "1"});
        EXPECT_TRUE(shows_other_than(first)) << key;
        press({key});
        EXPECT_TRUE(shows_again(first)) << key;
    }
}

TEST_F(Keys, o_and_tab_show_the_overlay_and_hide_it) {
    const std::string bare = start_and_pause("--no-overlay");
    for (const char* key : {"o", "Tab"}) {
        press({key});
        EXPECT_TRUE(shows_other_than(bare)) << key;
        press({key});
        EXPECT_TRUE(shows_again(bare)) << key;
    }
}

TEST_F(Keys, a_question_mark_shows_the_keys_over_the_overlay) {
    const std::string overlay = start_and_pause("--overlay");
    press({"question"});
    EXPECT_TRUE(shows([&](const std::string& now) { return difference(now, overlay) > 3.0; }));
    press({"question"});
    EXPECT_TRUE(shows([&](const std::string& now) { return lower(now) == lower(overlay); }));
}

TEST_F(Keys, arrows_move_the_position_by_5_and_with_shift_by_30_seconds) {
    const std::string here = lower(start_and_pause("--overlay"));
    const std::string near = changed_by("Right", here);
    EXPECT_TRUE(changed_by("Left", near) == here);
    const std::string far = changed_by("shift+Right", here);
    EXPECT_FALSE(far == near);
    EXPECT_TRUE(changed_by("shift+Left", far) == here);
}

TEST_F(Keys, up_and_down_move_the_volume) {
    const std::string full = lower(start_and_pause("--overlay"));
    const std::string softer = changed_by("Down", full);
    const std::string softest = changed_by("Down", softer);
    EXPECT_FALSE(softest == full);
    EXPECT_TRUE(changed_by("Up", softest) == softer);
    EXPECT_TRUE(changed_by("Up", softer) == full);
}

TEST_F(Keys, f_fills_the_screen_and_gives_it_back) {
    start_and_pause("--no-overlay");
    constexpr std::size_t kWindow = 3U * kWindowWidth * kWindowHeight;
    constexpr std::size_t kScreen = 3U * 960U * 540U;
    for (const char* key : {"f", "F11"}) {
        press({key});
        EXPECT_TRUE(shows([](const std::string& now) { return now.size() == kScreen; })) << key;
        press({key});
        EXPECT_TRUE(shows([](const std::string& now) { return now.size() == kWindow; })) << key;
    }
}

TEST_F(Keys, p_saves_a_picture_of_the_window_and_no_other_key_does) {
    start_and_pause("--no-overlay");
    const std::vector<std::string> before = files();
    press({"p"});
    ASSERT_TRUE(raks_->wait_for_output("screenshot saved: "));
    const std::vector<std::string> after = files();
    ASSERT_EQ(after.size(), before.size() + 1);
    const std::string& file = after[1];  // one.wav, raks-....png, two.wav
    EXPECT_EQ(file.rfind("raks-", 0), 0U) << file;
    const std::string size = run_program({"identify", "-format", "%m %wx%h", path(file)});
    EXPECT_EQ(size, "PNG 640x360");
}

TEST_F(Keys, n_plays_the_next_file) {
    start("--no-overlay");
    press({"n"});
    EXPECT_TRUE(raks_->wait_for_output("playing " + path("two.wav")));
}

TEST_F(Keys, q_and_escape_quit) {
    for (const char* key : {"q", "Escape"}) {
        start_and_pause("--no-overlay");
        press({key});
        const ProcessResult result = raks_->wait();
        EXPECT_FALSE(result.timed_out) << key;
        EXPECT_EQ(result.exit_code, 0) << key << result.err;
        raks_.reset();
    }
}

TEST_F(Keys, k_keeps_to_the_figure_and_lets_go) {
    start("--no-overlay");
    press({"k"});
    EXPECT_TRUE(raks_->wait_for_output("keeping to this figure"));
    press({"k"});
    EXPECT_TRUE(raks_->wait_for_output("figures as they come"));
}

TEST_F(Keys, d_goes_through_the_dances) {
    start("--no-overlay");
    press({"d"});
    EXPECT_TRUE(raks_->wait_for_output("dancing salsa"));
}

/// Live in a window, in silence: the tempo is what the keys make of it.
class TempoKeys : public WindowTest {
 protected:
    /// The tempo at the end of some seconds in which xdotool did this.
    double tempo_after(const std::vector<std::string>& keys) {
        const JackServer jack;
        EXPECT_EQ(jack.problem(), "");
        ProcessPlan plan = in_window({"live", "--device", "system", "--duration", "10"});
        std::erase_if(plan.environment,
                      [](const auto& pair) { return pair.first == "JACK_DEFAULT_SERVER"; });
        CapturedProcess raks(plan);
        EXPECT_TRUE(raks.wait_for_output("listening to"));
        std::vector<std::string> command = {
            "xdotool", "search", "--sync", "--name", "Raks", "windowfocus", "--sync", "key"};
        command.insert(command.end(), keys.begin(), keys.end());
        run_program(command);
        const ProcessResult result = raks.wait();
        EXPECT_EQ(result.exit_code, 0) << result.err;
        const std::size_t at = result.err.find("tempo ");
        return at == std::string::npos ? 0.0 : std::stod(result.err.substr(at + 6));
    }
};

TEST_F(TempoKeys, brackets_halve_and_double_the_tempo) {
    EXPECT_NEAR(tempo_after({"Up"}), 120.0, 1.0) << "another key leaves it";
    EXPECT_NEAR(tempo_after({"bracketleft"}), 60.0, 1.0);
    EXPECT_NEAR(tempo_after({"bracketleft", "bracketright"}), 120.0, 1.0);
}

TEST_F(TempoKeys, t_taps_the_tempo) {
    // 75 BPM, as far as a busy machine lets xdotool keep time and draws pictures, of which each
    // sees the keys since the last: far from the 120 that are there untapped. (How taps become a
    // tempo: tap_tempo_test.cpp.)
    EXPECT_NEAR(tempo_after({"--delay", "800", "t", "t", "t", "t", "t", "t"}), 75.0, 30.0);
}

}  // namespace
}  // namespace raks::test
