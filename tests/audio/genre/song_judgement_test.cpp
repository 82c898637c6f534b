// A song judged by all of it so far: three classes, of which the last is none of the dances.
#include "audio/genre/song_judgement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace raks::audio {
namespace {

constexpr std::size_t kThreeClasses = 3;
constexpr std::array<int, kThreeClasses> kBarsOfThree = {4, 3, 0};
constexpr double kHeardStep = 0.1;

SongJudgement::Values sounds_like(std::size_t which, float chance = 0.9F) {
    SongJudgement::Values logs{};
    for (std::size_t c = 0; c < kThreeClasses; ++c) {
        logs[c] = std::log(c == which ? chance : 0.5F * (1.0F - chance));
    }
    return logs;
}

std::size_t best_of(const SongJudgement& song, int beats_per_bar = 0) {
    const SongJudgement::Values logs =
        song.log_chances(SongJudgement::Asked::both, beats_per_bar, kBarsOfThree);
    return static_cast<std::size_t>(std::max_element(logs.begin(), logs.begin() + kThreeClasses) -
                                    logs.begin());
}

void hear(SongJudgement& song, std::size_t which, double seconds) {
    for (double at = 0.0; at < seconds; at += kHeardStep) {
        song.add(sounds_like(which), 1.0, kHeardStep);
    }
}

// The tagger says one class of every patch, as the first number of its embedding is 1, 2 or 3.
TaggerClasses three_words() {
    TaggerClasses tagger;
    tagger.mean.assign(kTagFeatures, 0.0F);
    tagger.deviation.assign(kTagFeatures, 1.0F);
    tagger.weights.assign(kThreeClasses * kTagFeatures, 0.0F);
    for (std::size_t c = 0; c < kThreeClasses; ++c) {
        tagger.weights[c * kTagFeatures + c] = 3.0F;
    }
    tagger.bias.assign(kThreeClasses, 0.0F);
    tagger.knows.assign(kThreeClasses, true);
    return tagger;
}

TaggerWord word_of(std::size_t which, std::uint32_t patches) {
    TaggerWord word;
    word.patches = patches;
    word.embedding[which] = 1.0F;
    return word;
}

TEST(SongJudgement, is_none_of_the_dances_before_anything_is_heard) {
    const SongJudgement song(kThreeClasses);
    EXPECT_EQ(best_of(song), kThreeClasses - 1);
}

TEST(SongJudgement, a_moment_does_not_turn_a_minute) {
    SongJudgement song(kThreeClasses);
    hear(song, 0, 30.0);
    hear(song, 1, 1.5);
    EXPECT_EQ(best_of(song), 0U);
}

TEST(SongJudgement, another_song_without_a_silence_is_told_by_its_own_sound) {
    SongJudgement song(kThreeClasses);
    hear(song, 0, 120.0);
    hear(song, 1, 6.0);
    EXPECT_EQ(best_of(song), 1U);
    hear(song, 1, 5.0);
    EXPECT_EQ(best_of(song), 1U);
}

TEST(SongJudgement, music_that_goes_to_and_fro_is_one_song) {
    SongJudgement song(kThreeClasses);
    hear(song, 0, 60.0);
    for (int i = 0; i < 20; ++i) {
        hear(song, 1, 2.0);
        hear(song, 0, 3.0);
    }
    EXPECT_EQ(best_of(song), 0U);
}

TEST(SongJudgement, forgets_a_song_that_is_over) {
    SongJudgement song(kThreeClasses);
    hear(song, 0, 60.0);
    song.reset();
    hear(song, 1, 1.0);
    EXPECT_EQ(best_of(song), 1U);
}

TEST(SongJudgement, an_impossible_moment_is_one_moment) {
    SongJudgement song(kThreeClasses);
    hear(song, 0, 10.0);
    SongJudgement::Values logs = sounds_like(1);
    logs[0] = -std::numeric_limits<float>::infinity();
    song.add(logs, 1.0, kHeardStep);
    EXPECT_EQ(best_of(song), 0U);
}

TEST(SongJudgement, the_tagger_counts_each_patch_once) {
    const TaggerClasses tagger = three_words();
    SongJudgement song(kThreeClasses);
    for (double at = 0.0; at < 6.0; at += kHeardStep) {
        song.add(sounds_like(0, 0.4F), 1.0, kHeardStep);
        song.add(word_of(1, 1), tagger);  // the same patch all the time
    }
    EXPECT_EQ(best_of(song), 1U) << "the own parts hardly know";
    const auto before = song.log_chances(SongJudgement::Asked::both, 0, kBarsOfThree);
    song.add(word_of(1, 1), tagger);
    EXPECT_EQ(song.log_chances(SongJudgement::Asked::both, 0, kBarsOfThree), before);
    song.add(word_of(0, 2), tagger);
    EXPECT_NE(song.log_chances(SongJudgement::Asked::both, 0, kBarsOfThree), before);
}

TEST(SongJudgement, each_can_be_asked_alone) {
    using Asked = SongJudgement::Asked;
    const TaggerClasses tagger = three_words();
    SongJudgement song(kThreeClasses);
    const auto best = [&](Asked asked) {
        const auto logs = song.log_chances(asked, 0, kBarsOfThree);
        return static_cast<std::size_t>(
            std::max_element(logs.begin(), logs.begin() + kThreeClasses) - logs.begin());
    };
    hear(song, 0, 6.0);
    EXPECT_EQ(best(Asked::tagger), kThreeClasses - 1) << "it has said nothing";
    const auto without = song.log_chances(Asked::own_parts, 0, kBarsOfThree);
    song.add(word_of(1, 1), tagger);
    EXPECT_EQ(best(Asked::tagger), 1U);
    EXPECT_EQ(song.log_chances(Asked::own_parts, 0, kBarsOfThree), without);
}

TEST(SongJudgement, of_one_song_all_counts) {
    SongJudgement song(kThreeClasses, SongJudgement::Songs::one);
    hear(song, 0, 120.0);
    hear(song, 1, 20.0);
    EXPECT_EQ(best_of(song), 0U);
}

TEST(SongJudgement, the_bar_forbids_dances_of_another_one) {
    SongJudgement song(kThreeClasses);
    hear(song, 0, 10.0);
    for (int i = 0; i < 30; ++i) {
        song.add(sounds_like(1), 1.0, kHeardStep);
    }
    const auto free = song.log_chances(SongJudgement::Asked::both, 0, kBarsOfThree);
    const auto in_threes = song.log_chances(SongJudgement::Asked::both, 3, kBarsOfThree);
    const auto in_fours = song.log_chances(SongJudgement::Asked::both, 4, kBarsOfThree);
    EXPECT_LT(in_threes[0] - in_threes[1], free[0] - free[1] - 2.0F);
    EXPECT_GT(in_fours[0] - in_fours[1], free[0] - free[1] + 2.0F);
}

TEST(TaggerClasses, those_without_a_word_share_what_they_get) {
    TaggerClasses tagger = three_words();
    tagger.knows = {false, false, true};
    std::array<float, kThreeClasses> logs{};
    tagger.log_chances(word_of(0, 1).embedding, logs);
    EXPECT_FLOAT_EQ(logs[0], logs[1]);
    float sum = 0.0F;
    for (const float log : logs) {
        sum += std::exp(log);
    }
    EXPECT_NEAR(sum, 1.0F, 1e-5F);
    EXPECT_GT(logs[0], logs[2]);
}

TEST(TaggerClasses, wrong_sizes_and_numbers_are_named) {
    const TaggerClasses good = three_words();
    EXPECT_TRUE(validate(good, kThreeClasses));
    EXPECT_FALSE(validate(good, kThreeClasses + 1));
    TaggerClasses bad = good;
    bad.bias.pop_back();
    EXPECT_NE(validate(bad, kThreeClasses).error().message.find("tagger.bias has 2"),
              std::string::npos);
    bad = good;
    bad.deviation[7] = 0.0F;
    EXPECT_FALSE(validate(bad, kThreeClasses));
    bad = good;
    bad.weights[7] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(validate(bad, kThreeClasses));
}

}  // namespace
}  // namespace raks::audio
