#include "motion/dance/dynamics/hits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace raks::motion::hits_test {
namespace {

MusicState accent(double seconds, float strength, MusicAccent::Band band) {
    MusicState music;
    music.time = stream_time_from_seconds(seconds);
    music.accent.strength = strength;
    music.accent.band = band;
    return music;
}

// Radians by which a bone is turned.
double turn_of(const Hits& hits, double seconds, Bone bone) {
    Pose pose;
    hits.apply(stream_time_from_seconds(seconds), pose);
    return 2.0 * std::acos(std::min(1.0, std::abs(static_cast<double>(pose.rotation(bone).w))));
}

TEST(Hits, rise_at_once_and_die_away) {
    Hits hits;
    hits.advance(accent(1.0, 1.0F, MusicAccent::Band::middle), 1.0F);
    EXPECT_EQ(turn_of(hits, 1.0, Bone::chest), 0.0);
    EXPECT_GT(turn_of(hits, 1.07, Bone::chest), 0.07);
    EXPECT_GT(turn_of(hits, 1.07, Bone::chest), turn_of(hits, 1.2, Bone::chest));
    EXPECT_LT(turn_of(hits, 1.59, Bone::chest), 0.001);
    EXPECT_EQ(turn_of(hits, 2.0, Bone::chest), 0.0);
}

TEST(Hits, are_taken_where_their_band_says) {
    Hits low;
    low.advance(accent(0.0, 1.0F, MusicAccent::Band::low), 1.0F);
    EXPECT_GT(turn_of(low, 0.07, Bone::spine), 0.05);
    EXPECT_EQ(turn_of(low, 0.07, Bone::head), 0.0);
    Hits high;
    high.advance(accent(0.0, 1.0F, MusicAccent::Band::high), 1.0F);
    EXPECT_GT(turn_of(high, 0.07, Bone::head), 0.05);
    EXPECT_EQ(turn_of(high, 0.07, Bone::spine), 0.0);
}

TEST(Hits, weak_accents_are_not_answered) {
    Hits hits;
    hits.advance(accent(0.0, 0.4F, MusicAccent::Band::middle), 1.0F);
    EXPECT_EQ(turn_of(hits, 0.07, Bone::chest), 0.0);
}

}  // namespace
}  // namespace raks::motion::hits_test
