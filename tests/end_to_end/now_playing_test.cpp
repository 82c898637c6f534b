// Players on a real session bus, played by sd-bus: what is heard of them, and what the program does
// with it.
#include <gtest/gtest.h>

#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "engine/players/player_watch.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/fake_player.hpp"
#include "tests/support/peers.hpp"
#include "tests/support/pulse_server.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/server_start.hpp"

namespace raks::test {
namespace {

using engine::PlayerEvent;
using engine::PlayerWatch;
using engine::PlayStatus;
using Kind = PlayerEvent::Kind;

FakeSong song_named(const std::string& title, int number = 1) {
    FakeSong song;
    song.title = title;
    song.track = "/org/mpris/track/" + std::to_string(number);
    return song;
}

/// A watch on a bus of its own, and what it has told so far.
class PlayersOnBus : public ::testing::Test {
 protected:
    void SetUp() override { ASSERT_EQ(bus_.problem(), ""); }
    void look() {
        watch_ = PlayerWatch::open();
        ASSERT_TRUE(watch_);
    }
    /// Waits until the newest event is of this song, and is this one.
    [[nodiscard]] bool hears(std::optional<Kind> kind, const std::string& title) {
        return wait_for_answer([&] {
            for (PlayerEvent& event : watch_->take_events()) {
                newest_ = std::move(event);
                ++events_;
            }
            return events_ > 0 && newest_.kind == kind.value_or(newest_.kind) &&
                   newest_.now.tags.title == title;
        });
    }

    SessionBus bus_;
    std::unique_ptr<PlayerWatch> watch_;
    PlayerEvent newest_;
    int events_ = 0;
};

TEST_F(PlayersOnBus, tracks_pauses_and_seeks_are_heard) {
    FakePlayer player("mpv.instance7");
    FakeSong first = song_named("one");
    first.genre = "Salsa";
    first.bpm = 97;
    player.play(first);
    look();
    ASSERT_TRUE(hears(Kind::told, "one")) << "it played before anybody looked";
    EXPECT_EQ(newest_.now.player, "mpv");
    EXPECT_EQ(newest_.now.tags.artist, "somebody");
    EXPECT_EQ(newest_.now.tags.genre, "Salsa");
    EXPECT_EQ(newest_.now.tags.bpm, 97.0);
    player.set_status("Paused");
    EXPECT_TRUE(hears(Kind::stop, "one"));
    player.set_status("Playing");
    EXPECT_TRUE(hears(Kind::jump, "one"));
    player.set_song(song_named("two", 2));
    EXPECT_TRUE(hears(Kind::begins, "two"));
    EXPECT_EQ(newest_.now.tags.bpm, std::nullopt) << "it is of the song before";
    EXPECT_EQ(events_, 4);
}

TEST_F(PlayersOnBus, one_that_comes_later_is_followed_until_it_leaves) {
    look();
    FakePlayer first("vlc");
    first.play(song_named("one"));
    ASSERT_TRUE(hears(std::nullopt, "one"));
    {
        FakePlayer second("firefox.instance_1_42");
        second.play(song_named("two"));
        ASSERT_TRUE(hears(Kind::begins, "two"));
        EXPECT_EQ(newest_.now.player, "firefox");
        first.set_song(song_named("unheard", 3));
        second.set_song(song_named("three", 4));
        EXPECT_TRUE(hears(std::nullopt, "three"));
    }
    ASSERT_TRUE(hears(Kind::begins, "unheard")) << "the first still plays";
}

TEST_F(PlayersOnBus, fifty_players_long_titles_and_lies_do_no_harm) {
    std::vector<std::unique_ptr<FakePlayer>> others;
    for (int i = 0; i < 50; ++i) {
        others.push_back(std::make_unique<FakePlayer>("p" + std::to_string(i)));
        others.back()->set_song(song_named("other"));
    }
    look();
    FakeSong lie = song_named(std::string(1'000'000, 'x') + "\x1b[31m\n");
    lie.url = "file:///etc/../proc/self/mem";
    lie.length = -1;
    FakePlayer player("liar");
    player.play(lie);
    ASSERT_TRUE(wait_for_answer([&] {
        for (PlayerEvent& event : watch_->take_events()) {
            newest_ = std::move(event);
        }
        return newest_.now.player == "liar" && !newest_.now.tags.title.empty();
    }));
    EXPECT_LE(newest_.now.tags.title.size(), 200U);
    EXPECT_EQ(newest_.now.tags.title.find_first_of("\x1b\n"), std::string::npos);
    EXPECT_TRUE(watch_->take_lines().empty());
}

// It is not waited for: others are heard meanwhile, and it is heard when it answers.
TEST_F(PlayersOnBus, one_that_does_not_answer_holds_up_nobody) {
    FakePlayer silent("silent", FakePlayer::Answers::never);
    FakePlayer player("mpv");
    player.play(song_named("one"));
    look();
    EXPECT_TRUE(hears(Kind::told, "one"));
    player.set_status("Paused");
    EXPECT_TRUE(hears(Kind::stop, "one"));
    silent.play(song_named("late"));
    silent.answer();
    EXPECT_TRUE(hears(Kind::begins, "late"));
}

TEST_F(PlayersOnBus, a_flood_is_left_and_said_once) {
    FakePlayer player("mpv");
    look();
    player.play(song_named("one"));
    ASSERT_TRUE(wait_for_answer([&] { return !watch_->take_events().empty(); }));
    player.flood(2'000);
    std::vector<std::string> lines;
    ASSERT_TRUE(wait_for_answer([&] {
        lines = watch_->take_lines();
        return !lines.empty();
    }));
    EXPECT_EQ(lines,
              std::vector<std::string>{
                  "--now-playing: players send too much; it is tried again every 10 s"});
    EXPECT_TRUE(hears(Kind::told, "")) << "nothing is known any more";
}

TEST_F(PlayersOnBus, a_bus_that_ends_is_said_once) {
    look();
    FakePlayer player("mpv");
    player.play(song_named("one"));
    ASSERT_TRUE(wait_for_answer([&] { return !watch_->take_events().empty(); }));
    bus_.kill();
    std::vector<std::string> lines;
    ASSERT_TRUE(wait_for_answer([&] {
        lines = watch_->take_lines();
        return !lines.empty();
    }));
    EXPECT_EQ(lines.size(), 1U);
    EXPECT_NE(lines.front().find("the session bus has ended the connection"), std::string::npos)
        << lines.front();
}

class NowPlaying : public ProgramTest {
 protected:
    [[nodiscard]] ProcessPlan listening(std::vector<std::string> more) const {
        std::vector<std::string> words{"live", "--no-avatar", "--lines", "-"};
        words.insert(words.end(), more.begin(), more.end());
        ProcessPlan result = plan(words);
        std::erase_if(result.environment,
                      [](const auto& pair) { return pair.first == "PULSE_SERVER"; });
        std::erase(result.unset, "DBUS_SESSION_BUS_ADDRESS");
        return result;
    }
    /// What the lines say of songs, a title each.
    static std::vector<std::string> titles_in(const std::string& lines) {
        std::vector<std::string> titles;
        std::istringstream stream(lines);
        for (std::string line; std::getline(stream, line);) {
            const auto said = nlohmann::json::parse(line);
            if (said["do"] == "now") {
                titles.push_back(said["title"]);
            }
        }
        return titles;
    }
};

TEST_F(NowPlaying, is_told_by_lines_osc_and_http_with_a_monitor) {
    const SessionBus bus;
    ASSERT_EQ(bus.problem(), "");
    const PulseServer server;
    ASSERT_EQ(server.problem(), "");
    FakePlayer player("mpv");
    player.play(song_named("Quimbara"));
    UdpReceiver osc;
    const std::string port = std::to_string(TcpListener().port());
    CapturedProcess raks(
        listening({"--osc", osc.place(), "--remote", "--remote-address", "127.0.0.1:" + port}));
    ASSERT_TRUE(raks.wait_for_output("\"Quimbara\"")) << raks.output().err;
    player.set_song(song_named("La negra\n", 2));
    ASSERT_TRUE(raks.wait_for_output("La negra"));
    // The main thread, which serves the state, hears of it with its next turn.
    nlohmann::json playing;
    EXPECT_TRUE(wait_for_answer([&] {
        playing = nlohmann::json::parse(
            run_program({"curl", "-s", "http://127.0.0.1:" + port + "/state"}))["playing"];
        return playing["title"] == "La negra";
    }));
    EXPECT_EQ(
        playing,
        nlohmann::json(
            {{"player", "mpv"}, {"title", "La negra"}, {"artist", "somebody"}, {"playing", true}}));
    raks.send(SIGINT);
    const ProcessResult result = raks.wait();
    EXPECT_EQ(titles_in(result.out), (std::vector<std::string>{"Quimbara", "La negra"}));
    std::size_t named = 0;
    for (const std::string& packet : osc.take_all()) {
        named += packet.starts_with(std::string("/raks/now\0\0\0,ss\0", 16)) ? 1U : 0U;
    }
    EXPECT_EQ(named, 2U);
}

TEST_F(NowPlaying, is_not_asked_for_where_a_person_says_so) {
    const SessionBus bus;
    ASSERT_EQ(bus.problem(), "");
    const PulseServer server;
    ASSERT_EQ(server.problem(), "");
    FakePlayer player("mpv");
    player.play(song_named("Quimbara"));
    const ProcessResult result = run_process(listening({"--no-now-playing", "--duration", "1"}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(titles_in(result.out), std::vector<std::string>{});
}

}  // namespace
}  // namespace raks::test
