#include "engine/live/clip_sound.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace raks::engine {
namespace {

constexpr double kPicture = 1.0 / 60.0;  // seconds

TEST(SoundStep, a_clip_that_is_a_little_off_walks_to_where_the_sound_is_heard) {
    // A loudspeaker whose clock is as far off as any (300 ppm), heard 0.2 s late at first.
    double clip = 0.2;
    double heard = 0.0;
    for (int picture = 0; picture < 60 * 60; ++picture) {
        const SoundStep step = sound_step(clip, heard);
        ASSERT_FALSE(step.seeks);
        EXPECT_GT(kPicture + step.clip_seconds, -kPicture) << "hardly ever backwards";
        clip += kPicture + step.clip_seconds;
        heard += kPicture * 1.0003;
        if (picture > 60) {
            ASSERT_LT(std::abs(clip - heard), 0.005);
        }
    }
}

TEST(SoundStep, over_a_large_distance_the_sound_jumps_and_the_clip_stays) {
    for (const double far : {-5.0, -0.3, 0.3, 100.0}) {
        const SoundStep step = sound_step(10.0, 10.0 + far);
        EXPECT_TRUE(step.seeks) << far;
        EXPECT_EQ(step.clip_seconds, 0.0) << far;
    }
    EXPECT_FALSE(sound_step(10.0, 10.0).seeks);
}

}  // namespace
}  // namespace raks::engine
