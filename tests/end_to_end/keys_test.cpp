// Each key by itself, by what it alone changes in the picture, the files or the last line.
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <utility>

#include "base/file.hpp"
#include "tests/end_to_end/keys_fixture.hpp"
#include "tests/end_to_end/window.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/jack_midi_peer.hpp"
#include "tests/support/jack_server.hpp"
#include "tests/support/run_program.hpp"

namespace raks::test {
namespace {

/// The codecs of a film's streams, a line each, as ffprobe reads them.
std::string codecs_of(const std::string& film) {
    return run_program(
        {"ffprobe", "-v", "error", "-show_entries", "stream=codec_name", "-of", "csv=p=0", film});
}

class Keys : public KeysTest {};

TEST_F(Keys, q_does_not_wait_for_a_decoder_that_hangs) {
    start("--no-overlay");
    ASSERT_TRUE(shows_dancing());
    for (const pid_t child : children_of(raks_->pid())) {
        ::kill(child, SIGSTOP);
    }
    press({"Right", "q"});
    const ProcessResult result = raks_->wait();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err.find("hung"), std::string::npos) << result.err;
}

TEST_F(Keys, a_display_that_is_gone_ends_it_with_a_line_of_ours) {
    start("--no-overlay");
    ASSERT_TRUE(shows_dancing());
    display_.reset();
    const ProcessResult result = raks_->wait();
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(count_of("display is gone", result.err), 1) << result.err;
    EXPECT_EQ(count_of("raks: ", result.err), count_of("\n", result.err)) << result.err;
}

TEST_F(Keys, a_film_is_whole_where_the_display_goes_away_meanwhile) {
    start({"play", "--no-sound", "--no-overlay", "--record", path("show.mkv")});
    ASSERT_TRUE(shows_dancing());
    display_.reset();
    const ProcessResult result = raks_->wait();
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(count_of("raks: recorded: ", result.err), 1) << result.err;
    EXPECT_EQ(count_of("raks: the display is gone\n", result.err), 1) << result.err;
    const std::string said = codecs_of(path("show.mkv"));
    EXPECT_EQ(said, "h264\nopus\n");
}

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

// No compositor runs: what is transparent is black, and that is said.
TEST_F(Keys, x_goes_from_the_stage_to_nothing_to_a_key_colour_and_back) {
    const std::string stage = start_and_pause("--no-overlay");
    press({"x"});
    EXPECT_TRUE(raks_->wait_for_output("transparent, but no compositor runs: black is seen"));
    EXPECT_TRUE(shows_corner({0, 0, 0}));
    press({"x"});
    EXPECT_TRUE(raks_->wait_for_output("backdrop: key colour #00ff00"));
    EXPECT_TRUE(shows_corner({0, 255, 0}));
    press({"x"});
    EXPECT_TRUE(raks_->wait_for_output("backdrop: stage"));
    EXPECT_TRUE(shows_again(stage));
}

TEST_F(Keys, w_and_y_take_the_frame_away_and_keep_the_window_on_top) {
    start("--no-overlay");
    for (const auto& [key, said] : {std::pair{"w", "the window has no frame (W: give it back)"},
                                    {"w", "the window has its frame"},
                                    {"y", "the window stays over all others (Y: no more)"},
                                    {"y", "other windows may lie over this one"}}) {
        press({key});
        EXPECT_TRUE(raks_->wait_for_output(said)) << key;
    }
}

TEST_F(Keys, f9_records_a_film_until_it_is_pressed_again) {
    start("--no-overlay");
    ASSERT_TRUE(shows_dancing());
    press({"F9"});
    ASSERT_TRUE(raks_->wait_for_output("raks: recording "));
    EXPECT_TRUE(shows_dancing());
    press({"F9"});
    ASSERT_TRUE(raks_->wait_for_output("raks: recorded: "));
    const auto films = screenshots();
    ASSERT_EQ(films.size(), 1U);
    EXPECT_EQ(films.front().substr(films.front().size() - 4), ".mp4");
    const std::string said = codecs_of(path("pictures/" + films.front()));
    EXPECT_EQ(said, "h264\naac\n");
}

// Premultiplied colours are laid over what is behind.
TEST_F(Keys, a_transparent_window_shows_what_lies_behind_it) {
    run_program({"convert", "-size", "960x540", "xc:#2060c0", path("blue.png")});
    const ChildProcess behind({"display", "-geometry", "960x540+0+0", path("blue.png")},
                              "/dev/null");
    const ChildProcess compositor({"picom", "--backend", "xrender"}, "/dev/null");
    // Without the frame that `display` draws.
    const auto screen_now = [] {
        return run_program(
            {"import", "-window", "root", "-crop", "940x520+10+10", "-depth", "8", "rgb:-"});
    };
    const std::array blue = {0x20, 0x60, 0xC0};
    for (int looks = 0; looks < 100 && corner(screen_now()) != blue; ++looks) {
    }
    // A window that opens before the compositor runs stays opaque.
    for (int tries = 0; tries < 20; ++tries) {
        start({"play",
               "--no-sound",
               "--no-overlay",
               "--backdrop",
               "transparent",
               "--borderless",
               "--no-shadow",
               "--no-rings"});
        if (count_of("no compositor", raks_->output().err) == 0) {
            break;
        }
        raks_.reset();
    }
    ASSERT_TRUE(raks_) << "no compositor";
    ASSERT_TRUE(shows_dancing());
    const std::string screen = screen_now();
    ASSERT_EQ(screen.size(), 940U * 520U * 3U);
    std::size_t others = 0;
    for (std::size_t i = 0; i < screen.size(); i += 3) {
        others += corner(screen.substr(i, 3)) != blue ? 1U : 0U;
    }
    EXPECT_EQ(corner(screen), blue);
    EXPECT_GT(others, 1000U) << "nobody dances";
    EXPECT_LT(others, screen.size() / 3 / 5) << "it is not transparent everywhere";
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

TEST_F(Keys, a_question_mark_shows_the_keys_over_the_overlay_page_by_page) {
    const std::string overlay = start_and_pause("--overlay");
    press({"question"});
    EXPECT_TRUE(shows([&](const std::string& now) { return difference(now, overlay) > 3.0; }));
    const std::string first = still_picture();
    press({"question"});
    EXPECT_TRUE(shows([&](const std::string& now) {
        return difference(now, overlay) > 3.0 && difference(now, first) > 1.0;
    })) << "so small a window has room for half of them";
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
    for (const std::size_t size : {kScreen, kWindow}) {
        run_program({"xdotool",
                     "search",
                     "--name",
                     "Raks",
                     "mousemove",
                     "--window",
                     "%1",
                     "320",
                     "100",
                     "click",
                     "--repeat",
                     "2",
                     "--delay",
                     "60",
                     "1"});
        EXPECT_TRUE(shows([&](const std::string& now) { return now.size() == size; }))
            << "a double click";
    }
}

TEST_F(Keys, p_saves_a_picture_of_the_window_and_no_other_key_does) {
    start_and_pause("--no-overlay");
    const std::vector<std::string> before = files();
    press({"p"});
    ASSERT_TRUE(raks_->wait_for_output("screenshot saved: " + path("pictures")));
    EXPECT_EQ(files(), before) << "nothing in the folder where it was started";
    const std::vector<std::string> pictures = screenshots();
    ASSERT_EQ(pictures.size(), 1U);
    EXPECT_EQ(pictures[0].rfind("raks-", 0), 0U) << pictures[0];
    const std::string size =
        run_program({"identify", "-format", "%m %wx%h", path("pictures/" + pictures[0])});
    EXPECT_EQ(size, "PNG 640x360");
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

/// The half above the line that tells what was done.
std::string upper(const std::string& picture) { return picture.substr(0, picture.size() / 2); }

TEST_F(Keys, page_up_and_down_shift_the_picture_against_the_sound) {
    const std::string first = upper(dance_and_pause());
    press(std::vector<std::string>(20, "Prior"));
    EXPECT_TRUE(raks_->wait_for_output("latency offset +100 ms"));
    EXPECT_TRUE(
        shows([&](const std::string& now) { return difference(upper(now), first) > 0.05; }));
    press(std::vector<std::string>(20, "Next"));
    EXPECT_TRUE(raks_->wait_for_output("latency offset +0 ms"));
    EXPECT_TRUE(shows([&](const std::string& now) { return upper(now) == first; }));
}

TEST_F(Keys, l_goes_through_the_themes) {
    const std::string first = upper(start_and_pause("--no-overlay"));
    press({"l"});
    EXPECT_TRUE(raks_->wait_for_output("theme club"));
    EXPECT_TRUE(shows([&](const std::string& now) { return difference(upper(now), first) > 3.0; }));
    press({"l", "l", "l", "l"});
    EXPECT_TRUE(shows([&](const std::string& now) { return upper(now) == first; }));
}

TEST_F(Keys, v_goes_through_the_cameras) {
    const std::string first = upper(start_and_pause("--no-overlay"));
    press({"v"});
    EXPECT_TRUE(raks_->wait_for_output("camera wide"));
    press({"v", "v"});
    EXPECT_TRUE(raks_->wait_for_output("camera front"));
    EXPECT_TRUE(shows([&](const std::string& now) { return difference(upper(now), first) > 0.3; }));
    press({"v", "v", "v", "v"});
    EXPECT_TRUE(raks_->wait_for_output("camera director"));
    EXPECT_TRUE(shows([&](const std::string& now) { return upper(now) == first; }));
}

/// Points where somebody stands on the left: far from the background at the edge of their row.
int points_on_the_left(const std::string& picture) {
    int points = 0;
    for (std::size_t y = kWindowHeight / 4; y < kWindowHeight / 2; ++y) {
        const char* const row = picture.data() + 3 * y * kWindowWidth;
        for (std::size_t x = kWindowWidth / 8; x < 3 * kWindowWidth / 8; ++x) {
            const int here = static_cast<unsigned char>(row[3 * x]);
            const int edge = static_cast<unsigned char>(row[0]);
            points += std::abs(here - edge) > 40 ? 1 : 0;
        }
    }
    return points;
}

TEST_F(Keys, e_goes_through_the_formations) {
    const std::string alone = start_and_pause("--no-overlay");
    EXPECT_LT(points_on_the_left(alone), 20);
    press({"space", "e"});
    ASSERT_TRUE(raks_->wait_for_output("dancing: couple"));
    press({"e"});
    ASSERT_TRUE(raks_->wait_for_output("dancing: unison"));
    EXPECT_TRUE(shows([](const std::string& now) { return points_on_the_left(now) > 200; }));
    press({"e", "e", "e", "e", "e", "e"});  // canon, free, grid, ring, v
    ASSERT_TRUE(raks_->wait_for_output("dancing: solo"));
    EXPECT_TRUE(shows([](const std::string& now) { return points_on_the_left(now) < 20; }));
}

TEST_F(Keys, i_teaches_a_midi_controller_which_is_kept) {
    const JackServer jack;
    ASSERT_EQ(jack.problem(), "");
    JackMidiPeer box("box");
    ASSERT_TRUE(box.is_running());
    ProcessPlan plan =
        in_window({"play", "--no-sound", "--midi-in", "box", path("one.wav"), path("two.wav")});
    std::erase_if(plan.environment,
                  [](const auto& pair) { return pair.first == "JACK_DEFAULT_SERVER"; });
    raks_.emplace(plan);
    ASSERT_TRUE(raks_->wait_for_output("MIDI is heard from box:out"));
    // The first row that is found; the button is pressed until it is learnt, and then works.
    press({"i", "n", "e", "x", "t", "Return"});
    EXPECT_TRUE(raks_->wait_until([&](const ProcessResult& said) {
        box.send({0xB0, 21, 127});
        box.send({0xB0, 21, 0});
        return said.err.find("control 21: next file") != std::string::npos;
    }));
    box.send({0xB0, 21, 127});
    EXPECT_TRUE(raks_->wait_for_output("two.wav"));
    const auto kept = read_file(path("state/raks/midi.toml"));
    ASSERT_TRUE(kept) << kept.error().message;
    EXPECT_NE(kept->find("device = \"box:out\""), std::string::npos) << *kept;
    EXPECT_NE(kept->find("action = \"next-file\""), std::string::npos) << *kept;
}

TEST_F(Keys, beats_are_nudged_counted_and_held) {
    start("--no-overlay");
    const std::array effects = {
        std::pair{"comma", "beats 10 ms earlier (-10 ms in all)"},
        std::pair{"period", "beats 10 ms later (+0 ms in all)"},
        std::pair{"Return", "this beat is count 1"},
        std::pair{"h", "tempo held (R follows the music)"},
        std::pair{"r", "tempo follows the music"},
    };
    for (const auto& [key, said] : effects) {
        press({key});
        EXPECT_TRUE(raks_->wait_for_output(said)) << key;
    }
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
        const std::size_t at = result.err.rfind("tempo ");  // what was said at the end
        return at == std::string::npos ? 0.0 : std::stod(result.err.substr(at + 6));
    }
};

TEST_F(TempoKeys, brackets_halve_and_double_the_tempo) {
    EXPECT_NEAR(tempo_after({"Up"}), 120.0, 1.0) << "another key leaves it";
    EXPECT_NEAR(tempo_after({"bracketleft"}), 60.0, 1.0);
    EXPECT_NEAR(tempo_after({"bracketleft", "bracketright"}), 120.0, 1.0);
}

TEST_F(TempoKeys, plus_and_minus_set_the_tempo_by_1_bpm) {
    EXPECT_NEAR(tempo_after({"plus", "plus", "equal"}), 123.0, 0.2);
    EXPECT_NEAR(tempo_after({"minus", "minus", "minus"}), 117.0, 0.2);
}

TEST_F(TempoKeys, t_taps_the_tempo) {
    // 75 BPM, as far as a busy machine lets xdotool keep time and draws pictures, of which each
    // sees the keys since the last: far from the 120 that are there untapped. (How taps become a
    // tempo: tap_tempo_test.cpp.)
    EXPECT_NEAR(tempo_after({"--delay", "800", "t", "t", "t", "t", "t", "t"}), 75.0, 30.0);
}

}  // namespace
}  // namespace raks::test
