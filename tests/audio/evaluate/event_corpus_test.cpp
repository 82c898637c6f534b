#include "audio/evaluate/event_corpus.hpp"

#include <gtest/gtest.h>

#include "base/pending_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::audio {
namespace {

using Kind = MusicEvent::Kind;

TEST(ParseEvents, reads_times_and_names_in_order) {
    const auto events =
        parse_events("# by ear\r\n12.5 drop by eye\r\n\r\n 0.25\tentry\n", "x.events");
    ASSERT_TRUE(events) << events.error().message;
    ASSERT_EQ(events->size(), 2U);
    EXPECT_EQ((*events)[0].kind, Kind::entry);
    EXPECT_EQ((*events)[0].time, stream_time_from_seconds(0.25));
    EXPECT_EQ((*events)[1].kind, Kind::drop);
    EXPECT_TRUE(parse_events("", "x.events")->empty());
}

TEST(ParseEvents, refuses_anything_else_with_one_line) {
    const struct {
        const char* text;
        const char* message;
    } table[] = {
        {"1.0 stop\nsoon drop\n", "x: line 2: time is \"soon\", must be seconds from 0 to 1000000"},
        {"-1 stop\n", "x: line 1: time is \"-1\", must be seconds from 0 to 1000000"},
        {"nan stop\n", "x: line 1: time is \"nan\", must be seconds from 0 to 1000000"},
        {"1.0\n", "x: line 1: event is \"\", must be stop, entry, breakdown, build-up, drop, end"},
        {"1.0 dropp\n",
         "x: line 1: event is \"dropp\", must be stop, entry, breakdown, build-up, drop, end"},
        {"1.0 none\n",
         "x: line 1: event is \"none\", must be stop, entry, breakdown, build-up, drop, end"},
    };
    for (const auto& row : table) {
        const auto events = parse_events(row.text, "x");
        ASSERT_FALSE(events) << row.text;
        EXPECT_EQ(events.error().message, row.message);
    }
}

TEST(ParseEvents, reads_what_events_text_writes) {
    const std::vector<MusicEvent> events = {{Kind::entry, stream_time_from_seconds(0.5)},
                                            {Kind::build_up, stream_time_from_seconds(31.25)},
                                            {Kind::end, stream_time_from_seconds(99.123456)}};
    const auto again = parse_events(events_text(events), "x");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(events_text(*again), events_text(events));
}

TEST(EventCorpus, lists_songs_by_name_and_says_what_is_missing) {
    const raks::test::TemporaryFolder folder;
    const auto nothing = load_event_corpus(folder.path());
    ASSERT_FALSE(nothing);
    EXPECT_EQ(
        nothing.error().message,
        folder.path().string() + ": holds no song with its events: NAME.events beside NAME.ogg");
    ASSERT_TRUE(write_file(folder.path() / "b.events", "1 entry\n"));
    EXPECT_FALSE(load_event_corpus(folder.path())) << "there is no sound";
    ASSERT_TRUE(write_file(folder.path() / "b.wav", "x"));
    ASSERT_TRUE(write_file(folder.path() / "a.events", "2 entry\n9 end\n"));
    ASSERT_TRUE(write_file(folder.path() / "a.ogg", "x"));
    const auto songs = load_event_corpus(folder.path());
    ASSERT_TRUE(songs) << songs.error().message;
    ASSERT_EQ(songs->size(), 2U);
    EXPECT_EQ((*songs)[0].name, "a");
    EXPECT_EQ((*songs)[0].events.size(), 2U);
    EXPECT_EQ((*songs)[1].audio, folder.path() / "b.wav");
    ASSERT_TRUE(write_file(folder.path() / "c.events", "# nothing\n"));
    EXPECT_EQ(load_event_corpus(folder.path()).error().message,
              (folder.path() / "c.events").string() +
                  ": has no events; a song has its entry and its end");
}

}  // namespace
}  // namespace raks::audio
