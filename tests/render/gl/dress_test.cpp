#include "render/dress.hpp"

#include <array>
#include <cstddef>

#include "render/model/mannequin_style.hpp"
#include "render/model/paint.hpp"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace raks::render::test {
namespace {

TEST(Dress, costumes_take_the_colours_of_one_outfit_differently) {
    const Scene scene;
    const auto paint = [&](Paint which, MannequinStyle style) {
        return dress_colours(scene, 0, style).colours[static_cast<std::size_t>(which)];
    };
    const MannequinStyle plain;
    const MannequinStyle coat{MannequinBuild::lead, Costume::ballroom};
    const MannequinStyle gown{MannequinBuild::follow, Costume::ballroom};
    EXPECT_LT(glm::length(glm::vec3(paint(Paint::suit, coat))), 0.05F) << "black";
    EXPECT_GT(paint(Paint::stripe, coat).g, 0.7F) << "a white shirt";
    EXPECT_EQ(paint(Paint::suit, gown), paint(Paint::suit, plain));
    for (const Costume costume : kCostumes) {
        EXPECT_EQ(paint(Paint::skin, {MannequinBuild::lead, costume}), paint(Paint::skin, plain));
    }
}

}  // namespace
}  // namespace raks::render::test
