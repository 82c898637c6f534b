#include "audio/song/song_repeats.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"

namespace raks::audio {
namespace {

using testing::Each;

// A song with a letter a bar. A small letter is nearly the bar of its capital: a fill. A bar before
// which a '|' stands begins a part.
std::vector<int> repeats_in(const std::string& song) {
    std::string bars;
    std::vector<char> begins;
    bool begins_part = true;
    for (const char letter : song) {
        if (letter == '|') {
            begins_part = true;
        } else if (letter != ' ') {
            bars += letter;
            begins.push_back(begins_part ? 1 : 0);
            begins_part = false;
        }
    }
    return find_repeats(begins, [&](std::size_t a, std::size_t b) {
        const bool is_fill = std::toupper(bars[a]) == std::toupper(bars[b]);
        return bars[a] == bars[b] ? 0.2F : is_fill ? 1.5F : 9.0F;
    });
}

// `count` bars that repeat those from `first` on; or -1.
std::vector<int> row(int first, int count) {
    std::vector<int> bars;
    for (int i = 0; i < count; ++i) {
        bars.push_back(first < 0 ? -1 : first + i);
    }
    return bars;
}

std::vector<int> rows(std::initializer_list<std::pair<int, int>> parts) {
    std::vector<int> bars;
    for (const auto& [first, count] : parts) {
        const std::vector<int> part = row(first, count);
        bars.insert(bars.end(), part.begin(), part.end());
    }
    return bars;
}

TEST(SongRepeats, a_part_that_comes_again_repeats_its_first_time_bar_by_bar) {
    EXPECT_EQ(repeats_in("ABCDEFGH IJKLMNOP ABCDEFGH QRST"), rows({{-1, 16}, {0, 8}, {-1, 4}}));
}

TEST(SongRepeats, the_third_time_repeats_the_first) {
    EXPECT_EQ(repeats_in("ABCDEFGH IJKL ABCDEFGH MNOP ABCDEFGH"),
              rows({{-1, 12}, {0, 8}, {-1, 4}, {0, 8}}));
}

TEST(SongRepeats, verse_and_chorus_in_turn_repeat_both) {
    const std::string verse = "ABCDABCD";
    const std::string chorus = "IJIJIJIJ";
    EXPECT_EQ(repeats_in(verse + chorus + verse + chorus + "XYZ" + chorus),
              rows({{-1, 16}, {0, 16}, {-1, 3}, {8, 8}}));
}

TEST(SongRepeats, a_loop_that_goes_on_is_no_part_that_comes_again) {
    for (const std::string loop : {"A", "AB", "ABC", "ABCD", "ABCDEFGH"}) {
        std::string song;
        for (int i = 0; i < 30; ++i) {
            song += loop;
        }
        EXPECT_THAT(repeats_in(song), Each(-1)) << loop;
    }
}

TEST(SongRepeats, a_loop_that_was_left_for_a_breakdown_comes_again_once) {
    EXPECT_EQ(repeats_in("ABCDABCD ABCDABCD | XXYYXXYY | ABCDABCD ABCDABCD ABCDABCD ABCDABCD"),
              rows({{-1, 24}, {0, 16}, {-1, 16}}));
}

TEST(SongRepeats, a_short_part_counts_where_the_music_changes_around_it) {
    EXPECT_EQ(repeats_in("ABCDEFGH | WXYZ | IJKLMNOP | WXYZ | QRSTU"),
              rows({{-1, 20}, {8, 4}, {-1, 5}}));
    EXPECT_THAT(repeats_in("ABCDEFGH WXYZ IJKLMNOP WXYZ QRSTU"), Each(-1));
    // Its end is cut off by a stop.
    EXPECT_EQ(repeats_in("ABCDEFGH IJKLMNOP ABCDEF | SS"), rows({{-1, 16}, {0, 6}, {-1, 2}}));
}

TEST(SongRepeats, one_bar_of_four_may_be_a_fill) {
    EXPECT_EQ(repeats_in("ABCDEFGH IJKLMNOP ABCdEFGH"), rows({{-1, 16}, {0, 8}}));
    EXPECT_THAT(repeats_in("ABCDEFGH IJKLMNOP abCdeFgh"), Each(-1));
    EXPECT_THAT(repeats_in("ABCDEFGH IJKLMNOP ABCXEFGH"), Each(-1));
}

TEST(SongRepeats, no_bars_have_no_repeats) {
    EXPECT_TRUE(repeats_in("").empty());
    EXPECT_EQ(repeats_in("A"), row(-1, 1));
}

// Songs of phrases drawn from a few, so that loops, chains and overlaps come about.
TEST(SongRepeats, repeats_are_of_bars_that_are_new_and_go_up_by_one_within_a_part) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        const CounterRandom random(seed, 1);
        const std::vector<std::string> phrases = {"ABCD", "ABCE", "FFFF", "GHIJKLMN", "|XY|", "Z"};
        std::string song;
        for (std::uint64_t i = 0; i < 30; ++i) {
            song += phrases[random.below(i, phrases.size())];
        }
        const std::vector<int> repeats = repeats_in(song);
        int length = 0;
        for (std::size_t bar = 0; bar < repeats.size(); ++bar) {
            const int first = repeats[bar];
            if (first >= 0) {
                ASSERT_LT(first, static_cast<int>(bar)) << song;
                ASSERT_EQ(repeats[static_cast<std::size_t>(first)], -1) << song;
            }
            const bool goes_on = bar > 0 && first >= 0 && first == repeats[bar - 1] + 1;
            if (!goes_on) {
                ASSERT_TRUE(length == 0 || length >= 4) << song << " before " << bar;
                length = 0;
            }
            length += first >= 0 ? 1 : 0;
        }
    }
}

}  // namespace
}  // namespace raks::audio
