// The background of pictures whose move is known: a painted wall, with somebody before it.
#include "motion/capture/pictures/background.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/dice.hpp"
#include "base/random.hpp"

#include <glm/common.hpp>

namespace raks::capture {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 360;

/// What a camera sees.
struct Sight {
    glm::dvec2 move{};
    double size = 1.0;
    double light = 1.0;
    double dancer_x = 320.0;  ///< of somebody with a bright pattern; pixels
};

// A number of a point of a grid, [-1, 1].
double number_at(long x, long y, std::uint64_t layer) {
    return CounterRandom(layer, static_cast<std::uint64_t>(x + 10'000))
                   .uniform(static_cast<std::uint64_t>(y + 10'000)) *
               2.0 -
           1.0;
}

// Numbers of a grid of `side` pixels, joined smoothly.
double layer_at(const glm::dvec2& at, double side, std::uint64_t layer) {
    const glm::dvec2 cell = at / side;
    const auto x = static_cast<long>(std::floor(cell.x));
    const auto y = static_cast<long>(std::floor(cell.y));
    const glm::dvec2 share = glm::smoothstep(0.0, 1.0, glm::fract(cell));
    const double above = glm::mix(number_at(x, y, layer), number_at(x + 1, y, layer), share.x);
    const double below =
        glm::mix(number_at(x, y + 1, layer), number_at(x + 1, y + 1, layer), share.x);
    return glm::mix(above, below, share.y);
}

// A wall of patches of three sizes.
double wall_at(const glm::dvec2& at) {
    return 128.0 + 40.0 * layer_at(at, 41.0, 1) + 30.0 * layer_at(at, 17.0, 2) +
           20.0 * layer_at(at, 9.0, 3);
}

std::vector<std::uint8_t> picture_of(const Sight& sight, std::uint64_t seed) {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(std::size_t{3} * kWidth * kHeight);
    Dice dice(seed, 1);
    const glm::dvec2 centre(0.5 * (kWidth - 1), 0.5 * (kHeight - 1));
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const glm::dvec2 pixel(x, y);
            const bool is_dancer = std::abs(x - sight.dancer_x) < 60.0 && y > 60;
            const double value =
                is_dancer
                    ? 120.0 + 80.0 * std::sin(0.2 * (x - sight.dancer_x)) * std::sin(0.17 * y)
                    : sight.light * wall_at(centre + (pixel - centre - sight.move) / sight.size);
            const double noisy = std::clamp(value + dice.uniform(-3.0, 3.0), 0.0, 255.0);
            rgb.insert(rgb.end(), 3, static_cast<std::uint8_t>(std::lround(noisy)));
        }
    }
    return rgb;
}

std::optional<BackgroundPlace> look(BackgroundFollower& follower,
                                    const Sight& sight,
                                    std::uint64_t seed) {
    const std::vector<std::uint8_t> rgb = picture_of(sight, seed);
    return follower.look({kWidth, kHeight, rgb},
                         PictureBounds{{sight.dancer_x - 60.0, 60.0},
                                       {sight.dancer_x + 60.0, static_cast<double>(kHeight)}});
}

TEST(Background, is_found_where_it_was_moved_to_behind_whoever_dances) {
    BackgroundFollower follower;
    ASSERT_TRUE(look(follower, {}, 1));
    const std::vector<Sight> sights = {{{}, 1.0, 1.0, 200.0},
                                       {{3.0, -2.0}, 1.0, 1.0, 420.0},
                                       {{-17.0, 9.0}, 1.0, 0.8, 300.0},
                                       {{10.0, 4.0}, 1.05, 1.0, 250.0},
                                       {{0.0, 0.0}, 1.0, 1.2, 320.0}};
    for (std::size_t i = 0; i < sights.size(); ++i) {
        const auto place = look(follower, sights[i], i + 2);
        ASSERT_TRUE(place) << i;
        EXPECT_NEAR(place->move.x, sights[i].move.x, 0.25) << i;
        EXPECT_NEAR(place->move.y, sights[i].move.y, 0.25) << i;
        EXPECT_NEAR(place->size, sights[i].size, 0.003) << i;
    }
}

TEST(Background, of_a_bare_wall_tells_nothing) {
    BackgroundFollower follower;
    const std::vector<std::uint8_t> rgb(std::size_t{3} * kWidth * kHeight, 140);
    EXPECT_FALSE(follower.look({kWidth, kHeight, rgb}, std::nullopt));
    // As soon as there is something it is followed.
    EXPECT_TRUE(look(follower, {}, 1));
}

TEST(Background, that_is_another_one_is_not_found) {
    BackgroundFollower follower;
    ASSERT_TRUE(look(follower, {}, 1));
    EXPECT_FALSE(look(follower, {{400.0, 300.0}, 1.0, 1.0, 320.0}, 2));
}

TEST(Background, of_tiny_pictures_tells_nothing) {
    for (const int side : {1, 2, 7, 19}) {
        BackgroundFollower follower;
        const std::vector<std::uint8_t> rgb(
            std::size_t{3} * static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 9);
        EXPECT_FALSE(follower.look({side, side, rgb}, std::nullopt)) << side;
    }
}

}  // namespace
}  // namespace raks::capture
