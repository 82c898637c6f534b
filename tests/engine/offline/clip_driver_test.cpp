#include "engine/offline/clip_driver.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/engine/installed.hpp"

namespace raks::engine {
namespace {

// The pose of a moment has its seconds as the place of the hips.
motion::Pose pose_of(const MusicState& state) {
    motion::Pose pose;
    pose.hips_position.x = static_cast<float>(to_seconds(state.time));
    return pose;
}

class Hops final : public OfflineDriver::Sink {
 public:
    void on_hop(const PerformedHop& hop) override {
        EXPECT_EQ(hop.tracks.size(), 1U);
        EXPECT_EQ(hop.track.newest_final(), hop.music.hop);
        EXPECT_EQ(hop.music.hop, static_cast<HopIndex>(places.size()));
        EXPECT_FALSE(hop.dancer.is_dancing);
        places.push_back(hop.track.at_hop(hop.music.hop).hips_position.x);
        is_silent = hop.music.is_silent;
    }
    std::vector<float> places;
    bool is_silent = false;
};

TEST(ClipDriver, performs_every_hop_in_silence) {
    ClipDriver driver(pose_of);
    Hops hops;
    driver.perform(stream_time_from_seconds(0.5), hops);
    driver.perform(stream_time_from_seconds(1.0), hops);
    ASSERT_EQ(hops.places.size(), 100U);
    EXPECT_TRUE(hops.is_silent);
    for (std::size_t i = 0; i < hops.places.size(); ++i) {
        EXPECT_FLOAT_EQ(hops.places[i], 0.01F * static_cast<float>(i));
    }
}

TEST(ClipDriver, performs_every_hop_of_the_music) {
    const SampleRate rate(48'000);
    auto driver = ClipDriver::create(rate, installed::models(), pose_of);
    ASSERT_TRUE(driver) << driver.error().message;
    Hops hops;
    const std::vector<float> tenth(4'800, 0.1F);
    for (int i = 0; i < 10; ++i) {
        driver->feed(tenth, hops);
    }
    driver->finish(hops);
    // All of the second, and a few hops of the silence behind it.
    EXPECT_GE(hops.places.size(), 100U);
    EXPECT_LE(hops.places.size(), 106U);
}

}  // namespace
}  // namespace raks::engine
