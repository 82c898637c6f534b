// The lists in the window, what is dropped on it, and how a show goes from one sound to another.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/window.hpp"
#include "tests/support/file_drop.hpp"
#include "tests/support/pulse_server.hpp"
#include "tests/support/run_program.hpp"

namespace raks::test {
namespace {

class Lists : public WindowTest {
 protected:
    void start(const std::vector<std::string>& arguments) { raks_.emplace(in_window(arguments)); }
    void play() {
        start({"-v", "play", "--no-sound", path("one.wav")});
        ASSERT_TRUE(raks_->wait_for_output("one.wav"));
    }
    static void drop(const std::vector<std::string>& paths) {
        std::string id = run_program({"xdotool", "search", "--sync", "--name", "Raks"});
        id.erase(id.find('\n'));
        drop_files(id, paths);
    }
    /// A line of the program; it may have been said before the call.
    [[nodiscard]] bool says(const std::string& line) { return raks_->wait_for_output(line); }
    [[nodiscard]] bool says_twice(const std::string& line) {
        return raks_->wait_until(
            [&](const ProcessResult& said) { return count_of(line, said.err) >= 2; });
    }
    void quit() {
        press({"q"});
        const ProcessResult result = raks_->wait();
        EXPECT_FALSE(result.timed_out);
        EXPECT_EQ(result.exit_code, 0) << result.err;
    }

    std::optional<CapturedProcess> raks_;
};

TEST_F(Lists, f4_takes_a_dance_and_space_forbids_one_but_not_the_last) {
    play();
    press({"F4", "w", "a", "l", "t", "z", "Return"});
    EXPECT_TRUE(says("raks: dancing waltz (D: another dance)"));
    // "as it is heard" is the first row, six dances follow.
    press({"F4", "Home"});
    for (int i = 0; i < 12; ++i) {
        press({"Down", "space"});
    }
    EXPECT_TRUE(says("stays allowed: it is the last one"));
    press({"Escape"});
    quit();
}

TEST_F(Lists, escape_closes_a_list_and_the_keys_before_it_quits) {
    play();
    press({"F2", "Escape", "F1", "Escape", "F4", "F4", "F1"});
    press({"Escape"});
    press({"d"});
    EXPECT_TRUE(says("D: another dance"));
    press({"Escape"});
    EXPECT_EQ(raks_->wait().exit_code, 0);
}

TEST_F(Lists, f10_leaves_nothing_but_the_picture) {
    play();
    const std::string with_cards = lower(pause(*raks_));
    press({"F10"});
    EXPECT_TRUE(shows([&](const std::string& now) { return lower(now) != with_cards; }));
    const std::string clean = still_picture();
    press({"b"});
    EXPECT_TRUE(picture() == clean) << "no message either";
    press({"F10"});
    EXPECT_TRUE(shows([&](const std::string& now) { return now != clean; }));
    quit();
}

TEST_F(Lists, dropped_music_plays_now_and_is_added_while_the_queue_is_open) {
    play();
    drop({path("two.wav")});
    EXPECT_TRUE(says("raks: playing " + path("two.wav")));
    press({"shift+F2"});
    drop({path("one.wav"), path("two.wav")});
    EXPECT_TRUE(says("raks: added: 2 files"));
    press({"Escape", "n"});
    EXPECT_TRUE(says_twice("raks: playing " + path("one.wav")));
    press({"shift+F2", "Home", "Return"});
    EXPECT_TRUE(says_twice("raks: playing " + path("two.wav")));
    quit();
}

TEST_F(Lists, a_dropped_clip_is_performed_and_a_written_dance_danced) {
    play();
    drop({std::string(RAKS_SOURCE_DIR) + "/tests/data/bvh/dance/own_dance.bvh"});
    EXPECT_TRUE(says("raks: performing own_dance.bvh: "));
    // A dance of one figure is learnt soon.
    auto text = read_file(std::string(RAKS_SOURCE_DIR) + "/config/choreographies/waltz.toml");
    ASSERT_TRUE(text) << text.error().message;
    text->resize(text->find("[[figure]]", text->find("[[figure]]") + 1));
    text->replace(text->find("\"waltz\""), 7, "\"tango\"");
    ASSERT_TRUE(write_file(path("tango.toml"), *text));
    drop({path("tango.toml")});
    EXPECT_TRUE(says("raks: dancing tango")) << raks_->output().err;
    quit();
}

TEST_F(Lists, a_look_is_kept_as_a_preset_and_taken_again) {
    play();
    press({"l", "F4", "w", "a", "l", "t", "z", "Return"});
    EXPECT_TRUE(says("dancing waltz"));
    press({"shift+F3", "shift+a", "b", "Return"});
    EXPECT_TRUE(says("raks: kept as preset Ab"));
    const auto kept = read_file(path("config/raks/presets/Ab.toml"));
    ASSERT_TRUE(kept) << kept.error().message;
    for (const char* const part : {"club", "\"waltz\"", "\"solo\"", "\"director\""}) {
        EXPECT_NE(kept->find(part), std::string::npos) << part << *kept;
    }
    press({"l", "d"});
    EXPECT_TRUE(says("theme dance_floor"));
    press({"F3", "Return"});
    EXPECT_TRUE(says("raks: preset Ab"));
    EXPECT_TRUE(says_twice("dancing waltz"));
    // What has the name is not lost to who types it again.
    press({"shift+F3", "shift+a", "b", "Return"});
    EXPECT_TRUE(says("there is a preset Ab already"));
    press({"Escape"});
    quit();
    start({"play", "--no-sound", "--preset", "Ab", path("one.wav")});
    EXPECT_TRUE(says("one.wav"));
    quit();
}

TEST_F(Lists, a_preset_that_cannot_be_read_is_told_and_stays_as_it_is) {
    std::filesystem::create_directories(path("config/raks/presets/folder.toml"));
    ASSERT_TRUE(write_file(path("config/raks/presets/bad.toml"), "theme ="));
    play();
    press({"F3", "b", "a", "d", "Return"});
    EXPECT_TRUE(says("bad.toml"));
    press({"shift+F3", "Down", "Return"});
    EXPECT_TRUE(says_twice("bad.toml"));
    EXPECT_EQ(*read_file(path("config/raks/presets/bad.toml")), "theme =");
    press({"Escape"});
    quit();
}

TEST_F(Lists, what_is_of_no_use_is_named_and_the_show_goes_on) {
    ASSERT_TRUE(write_file(path("letter.odt"), "x"));
    ASSERT_TRUE(write_file(path("broken.bvh"), "HIERARCHY\nx"));
    ASSERT_TRUE(write_file(path("broken.toml"), "dance ="));
    ASSERT_TRUE(write_file(path("broken.wav"), "RIFFx"));
    play();
    std::vector<std::string> many(1000, path("gone.mp3"));
    many.push_back(path("letter.odt"));
    drop(many);
    EXPECT_TRUE(says("gone.mp3: is not there"));
    EXPECT_TRUE(says("more of no use"));
    for (const char* const name : {"broken.bvh", "broken.toml", "broken.wav"}) {
        drop({path(name)});
        EXPECT_TRUE(raks_->wait_for_output(std::string(name) + ":")) << name;
    }
    press({"d"});
    EXPECT_TRUE(says("D: another dance"));
    quit();
}

TEST_F(Lists, open_without_a_sound_server_dances_to_its_own_music_and_says_why) {
    start({"open"});
    EXPECT_TRUE(says("raks: music of its own: "));
    EXPECT_TRUE(says("raks: playing "));
    quit();
}

TEST_F(Lists, open_listens_and_f2_takes_another_source_and_dropped_music_plays) {
    PulseServer server("Speakers");
    if (!server.problem().empty()) {
        GTEST_SKIP() << server.problem();
    }
    PulseServer::add_sink("far", "Far Room");
    ProcessPlan plan = in_window({"open"});
    std::erase_if(plan.environment, [](const auto& pair) { return pair.first == "PULSE_SERVER"; });
    raks_.emplace(plan);
    EXPECT_TRUE(says("raks: listening to 'Monitor of Speakers'"));
    press({"F2", "f", "a", "r"});
    // The list comes from a child of its own; until then there is nothing to take.
    EXPECT_TRUE(raks_->wait_until([&](const ProcessResult& said) {
        press({"Return"});
        return count_of("raks: listening to 'Monitor of Far Room'", said.err) > 0;
    }));
    drop({path("two.wav")});
    EXPECT_TRUE(says("raks: sound goes to "));
    EXPECT_TRUE(says("raks: playing " + path("two.wav")));
    quit();
}

}  // namespace
}  // namespace raks::test
