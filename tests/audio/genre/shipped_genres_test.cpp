// What the shipped model makes of our own generator's music: the scenes of Ofli 2008, section 7.
// The generator is also among what the model learnt from: this shows that the chain works, not that
// it knows music (docs/measurements/genre.md does).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "tests/audio/listen.hpp"
#include "tests/support/dances.hpp"

namespace raks::audio {
namespace {

using test::listen;
using test::music;

/// One piece after the other.
GeneratedMusic joined(std::initializer_list<GeneratedMusic> pieces) {
    GeneratedMusic all;
    all.channels = 1;
    for (const GeneratedMusic& piece : pieces) {
        const std::vector<float> mono = piece.mono();
        all.samples.insert(all.samples.end(), mono.begin(), mono.end());
    }
    return all;
}

DanceId shown_at(const std::vector<MusicState>& states, double seconds) {
    const auto hop = static_cast<std::size_t>(seconds * kHopsPerSecond);
    return states[std::min(hop, states.size() - 1)].genre;
}

/// Changes of the decision after it was first known.
int switches(const std::vector<MusicState>& states) {
    int count = 0;
    for (std::size_t i = 1; i < states.size(); ++i) {
        const bool is_known = states[i - 1].genre != DanceId::none;
        count += is_known && states[i].genre != states[i - 1].genre ? 1 : 0;
    }
    return count;
}

TEST(ShippedGenres, a_mix_is_followed_within_8_seconds_of_each_change) {
    const GeneratedMusic salsa = music(Style::montuno, {{0.0, 180.0}}, 20.0);
    const GeneratedMusic belly = music(Style::maqsum, {{0.0, 110.0}}, 20.0);
    const auto states = listen(joined({salsa, belly, salsa}));
    EXPECT_EQ(shown_at(states, 19.9), shipped::salsa);
    EXPECT_EQ(shown_at(states, 28.0), shipped::belly);
    EXPECT_EQ(shown_at(states, 39.9), shipped::belly);
    EXPECT_EQ(shown_at(states, 48.0), shipped::salsa);
    EXPECT_EQ(switches(states), 2);
}

TEST(ShippedGenres, five_minutes_of_one_dance_never_switch) {
    const auto states = listen(music(Style::montuno, {{0.0, 185.0}}, 300.0));
    EXPECT_EQ(shown_at(states, 15.0), shipped::salsa);
    EXPECT_EQ(switches(states), 0);
}

TEST(ShippedGenres, slower_and_faster_by_a_tenth_is_the_same_dance) {
    const auto states = listen(
        music(Style::montuno, {{0.0, 180.0}, {15.0, 180.0}, {25.0, 162.0}, {40.0, 198.0}}, 45.0));
    EXPECT_EQ(shown_at(states, 12.0), shipped::salsa);
    EXPECT_EQ(switches(states), 0);
    const auto belly = listen(
        music(Style::maqsum, {{0.0, 110.0}, {15.0, 110.0}, {25.0, 99.0}, {40.0, 121.0}}, 45.0));
    EXPECT_EQ(shown_at(belly, 12.0), shipped::belly);
    EXPECT_EQ(switches(belly), 0);
}

TEST(ShippedGenres, clicks_are_no_dance) {
    const auto states = listen(music(Style::clicks, {{0.0, 120.0}}, 25.0));
    EXPECT_EQ(states.back().genre, DanceId::none);
}

TEST(ShippedGenres, silence_and_applause_change_nothing) {
    GeneratedMusic piece = music(Style::montuno, {{0.0, 180.0}}, 15.0);
    const std::size_t ten_seconds = 480'000 * static_cast<std::size_t>(piece.channels);
    piece.samples.resize(piece.samples.size() + ten_seconds);
    // Applause: claps of many hands at any time, here noise of a steady level.
    const CounterRandom random(3);
    for (std::size_t i = 0; i < ten_seconds; ++i) {
        piece.samples.push_back(static_cast<float>(0.1 * (random.uniform(i) - 0.5)));
    }
    const auto states = listen(piece);
    EXPECT_EQ(shown_at(states, 14.9), shipped::salsa);
    EXPECT_EQ(states.back().genre, shipped::salsa);
    EXPECT_EQ(switches(states), 0);
}

}  // namespace
}  // namespace raks::audio
