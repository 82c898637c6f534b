#include "audio/sync/place_finder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace raks::audio {
namespace {

using Sound = std::vector<float>;

/// Noise that a room has coloured, so that it is no easy case.
Sound noise(double seconds, unsigned seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<float> normal(0.0F, 0.1F);
    Sound sound(static_cast<std::size_t>(seconds * PlaceFinder::kRate));
    float held = 0.0F;
    for (float& sample : sound) {
        held = 0.9F * held + normal(generator);
        sample = held;
    }
    return sound;
}

Sound part_of(const Sound& sound, double begin, double seconds) {
    const auto first = sound.begin() + static_cast<std::ptrdiff_t>(begin * PlaceFinder::kRate);
    return {first, first + static_cast<std::ptrdiff_t>(seconds * PlaceFinder::kRate)};
}

TEST(PlaceFinder, finds_a_part_to_a_millisecond_also_quiet_and_beside_other_sound) {
    const Sound song = noise(200.0, 1);
    PlaceFinder finder(song);
    EXPECT_DOUBLE_EQ(finder.seconds(), 200.0);
    for (const double begin : {0.0, 3.217, 123.456, 199.0}) {
        Sound heard = part_of(song, begin, 1.0);
        const Sound other = noise(1.0, 2);
        for (std::size_t i = 0; i < heard.size(); ++i) {
            heard[i] = -0.01F * heard[i] + 0.005F * other[i];
        }
        for (float& sample : heard) {
            sample = -sample;
        }
        const auto place = finder.find(heard);
        ASSERT_TRUE(place) << begin;
        EXPECT_NEAR(*place, begin, 1e-3);
        const auto near = finder.find_near(heard, begin + 0.1, 0.2);
        ASSERT_TRUE(near) << begin;
        EXPECT_NEAR(*near, begin, 1e-3);
    }
}

TEST(PlaceFinder, finds_nothing_where_nothing_is) {
    const Sound song = noise(60.0, 1);
    PlaceFinder finder(song);
    EXPECT_FALSE(finder.find(noise(1.0, 7)));
    EXPECT_FALSE(finder.find(noise(8.0, 7)));
    EXPECT_FALSE(finder.find(Sound(4'000)));
    EXPECT_FALSE(finder.find({}));
    EXPECT_FALSE(finder.find(part_of(song, 5.0, 0.5))) << "too short";
    EXPECT_FALSE(finder.find_near(part_of(song, 5.0, 1.0), 30.0, 0.2));
    EXPECT_FALSE(finder.find_near(part_of(song, 5.0, 1.0), 1e9, 0.2));
    EXPECT_FALSE(finder.find_near(part_of(song, 5.0, 1.0), -5.0, 0.2));
}

TEST(PlaceFinder, tells_repeats_apart_by_what_follows_or_by_a_hint) {
    const Sound loop = noise(4.0, 1);
    const Sound end = noise(4.0, 2);
    Sound song;
    for (const Sound* piece : {&loop, &loop, &loop, &end}) {
        song.insert(song.end(), piece->begin(), piece->end());
    }
    PlaceFinder finder(song);
    EXPECT_FALSE(finder.find(part_of(song, 1.0, 1.0)));
    const auto hinted = finder.find(part_of(song, 4.5, 1.0), 4.0);
    ASSERT_TRUE(hinted);
    EXPECT_NEAR(*hinted, 4.5, 1e-3);
    const auto later = finder.find(part_of(song, 9.0, 6.0));
    ASSERT_TRUE(later);
    EXPECT_NEAR(*later, 9.0, 1e-3);
}

TEST(PlaceFinder, takes_songs_that_are_shorter_than_what_is_heard) {
    const Sound song = noise(2.0, 1);
    PlaceFinder finder(song);
    Sound heard = song;
    heard.resize(static_cast<std::size_t>(10 * PlaceFinder::kRate));
    const auto place = finder.find(heard);
    ASSERT_TRUE(place);
    EXPECT_NEAR(*place, 0.0, 1e-3);
    PlaceFinder none(Sound{});
    EXPECT_FALSE(none.find(heard));
    EXPECT_FALSE(none.find_near(heard, 0.0, 0.2));
}

}  // namespace
}  // namespace raks::audio
