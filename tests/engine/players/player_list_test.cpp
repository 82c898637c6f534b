#include "engine/players/player_list.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <map>
#include <set>
#include <string>

#include "base/random.hpp"

namespace raks::engine {
namespace {

using Kind = PlayerEvent::Kind;
using Arrival = PlayerList::Arrival;

constexpr const char* kMpv = "org.mpris.MediaPlayer2.mpv";
constexpr const char* kOther = "org.mpris.MediaPlayer2.firefox.instance_1_7";

PlayerSong song_of(const std::string& title, std::uint64_t key) {
    PlayerSong song;
    song.key = key;
    song.tags.title = title;
    song.tags.artist = "somebody";
    return song;
}

/// A list, and a clock in seconds.
class Players : public ::testing::Test {
 protected:
    HostTime after(double seconds) { return now_ += nanos_from_seconds(seconds); }
    void say(const char* name, PlayerNews news, double seconds = 5.0) {
        list_.take(name, news, after(seconds));
    }
    void play(const char* name, const std::string& title, std::uint64_t key, double seconds = 5.0) {
        say(name, {PlayStatus::playing, song_of(title, key)}, seconds);
    }
    /// What has happened, "begins:title" each.
    std::string events() {
        constexpr std::array<const char*, 4> kWords = {"begins", "told", "jump", "stop"};
        std::string text;
        for (const PlayerEvent& event : list_.take_events()) {
            text += (text.empty() ? "" : " ") +
                    std::string(kWords[static_cast<std::size_t>(event.kind)]) + ":" +
                    event.now.tags.title;
        }
        return text;
    }

    PlayerList list_;
    HostTime now_ = HostTime(std::chrono::hours(1));
};

TEST_F(Players, are_named_for_people) {
    EXPECT_EQ(player_name(kMpv), "mpv");
    EXPECT_EQ(player_name(kOther), "firefox");
    EXPECT_EQ(player_name("org.mpris.MediaPlayer2.a\nb"), "a?b");
}

TEST_F(Players, what_played_before_anybody_looked_does_not_begin_now) {
    ASSERT_TRUE(list_.arrive(kMpv, Arrival::was_there, now_));
    play(kMpv, "one", 1);
    EXPECT_EQ(events(), "told:one");
    EXPECT_EQ(list_.now().player, "mpv");
    play(kMpv, "two", 2);
    EXPECT_EQ(events(), "begins:two");
}

TEST_F(Players, that_come_and_play_begin_a_song_unless_they_answer_late) {
    ASSERT_TRUE(list_.arrive(kMpv, Arrival::came, now_));
    play(kMpv, "one", 1, 0.2);
    EXPECT_EQ(events(), "begins:one");
    ASSERT_TRUE(list_.arrive(kOther, Arrival::came, now_));
    list_.leave(kMpv);
    EXPECT_EQ(events(), "stop:");
    play(kOther, "long ago", 2, 10.0);
    EXPECT_EQ(events(), "told:long ago");
}

TEST_F(Players, a_pause_is_a_stop_and_going_on_a_jump) {
    list_.arrive(kMpv, Arrival::was_there, now_);
    play(kMpv, "one", 1);
    say(kMpv, {PlayStatus::paused, {}});
    say(kMpv, {PlayStatus::playing, {}});
    say(kMpv, {PlayStatus::stopped, {}});
    EXPECT_EQ(events(), "told:one stop:one jump:one stop:one");
    say(kMpv, {PlayStatus::playing, song_of("two", 2)});
    EXPECT_EQ(events(), "begins:two");
}

TEST_F(Players, a_song_that_is_chosen_while_it_stands_begins_when_it_plays) {
    list_.arrive(kMpv, Arrival::was_there, now_);
    play(kMpv, "one", 1);
    say(kMpv, {PlayStatus::paused, {}});
    say(kMpv, {{}, song_of("two", 2)});
    EXPECT_EQ(events(), "told:one stop:one told:two");
    say(kMpv, {PlayStatus::playing, {}});
    EXPECT_EQ(events(), "begins:two");
}

TEST_F(Players, one_change_in_several_messages_is_one_song) {
    list_.arrive(kMpv, Arrival::was_there, now_);
    play(kMpv, "one", 1);
    say(kMpv, {{}, PlayerSong{}});  // between two songs
    say(kMpv, {{}, song_of("two.flac", 2)});
    say(kMpv, {{}, song_of("Two", 2)}, 0.3);
    list_.jump(kMpv, after(0.1));
    EXPECT_EQ(events(), "told:one begins:two.flac told:Two");
    list_.jump(kMpv, after(2.0));
    say(kMpv, {{}, song_of("Two", 2)});
    EXPECT_EQ(events(), "jump:Two") << "said again";
}

TEST_F(Players, radio_changes_its_title_alone) {
    list_.arrive(kMpv, Arrival::was_there, now_);
    play(kMpv, "", 7);
    say(kMpv, {{}, song_of("one", 7)});
    say(kMpv, {{}, song_of("two", 7)});
    EXPECT_EQ(events(), "told: told:one begins:two");
}

TEST_F(Players, the_one_that_began_last_is_followed_while_it_plays) {
    list_.arrive(kMpv, Arrival::was_there, now_);
    list_.arrive(kOther, Arrival::was_there, now_);
    play(kMpv, "one", 1);
    say(kOther, {PlayStatus::paused, song_of("talk", 2)});
    say(kOther, {PlayStatus::playing, {}});
    say(kMpv, {{}, song_of("three", 3)});
    list_.jump(kMpv, after(5.0));
    EXPECT_EQ(events(), "told:one begins:talk") << "whoever is not followed is not heard";
    say(kOther, {PlayStatus::paused, {}});
    EXPECT_EQ(events(), "stop:talk begins:three") << "the other one is still heard";
    list_.leave(kMpv);
    EXPECT_EQ(events(), "stop:");
    EXPECT_EQ(list_.now().player, "");
}

TEST_F(Players, that_say_the_same_are_one) {
    list_.arrive(kMpv, Arrival::was_there, now_);
    list_.arrive(kOther, Arrival::was_there, now_);
    play(kMpv, "one", 1);
    play(kOther, "one", 2);
    EXPECT_EQ(events(), "told:one told:one");
    EXPECT_FALSE(list_.arrive("org.mpris.MediaPlayer2.playerctld", Arrival::came, now_))
        << "it speaks for others";
}

TEST_F(Players, are_64_at_most_and_those_that_nobody_knows_say_nothing) {
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(list_.arrive("org.mpris.MediaPlayer2.p" + std::to_string(i), Arrival::came, now_),
                  i < 64);
    }
    play("org.mpris.MediaPlayer2.p99", "x", 1);
    EXPECT_EQ(events(), "");
    list_.leave("org.mpris.MediaPlayer2.p7");
    EXPECT_TRUE(list_.arrive("org.mpris.MediaPlayer2.p99", Arrival::came, now_));
}

// Whatever is said in whatever order: what is followed is on the bus, and the latest of those that
// play; a song begins only while it plays.
TEST_F(Players, follow_the_latest_that_plays_whatever_happens) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const CounterRandom random(seed);
        PlayerList list;
        std::uint64_t draw = 0;
        std::map<std::string, int> playing;  // by name, when it began
        std::set<std::string> there;
        for (int step = 0; step < 100; ++step) {
            const std::string name =
                "org.mpris.MediaPlayer2." +
                std::string(1, static_cast<char>('a' + random.below(draw++, 4)));
            const std::uint64_t what = random.below(draw++, 6);
            const HostTime now = after(0.3);
            if (what == 0) {
                list.arrive(
                    name, random.below(draw++, 2) == 0 ? Arrival::came : Arrival::was_there, now);
                there.insert(name);
                playing.erase(name);
            } else if (what == 1) {
                list.leave(name);
                there.erase(name);
                playing.erase(name);
            } else if (what == 2) {
                list.jump(name, now);
            } else {
                const auto status = static_cast<PlayStatus>(random.below(draw++, 3));
                const std::uint64_t key = random.below(draw++, 4);
                list.take(name, {status, song_of(std::to_string(key), key)}, now);
                if (!there.contains(name) || status != PlayStatus::playing) {
                    playing.erase(name);
                } else {
                    playing.try_emplace(name, step);
                }
            }
            std::string latest;
            for (const auto& [each, began] : playing) {
                latest = latest.empty() || began > playing[latest] ? each : latest;
            }
            if (!playing.empty()) {
                EXPECT_EQ(list.now().player, player_name(latest)) << seed << " " << step;
                EXPECT_EQ(list.now().status, PlayStatus::playing) << seed << " " << step;
            } else {
                EXPECT_NE(list.now().status, PlayStatus::playing) << seed << " " << step;
            }
            for (const PlayerEvent& event : list.take_events()) {
                EXPECT_TRUE(event.kind != Kind::begins || event.now.status == PlayStatus::playing);
            }
        }
    }
}

}  // namespace
}  // namespace raks::engine
