#include "audio/io/downmix.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace raks::audio {
namespace {

TEST(Downmix, mono_is_doubled_and_stereo_kept) {
    std::vector<float> out(4);
    downmix_to_stereo(std::vector<float>{0.1F, -0.2F}, 1, out);
    EXPECT_EQ(out, (std::vector<float>{0.1F, 0.1F, -0.2F, -0.2F}));
    const std::vector<float> stereo{0.1F, 0.2F, 0.3F, 0.4F};
    downmix_to_stereo(stereo, 2, out);
    EXPECT_EQ(out, stereo);
}

TEST(Downmix, equal_full_scale_channels_stay_within_full_scale) {
    for (std::size_t channels = 1; channels <= 64; ++channels) {
        const std::vector<float> in(channels, 1.0F);
        std::vector<float> out(2);
        downmix_to_stereo(in, channels, out);
        EXPECT_NEAR(out[0], 1.0F, 1e-5F) << channels;
        EXPECT_NEAR(out[1], 1.0F, 1e-5F) << channels;
        std::vector<float> mono(1);
        downmix_to_mono(in, channels, mono);
        EXPECT_NEAR(mono[0], 1.0F, 1e-5F) << channels;
    }
}

TEST(Downmix, each_channel_goes_to_its_side) {
    // left, right, centre, low, back left, back right
    const std::vector<bool> to_left{true, false, true, false, true, false};
    const std::vector<bool> to_right{false, true, true, false, false, true};
    for (std::size_t i = 0; i < 6; ++i) {
        std::vector<float> in(6, 0.0F);
        in[i] = 1.0F;
        std::vector<float> out(2);
        downmix_to_stereo(in, 6, out);
        EXPECT_EQ(out[0] > 0.0F, to_left[i]) << i;
        EXPECT_EQ(out[1] > 0.0F, to_right[i]) << i;
    }
}

TEST(Downmix, swapping_the_sides_swaps_the_result) {
    const std::vector<float> in{0.3F, -0.7F, 0.2F, 0.9F, 0.1F, 0.5F, -0.4F, 0.6F};
    const std::vector<float> swapped{-0.7F, 0.3F, 0.2F, 0.9F, 0.5F, 0.1F, 0.6F, -0.4F};
    std::vector<float> a(2);
    std::vector<float> b(2);
    downmix_to_stereo(in, 8, a);
    downmix_to_stereo(swapped, 8, b);
    EXPECT_EQ(a[0], b[1]);
    EXPECT_EQ(a[1], b[0]);
}

TEST(Downmix, a_channel_that_is_left_out_brings_no_nan) {
    std::vector<float> in(6, 0.5F);
    in[3] = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> out(2);
    downmix_to_stereo(in, 6, out);
    EXPECT_FALSE(std::isnan(out[0]));
}

}  // namespace
}  // namespace raks::audio
