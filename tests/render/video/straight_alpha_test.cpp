#include "render/video/straight_alpha.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "tests/render/video/film_support.hpp"

namespace raks::render {
namespace {

/// Premultiplied noise of every alpha.
Rgba premultiplied_noise(int width, int height) {
    Rgba rgba(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    const CounterRandom random(7);
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        const auto alpha = static_cast<std::uint8_t>(random.below(i, 256));
        rgba[i + 3] = alpha;
        for (std::size_t c = 0; c < 3; ++c) {
            rgba[i + c] = static_cast<std::uint8_t>(random.below(i + 1 + c, alpha + 1U));
        }
    }
    return rgba;
}

/// A straight colour over a ground, as an editor lays it.
int over(int colour, int alpha, int ground) {
    return (colour * alpha + ground * (255 - alpha) + 127) / 255;
}

void expect_same_over_all_grounds(const Rgba& drawn, const Rgba& straight, int tolerance) {
    for (std::size_t i = 0; i < drawn.size(); i += 4) {
        const int alpha = drawn[i + 3];
        ASSERT_EQ(straight[i + 3], alpha);
        for (const int ground : {0, 128, 255}) {
            for (std::size_t c = i; c < i + 3; ++c) {
                const int wanted = drawn[c] + (ground * (255 - alpha) + 127) / 255;
                ASSERT_LE(std::abs(over(straight[c], alpha, ground) - wanted), tolerance)
                    << "byte " << c << " alpha " << alpha << " ground " << ground;
            }
        }
    }
}

TEST(StraightAlpha, lies_over_any_ground_as_the_premultiplied_picture_does) {
    const Rgba drawn = premultiplied_noise(61, 37);
    Rgba straight = drawn;
    make_straight(straight);
    expect_same_over_all_grounds(drawn, straight, 1);
}

TEST(StraightAlpha, what_is_not_there_is_black_and_what_is_opaque_unchanged) {
    Rgba rgba = {9, 9, 9, 0, 10, 20, 30, 255, 10, 20, 30, 128};
    make_straight(rgba);
    EXPECT_EQ(rgba, (Rgba{0, 0, 0, 0, 10, 20, 30, 255, 20, 40, 60, 128}));
}

// Colours of what is covered by less than an eighth come from around it, so that they may be off by
// the alpha's own share.
TEST(EdgeColours, lie_over_any_ground_as_the_premultiplied_picture_does) {
    const Rgba drawn = premultiplied_noise(61, 37);
    Rgba straight = drawn;
    EdgeColours(61, 37).make_straight(straight);
    expect_same_over_all_grounds(drawn, straight, 32);
}

TEST(EdgeColours, give_the_surroundings_of_a_body_its_colour) {
    constexpr int kSide = 50;
    Rgba rgba(static_cast<std::size_t>(kSide) * kSide * 4, 0);
    const std::size_t body = (20 * kSide + 31) * 4;
    const std::array<std::uint8_t, 4> red = {200, 0, 0, 255};
    std::copy(red.begin(), red.end(), rgba.begin() + body);
    EdgeColours edges(kSide, kSide);
    edges.make_straight(rgba);
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        ASSERT_EQ(rgba[i], 200) << i;
        ASSERT_EQ(rgba[i + 1], 0) << i;
        ASSERT_EQ(rgba[i + 3], i == body ? 255 : 0) << i;
    }
    Rgba empty(rgba.size(), 0);
    edges.make_straight(empty);
    EXPECT_EQ(empty, Rgba(rgba.size(), 0)) << "the picture before has left something behind";
}

}  // namespace
}  // namespace raks::render
