#include "engine/players/player_message.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "base/file.hpp"
#include "tests/support/bus_peer.hpp"

namespace raks::engine {
namespace {

/// What a message of the fuzzers' corpus says; nothing: it is refused.
std::optional<PlayerNews> news_in(const std::string& name) {
    const auto body = read_file(
        std::string(RAKS_SOURCE_DIR) + "/tests/fuzz/corpus/player_message/" + name + ".bin",
        1'000'000);
    EXPECT_TRUE(body) << name;
    std::optional<PlayerNews> found;
    EXPECT_TRUE(test::with_player_message(*body, [&](sd_bus_message* message) {
        if (auto news = read_player_properties(message)) {
            found = std::move(*news);
        }
    }));
    return found;
}

TEST(PlayerMessage, says_status_and_song) {
    const auto news = news_in("song");
    ASSERT_TRUE(news && news->song);
    EXPECT_EQ(news->status, PlayStatus::playing);
    EXPECT_EQ(news->song->tags,
              (audio::AudioTags{
                  "Quimbara", "Celia Cruz, Johnny Pacheco", "Celia & Johnny", "Salsa", 101.0}));
    EXPECT_NE(news->song->key, 0U);
    const auto paused = news_in("paused");
    ASSERT_TRUE(paused);
    EXPECT_EQ(paused->status, PlayStatus::paused);
    EXPECT_FALSE(paused->song);
}

TEST(PlayerMessage, takes_types_that_players_send_against_the_rules_and_no_nonsense) {
    const auto news = news_in("odd_types");
    ASSERT_TRUE(news && news->song);
    EXPECT_FALSE(news->status) << "a number";
    EXPECT_EQ(news->song->tags, (audio::AudioTags{"a, b", "x", "", "House", {}}));
    for (const char* name : {"nested", "empty", "no_metadata"}) {
        const auto other = news_in(name);
        ASSERT_TRUE(other) << name;
        EXPECT_FALSE(other->song) << name;
    }
}

TEST(PlayerMessage, is_cleaned_and_cut) {
    const auto control = news_in("control");
    ASSERT_TRUE(control && control->song);
    EXPECT_EQ(control->song->tags.title.find_first_of("\n\r\x1b"), std::string::npos);
    EXPECT_EQ(control->song->tags.bpm, 120.0) << "a text";
    const auto cut = news_in("long");
    ASSERT_TRUE(cut && cut->song);
    EXPECT_LE(cut->song->tags.title.size(), 200U);
    EXPECT_LE(cut->song->tags.genre.size(), 200U);
}

TEST(PlayerMessage, knows_local_files_by_their_urls) {
    EXPECT_EQ(local_file_of("file:///music/La%20vida%20%C3%A9s.flac"),
              "/music/La vida \xC3\xA9s.flac");
    EXPECT_EQ(local_file_of("file://localhost/a.wav"), "/a.wav");
    for (const char* url : {"",
                            "/a.wav",
                            "http://host/a.wav",
                            "file://host/a.wav",
                            "file:a.wav",
                            "file:///a%",
                            "file:///a%4",
                            "file:///a%zz",
                            "file:///a%00b"}) {
        EXPECT_EQ(local_file_of(url), "") << url;
    }
}

TEST(PlayerMessage, names_what_has_changed) {
    const auto body = read_file(
        std::string(RAKS_SOURCE_DIR) + "/tests/fuzz/corpus/player_message/paused.bin", 10'000);
    ASSERT_TRUE(body);
    bool names_it = false;
    EXPECT_TRUE(test::with_player_message(*body, [&](sd_bus_message* message) {
        ASSERT_TRUE(read_player_properties(message));
        names_it = names_player_property(message);
    }));
    EXPECT_TRUE(names_it);
}

}  // namespace
}  // namespace raks::engine
