#include "training/figures/label_counts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace raks::motion {
namespace {

constexpr double kFps = 100.0;

/// A beat every half second from 0.25 s on, bars of four from the first.
DancedMusic even_music(double duration = 30.0) {
    DancedMusic music{"song.wav", duration, {}, 0.0};
    for (int i = 0; 0.25 + 0.5 * i < duration; ++i) {
        music.beats.push_back({0.25 + 0.5 * i, i % 4 + 1});
    }
    return music;
}

FigureLabel label_at(std::size_t start, std::size_t end, int beats = 8) {
    FigureLabel label;
    label.start = start;
    label.end = end;
    label.beats = beats;
    return label;
}

/// Of a label from 10.2 s to 14.2 s: beats at 10.25, 10.75, ... 14.25.
void expect_even(const Expected<LabelCounts>& counts, std::size_t beats = 8) {
    ASSERT_TRUE(counts) << counts.error().message;
    EXPECT_EQ(counts->left_out, "");
    ASSERT_EQ(counts->frames.size(), beats + 1);
    for (std::size_t b = 0; b <= beats; ++b) {
        EXPECT_NEAR(counts->frames[b],
                    1025.0 + 400.0 * static_cast<double>(b) / static_cast<double>(beats),
                    1e-9);
    }
}

TEST(MusicCounts, are_the_beats_nearest_to_start_and_end_and_all_between) {
    expect_even(counts_of(label_at(1020, 1420), even_music(), kFps));
    expect_even(counts_of(label_at(1035, 1410), even_music(), kFps));
    expect_even(counts_of(label_at(1020, 1420, 0), even_music(), kFps));  // not said how many
}

TEST(MusicCounts, offset_is_where_the_clip_begins_in_the_music) {
    DancedMusic music = even_music();
    music.offset = 3.0;
    expect_even(counts_of(label_at(1020, 1420), even_music(), kFps));
    const Expected<LabelCounts> later = counts_of(label_at(720, 1120), music, kFps);
    ASSERT_TRUE(later);
    EXPECT_NEAR(later->frames.front(), 725.0, 1e-9);
    music.offset = -2.0;
    const Expected<LabelCounts> earlier = counts_of(label_at(1220, 1620), music, kFps);
    ASSERT_TRUE(earlier);
    EXPECT_NEAR(earlier->frames.front(), 1225.0, 1e-9);
}

TEST(MusicCounts, beats_that_were_missed_are_filled_in) {
    DancedMusic music = even_music();
    std::erase_if(music.beats, [](const MusicBeat& beat) {
        return std::abs(beat.seconds - 11.75) < 0.1 || std::abs(beat.seconds - 12.25) < 0.1;
    });
    expect_even(counts_of(label_at(1020, 1420), music, kFps));
}

TEST(MusicCounts, an_octave_heard_is_brought_back) {
    DancedMusic half = even_music();
    std::size_t i = 0;
    std::erase_if(half.beats, [&](const MusicBeat&) { return i++ % 2 == 1; });  // 10.25, 11.25...
    expect_even(counts_of(label_at(1020, 1420), half, kFps));
    DancedMusic twice = even_music();
    const std::vector<MusicBeat> beats = twice.beats;
    twice.beats.clear();
    for (const MusicBeat& beat : beats) {
        twice.beats.push_back(beat);
        twice.beats.push_back({beat.seconds + 0.25, 0});
    }
    expect_even(counts_of(label_at(1020, 1420), twice, kFps));
}

TEST(MusicCounts, between_two_beats_the_bar_decides) {
    // 10.03 lies between 9.75 (bar position 4) and 10.25 (1).
    const Expected<LabelCounts> counts = counts_of(label_at(997, 1425), even_music(), kFps);
    ASSERT_TRUE(counts);
    EXPECT_NEAR(counts->frames.front(), 1025.0, 1e-9);
}

TEST(MusicCounts, a_label_of_another_length_is_left_out_with_the_reason) {
    const Expected<LabelCounts> counts = counts_of(label_at(1020, 1370), even_music(), kFps);
    ASSERT_TRUE(counts);
    EXPECT_EQ(counts->left_out, "7 beats were heard in it, the label says 8");
}

TEST(MusicCounts, labels_outside_the_music_or_without_beats_are_errors) {
    const auto message = [](const FigureLabel& label, const DancedMusic& music) {
        const Expected<LabelCounts> counts = counts_of(label, music, kFps);
        return counts ? std::string("fine") : counts.error().message;
    };
    EXPECT_EQ(message(label_at(2800, 3200), even_music()),
              "ends at 32.0 s of song.wav, which is 30.0 s long; is --offset right?");
    DancedMusic early = even_music();
    early.offset = -11.0;
    EXPECT_EQ(message(label_at(1020, 1420), early),
              "starts 0.8 s before song.wav does; is --offset right?");
    DancedMusic none = even_music();
    std::erase_if(none.beats, [](const MusicBeat& beat) { return beat.seconds > 9.0; });
    const std::string no_beats =
        "no beats were heard in song.wav from 10.2 to 14.2 s; is --offset right? Else give "
        "--counts";
    EXPECT_EQ(message(label_at(1020, 1420), none), no_beats);
    none.beats.clear();
    EXPECT_EQ(message(label_at(1020, 1420), none), no_beats);
    none.beats = {{10.2, 1}};
    EXPECT_EQ(message(label_at(1020, 1420), none), no_beats);
    EXPECT_NE(message(label_at(1020, 1420), DancedMusic{"x", 1e9, {}, std::nan("")}), "fine");
}

}  // namespace
}  // namespace raks::motion
