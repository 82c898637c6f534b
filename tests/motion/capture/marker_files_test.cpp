// The files that the steps of a capture hand on: they read back to the same values, and say what is
// wrong with them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/observations.hpp"
#include "motion/capture/markers/tracks.hpp"
#include "motion/skeleton/formats/points.hpp"
#include "tests/support/mangled.hpp"

namespace raks::capture {
namespace {

Observations some_observations() {
    Observations seen{{"green", "blue"}, {}};
    seen.films.push_back(
        {"left", {{0.1, {{{1.0 / 3.0, 2.5}, 0, 31.0}, {{3.0, 4.0}, 1, 0.0}}}, {0.2, {}}}});
    seen.films.push_back({"right", {{0.15, {{{-1.0, 2e3}, 1, 5.0}}}}});
    return seen;
}

Tracks some_tracks() {
    Tracks tracks{{"head", "left_hand"}, 60.0, 1.5, 3, std::vector<MarkerPlace>(6), {}};
    for (std::size_t frame = 0; frame < 3; ++frame) {
        tracks.at(frame, 0) = {
            {0.1 * static_cast<double>(frame), 1.0 / 3.0, 2.0}, 0.004, 3, PlaceSource::seen};
    }
    tracks.at(1, 1) = {{1.0, 1.0, 1.0}, 0.02, 0, PlaceSource::filled};
    tracks.flags = {{Doubt::lost, 1, 0, 2}, {Doubt::jumped, 0, 1, 1, "left"}};
    return tracks;
}

std::string why_not(const std::string& table) {
    const auto read = read_observations(table, "d.csv");
    return read ? "" : read.error().message;
}

TEST(MarkerSet, the_shipped_one_reads_back) {
    const MarkerSet set = default_markers();
    EXPECT_EQ(set.markers.size(), 20U);
    EXPECT_EQ(set.colours().size(), 5U);
    EXPECT_EQ(default_markers(MarkerColours::unique).colours().size(), 20U);
    const auto read = read_marker_set(marker_set_text(set), "m.toml");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->markers.size(), set.markers.size());
    EXPECT_EQ(read->radius, set.radius);
    for (std::size_t i = 0; i < set.markers.size(); ++i) {
        EXPECT_EQ(read->markers[i].name, set.markers[i].name);
        EXPECT_EQ(read->markers[i].colour, set.markers[i].colour);
        EXPECT_EQ(read->markers[i].bone, set.markers[i].bone);
        EXPECT_EQ(read->markers[i].place, set.markers[i].place);
    }
}

TEST(MarkerSet, says_what_is_wrong) {
    const std::string text = marker_set_text(default_markers());
    const auto error_with = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        changed.replace(changed.find(from), from.size(), to);
        const auto read = read_marker_set(changed, "m.toml");
        return read ? std::string() : read.error().message;
    };
    EXPECT_NE(error_with("leftHand", "leftHnad").find("leftHand"), std::string::npos);
    EXPECT_NE(error_with("\"c7\"", "\"head\"").find("two markers"), std::string::npos);
    EXPECT_NE(error_with("0.255", "25.5").find("place"), std::string::npos);
    EXPECT_NE(error_with("raks-markers", "other").find("format"), std::string::npos);
    EXPECT_FALSE(read_marker_set("format=\"raks-markers\"\nversion=1\n", "m.toml"));
}

TEST(Observations, read_back_to_the_same_bits) {
    const Observations seen = some_observations();
    const auto read = read_observations(observations_text(seen), "d.csv");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, seen);
}

TEST(Observations, say_what_is_wrong) {
    const std::string head = "camera,picture,time,colour,u,v,area\n";
    EXPECT_NE(why_not("a,b\n"), "");
    EXPECT_NE(why_not(head + "a,0,0,green,nan,1,2\n").find("line 2"), std::string::npos);
    EXPECT_NE(why_not(head + "a,0,0,green,x,1,2\n"), "");
    EXPECT_NE(why_not(head + "a,1,0,green,1,1,2\n").find("should follow"), std::string::npos);
    EXPECT_NE(why_not(head + "a,0,1,,,,\na,1,1,,,,\n").find("come after"), std::string::npos);
    EXPECT_NE(why_not(head + "a,0,1,,,,\nb,0,1,,,,\na,1,2,,,,\n").find("together"),
              std::string::npos);
}

TEST(Clocks, read_back_to_the_same_bits) {
    const std::vector<Clock> clocks = {{"a", 1.0 / 3.0, -20.5, 0.9}, {"b \"2\"", -3.0, 0.0, 1.0}};
    const auto read = read_clocks(clocks_text(clocks), "clocks.toml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, clocks);
    EXPECT_DOUBLE_EQ(clocks[1].capture_time(5.0), 2.0);
    EXPECT_FALSE(read_clocks(clocks_text({{"a", 0, 0, 1}, {"a", 0, 0, 1}}), "clocks.toml"));
    EXPECT_FALSE(read_clocks(clocks_text({{"a", 0, 1e5, 1}}), "clocks.toml"));
}

TEST(Tracks, read_back_to_the_same_bits) {
    const Tracks tracks = some_tracks();
    auto read = read_tracks(tracks_text(tracks), "tracks.csv");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->markers, tracks.markers);
    EXPECT_NEAR(read->frames_per_second, 60.0, 1e-9);
    EXPECT_EQ(read->at(0, 0).place, tracks.at(0, 0).place);
    EXPECT_EQ(read->at(1, 1).source, PlaceSource::filled);
    EXPECT_EQ(read->at(2, 1).source, PlaceSource::lost);
    ASSERT_TRUE(read_flags(flags_text(tracks), "flags.tsv", *read));
    EXPECT_EQ(read->flags, tracks.flags);
    // Tables of before there were cameras in them.
    ASSERT_TRUE(read_flags("doubt\tmarker\tfirst\tlast\nlost\thead\t0\t1\n", "f.tsv", *read));
    EXPECT_EQ(read->flags, (std::vector<Flag>{{Doubt::lost, 0, 0, 1}}));
}

TEST(Tracks, say_what_is_wrong) {
    const std::string text = tracks_text(some_tracks());
    EXPECT_FALSE(read_tracks("x\n", "t.csv"));
    EXPECT_FALSE(read_tracks(text.substr(0, text.rfind("\n2,")), "t.csv"));
    std::string swapped = text;
    swapped.replace(swapped.rfind("left_hand"), 9, "head");
    EXPECT_NE(read_tracks(swapped, "t.csv").error().message.find("should follow"),
              std::string::npos);
    Tracks tracks = some_tracks();
    EXPECT_FALSE(read_flags("doubt\tmarker\tfirst\tlast\nlost\tfoot\t0\t1\n", "f.tsv", tracks));
    EXPECT_FALSE(read_flags("doubt\tmarker\tfirst\tlast\nlost\thead\t0\t9\n", "f.tsv", tracks));
    EXPECT_EQ(tracks.flags.size(), 2U);
}

TEST(Tracks, other_programs_read_them_as_trc) {
    const Tracks tracks = some_tracks();
    const auto clip = motion::parse_trc(trc_text(tracks, "t.trc"), "t.trc", std::nullopt);
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_EQ(clip->names, tracks.markers);
    EXPECT_NEAR(clip->frames_per_second, 60.0, 1e-9);
    ASSERT_EQ(clip->frame_count, 3U);
    EXPECT_NEAR(clip->position(2, 0).x, 0.2, 1e-6);
    EXPECT_TRUE(std::isnan(clip->position(0, 1).x));
}

TEST(CaptureFiles, survive_any_damage) {
    const std::array<std::string, 4> texts = {observations_text(some_observations()),
                                              tracks_text(some_tracks()),
                                              clocks_text({{"a", 1.0, 2.0, 1.0}}),
                                              marker_set_text(default_markers())};
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        for (const std::string& text : texts) {
            const std::string damaged = test::mangled(text, {.seed = seed});
            (void)read_observations(damaged, "x");
            (void)read_tracks(damaged, "x");
            (void)read_clocks(damaged, "x");
            (void)read_marker_set(damaged, "x");
        }
    }
}

}  // namespace
}  // namespace raks::capture
