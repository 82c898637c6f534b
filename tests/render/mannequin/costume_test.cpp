// What the mannequin wears: every costume of both builds.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "render/mannequin/mannequin.hpp"
#include "render/mannequin/painted_mesh.hpp"

#include <gtest/gtest.h>

namespace raks::render::test {
namespace {

constexpr std::array kBothBuilds = {MannequinBuild::follow, MannequinBuild::lead};

const Avatar& wearing(MannequinBuild build, Costume costume) {
    static std::map<std::pair<MannequinBuild, Costume>, Avatar> built;
    const auto [place, is_new] = built.try_emplace(std::pair(build, costume));
    if (is_new) {
        place->second = build_mannequin({build, costume});
    }
    return place->second;
}

float mask_of(const AvatarVertex& vertex, AvatarMask mask) {
    return static_cast<float>(vertex.masks[static_cast<std::size_t>(mask)]) / 127.0F;
}

/// Share of the trunk's skin between two heights that is under the suit.
float covered(const Avatar& avatar, float from, float to) {
    int all = 0;
    int in_suit = 0;
    for (const AvatarVertex& vertex : avatar.vertices) {
        const bool is_trunk = std::abs(vertex.position[0]) < 0.11F;
        if (is_trunk && vertex.position[1] > from && vertex.position[1] < to) {
            ++all;
            in_suit += mask_of(vertex, AvatarMask::suit) > 0.0F ? 1 : 0;
        }
    }
    return static_cast<float>(in_suit) / static_cast<float>(std::max(all, 1));
}

/// The lowest place of the cloth that hangs, in the T-pose; the mannequin's height where none does.
float hem_of(const Avatar& avatar) {
    float lowest = kMannequinHeight;
    for (const SurfaceVertex& vertex : avatar.surface.vertices) {
        const auto paint = static_cast<Paint>(std::lround(vertex.uv[2]));
        if (vertex.position[1] < 1.1F && (paint == Paint::suit || paint == Paint::trim)) {
            lowest = std::min(lowest, vertex.position[1]);
        }
    }
    return lowest;
}

TEST(Costumes, have_names_that_find_them) {
    for (const Costume costume : kCostumes) {
        EXPECT_EQ(find_costume(name_of(costume)), costume);
    }
    EXPECT_FALSE(find_costume("pyjamas"));
    EXPECT_FALSE(find_costume(""));
}

TEST(Costumes, are_closed_skins_within_the_budget_on_the_same_skeleton) {
    const Avatar& plain = wearing(MannequinBuild::follow, Costume::unitard);
    for (const Costume costume : kCostumes) {
        for (const MannequinBuild build : kBothBuilds) {
            const Avatar& avatar = wearing(build, costume);
            EXPECT_EQ(avatar.skeleton.offsets, plain.skeleton.offsets) << name_of(costume);
            EXPECT_LT(avatar.vertices.size() + avatar.surface.vertices.size(), 16'500U)
                << name_of(costume);
            std::map<std::pair<int, int>, int> edges;
            for (std::size_t i = 0; i < avatar.indices.size(); i += 3) {
                for (std::size_t k = 0; k < 3; ++k) {
                    ++edges[{avatar.indices[i + k], avatar.indices[i + (k + 1) % 3]}];
                }
            }
            for (const auto& [edge, count] : edges) {
                ASSERT_EQ(count, 1) << name_of(costume);
                ASSERT_EQ(edges.count({edge.second, edge.first}), 1U)
                    << name_of(costume) << " at "
                    << avatar.vertices[static_cast<std::size_t>(edge.first)].position[0] << ' '
                    << avatar.vertices[static_cast<std::size_t>(edge.first)].position[1] << ' '
                    << avatar.vertices[static_cast<std::size_t>(edge.first)].position[2];
            }
        }
    }
}

// Legs and soles are where those of the unitard are: what dances were solved for.
TEST(Costumes, stand_on_the_same_floor) {
    const auto lowest = [](const Avatar& avatar) {
        const auto by_height = [](const AvatarVertex& a, const AvatarVertex& b) {
            return a.position[1] < b.position[1];
        };
        return std::min_element(avatar.vertices.begin(), avatar.vertices.end(), by_height)
            ->position[1];
    };
    for (const Costume costume : kCostumes) {
        for (const MannequinBuild build : kBothBuilds) {
            EXPECT_NEAR(lowest(wearing(build, costume)),
                        lowest(wearing(MannequinBuild::follow, Costume::unitard)),
                        0.004F)
                << name_of(costume);
        }
    }
}

TEST(Costumes, the_oriental_bares_the_midriff_and_no_other_does) {
    for (const Costume costume : kCostumes) {
        for (const MannequinBuild build : kBothBuilds) {
            const float midriff = covered(wearing(build, costume), 1.00F, 1.14F);
            EXPECT_EQ(midriff, costume == Costume::oriental ? 0.0F : 1.0F) << name_of(costume);
            EXPECT_GT(covered(wearing(build, costume), 1.20F, 1.30F), 0.99F) << name_of(costume);
        }
    }
}

TEST(Costumes, the_street_wears_wide_cloth_and_nothing_that_swings_from_the_hips) {
    const auto knee_width = [](const Avatar& avatar) {
        float widest = 0.0F;
        float nearest = 1.0F;
        for (const AvatarVertex& vertex : avatar.vertices) {
            if (vertex.position[0] > 0.0F && std::abs(vertex.position[1] - 0.45F) < 0.02F) {
                widest = std::max(widest, vertex.position[0]);
                nearest = std::min(nearest, vertex.position[0]);
            }
        }
        return widest - nearest;
    };
    const Avatar& street = wearing(MannequinBuild::follow, Costume::street);
    const Avatar& plain = wearing(MannequinBuild::follow, Costume::unitard);
    EXPECT_GT(knee_width(street), knee_width(plain) + 0.03F);
    EXPECT_EQ(hem_of(street), kMannequinHeight);
    // Hair alone.
    EXPECT_LT(street.rig->springs.size(), 10U);
}

TEST(Costumes, the_gown_reaches_the_ankle_and_the_coat_has_tails) {
    EXPECT_LT(hem_of(wearing(MannequinBuild::follow, Costume::ballroom)), 0.13F);
    const Avatar& coat = wearing(MannequinBuild::lead, Costume::ballroom);
    EXPECT_NEAR(hem_of(coat), 0.52F, 0.03F);
    for (const SurfaceVertex& vertex : coat.surface.vertices) {
        const auto paint = static_cast<Paint>(std::lround(vertex.uv[2]));
        if (vertex.position[1] < 0.9F && paint == Paint::suit) {
            EXPECT_LT(vertex.position[2], 0.07F) << "tails hang behind and beside";
        }
    }
}

}  // namespace
}  // namespace raks::render::test
