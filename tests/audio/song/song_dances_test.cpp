#include "audio/song/song_dances.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace raks::audio {
namespace {

// Seconds of music whose classes have these probabilities.
void add(std::vector<MusicState>& states, double seconds, const std::vector<float>& chances) {
    for (int i = 0; i < static_cast<int>(seconds * kHopsPerSecond); ++i) {
        MusicState state;
        state.is_silent = false;
        for (std::size_t c = 0; c < chances.size(); ++c) {
            state.genre_log_probability[c] = std::log(chances[c]);
        }
        states.push_back(state);
    }
}

TEST(SongDances, one_class_holds_through_a_passage_that_looks_like_another) {
    std::vector<MusicState> states;
    add(states, 40.0, {0.7F, 0.2F, 0.1F});
    add(states, 8.0, {0.2F, 0.7F, 0.1F});
    add(states, 40.0, {0.7F, 0.2F, 0.1F});
    const auto sections = find_sections(states, 3, 3.0);
    ASSERT_EQ(sections.size(), 1U);
    EXPECT_EQ(sections[0].first_hop, 0U);
    EXPECT_EQ(sections[0].genre_class, 0);
}

TEST(SongDances, what_truly_changes_is_another_section) {
    std::vector<MusicState> states;
    add(states, 60.0, {0.9F, 0.05F, 0.05F});
    add(states, 60.0, {0.05F, 0.9F, 0.05F});
    const auto sections = find_sections(states, 3, 3.0);
    ASSERT_EQ(sections.size(), 2U);
    EXPECT_EQ(sections[1].genre_class, 1);
    // Windows of 3 s show a change 1.5 s late.
    EXPECT_NEAR(static_cast<double>(sections[1].first_hop), 6'000.0 - 150.0, 100.0);
}

TEST(SongDances, the_first_seconds_get_the_class_of_the_song) {
    std::vector<MusicState> states;
    add(states, 3.0, {0.2F, 0.2F, 0.6F});
    add(states, 60.0, {0.8F, 0.1F, 0.1F});
    const auto sections = find_sections(states, 3, 3.0);
    ASSERT_EQ(sections.size(), 1U);
    EXPECT_EQ(sections[0].genre_class, 0);
}

TEST(SongDances, silence_and_shortness_are_no_evidence) {
    EXPECT_TRUE(find_sections({}, 3, 3.0).empty());
    const std::vector<MusicState> silent(2'000);
    EXPECT_EQ(find_sections(silent, 3, 3.0).size(), 1U);
    const std::vector<MusicState> shorter(10);
    EXPECT_EQ(find_sections(shorter, 3, 3.0).size(), 1U);
}

}  // namespace
}  // namespace raks::audio
