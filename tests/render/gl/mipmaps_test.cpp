#include "render/gl/mipmaps.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace raks::render::gl {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(Mipmaps, halve_down_to_one_pixel) {
    const Bytes picture(7U * 4U * 4U, 9);
    const auto levels = mipmaps(7, 4, picture, MipColours::as_they_are);
    ASSERT_EQ(levels.size(), 2U);
    EXPECT_EQ(levels[0].width, 3);
    EXPECT_EQ(levels[0].height, 2);
    EXPECT_EQ(levels[1].width, 1);
    EXPECT_EQ(levels[1].height, 1);
    for (const MipLevel& level : levels) {
        EXPECT_EQ(level.rgba, Bytes(level.rgba.size(), 9));
    }
    EXPECT_TRUE(mipmaps(1, 1, Bytes(4, 9), MipColours::linear).empty());
    EXPECT_EQ(mipmaps(1, 8, Bytes(32, 9), MipColours::linear).size(), 3U);
}

TEST(Mipmaps, a_pixel_is_the_mean_of_four) {
    const Bytes picture = {0, 10, 255, 0, 1, 20, 255, 100, 2, 30, 0, 200, 3, 40, 0, 255};
    const auto levels = mipmaps(2, 2, picture, MipColours::as_they_are);
    ASSERT_EQ(levels.size(), 1U);
    EXPECT_EQ(levels[0].rgba, (Bytes{2, 25, 128, 139}));
}

TEST(Mipmaps, light_is_averaged_and_not_shown_numbers) {
    const Bytes picture = {0, 0, 0, 0, 255, 255, 255, 255};
    const auto levels = mipmaps(2, 1, picture, MipColours::linear);
    ASSERT_EQ(levels.size(), 1U);
    // Half of the light is sRGB 188; opacity is a number.
    EXPECT_NEAR(levels[0].rgba[0], 188, 1);
    EXPECT_EQ(levels[0].rgba[3], 128);
}

}  // namespace
}  // namespace raks::render::gl
