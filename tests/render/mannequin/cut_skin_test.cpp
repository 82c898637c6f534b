#include "render/mannequin/cut_skin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "render/mannequin/mannequin.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

const Avatar& mannequin() {
    static const Avatar built = build_mannequin();
    return built;
}

const CutSkin& cut() {
    static const CutSkin skin = cut_skin(mannequin());
    return skin;
}

TEST(CutSkin, stays_closed_each_side_of_a_triangle_has_one_neighbour) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (std::size_t i = 0; i < cut().indices.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++sides[{cut().indices[i + k], cut().indices[i + (k + 1) % 3]}];
        }
    }
    for (const auto& [side, count] : sides) {
        ASSERT_EQ(count, 1);
        ASSERT_TRUE(sides.count({side.second, side.first}) == 1);
    }
}

TEST(CutSkin, keeps_its_surface_and_the_sum_of_its_weights) {
    const auto area = [](const auto& place, const auto& indices) {
        double sum = 0.0;
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            const glm::vec3 a = place(indices[i]);
            sum += 0.5 * static_cast<double>(glm::length(
                             glm::cross(place(indices[i + 1]) - a, place(indices[i + 2]) - a)));
        }
        return sum;
    };
    const auto own = [](std::size_t i) {
        const auto& p = mannequin().vertices[i].position;
        return glm::vec3(p[0], p[1], p[2]);
    };
    const auto after = [](std::size_t i) { return cut().points[i].position; };
    EXPECT_NEAR(area(after, cut().indices), area(own, mannequin().indices), 1e-5);
    for (const SkinPoint& point : cut().points) {
        float sum = 0.0F;
        for (const float share : point.shares) {
            sum += share;
        }
        ASSERT_NEAR(sum, 1.0F, 1e-5F);
    }
}

TEST(CutSkin, has_every_colour_of_the_body_and_no_triangle_across_the_hem_of_the_suit) {
    const std::set<Paint> paints(cut().paints.begin(), cut().paints.end());
    EXPECT_EQ(paints.size(), 7U);
    for (std::size_t t = 0; t < cut().paints.size(); ++t) {
        float least = 1.0F;
        float most = -1.0F;
        for (std::size_t k = 0; k < 3; ++k) {
            const float suit = cut().points[cut().indices[3 * t + k]].masks[0];
            least = std::min(least, suit);
            most = std::max(most, suit);
        }
        // A point as near as 0.03 counts as on the edge.
        ASSERT_FALSE(least < 0.10F && most > 0.18F);
        ASSERT_FALSE(least < -0.18F && most > -0.10F);
    }
}

}  // namespace
}  // namespace raks::render
