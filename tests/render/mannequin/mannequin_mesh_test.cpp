#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <utility>

#include "render/mannequin/mannequin.hpp"
#include "tests/render/avatar/posed_mesh.hpp"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace raks::render::test {
namespace {

using DirectedEdge = std::pair<std::size_t, std::size_t>;

std::map<DirectedEdge, int> directed_edges() {
    std::map<DirectedEdge, int> edges;
    for (std::size_t t = 0; t < triangle_count(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++edges[{corner(t, k), corner(t, (k + 1) % 3)}];
        }
    }
    return edges;
}

TEST(MannequinMesh, has_10_to_15_thousand_vertices_for_16_bit_indices) {
    EXPECT_GE(mannequin().vertices.size(), 10'000U);
    EXPECT_LE(mannequin().vertices.size(), 15'000U);
    EXPECT_EQ(mannequin().indices.size() % 3, 0U);
    for (const std::uint16_t index : mannequin().indices) {
        ASSERT_LT(index, mannequin().vertices.size());
    }
}

TEST(MannequinMesh, is_closed_and_every_edge_has_one_triangle_on_each_side) {
    const auto edges = directed_edges();
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1) << edge.first << " -> " << edge.second;
        ASSERT_EQ(edges.count({edge.second, edge.first}), 1U)
            << edge.first << " -> " << edge.second;
    }
}

TEST(MannequinMesh, is_one_piece_without_holes_through_it) {
    // Euler: vertices - edges + triangles = 2 for one closed surface like a ball.
    const auto edges = static_cast<std::ptrdiff_t>(directed_edges().size() / 2);
    const auto vertices = static_cast<std::ptrdiff_t>(mannequin().vertices.size());
    const auto triangles = static_cast<std::ptrdiff_t>(triangle_count());
    EXPECT_EQ(vertices - edges + triangles, 2);
}

TEST(MannequinMesh, around_each_vertex_the_triangles_make_one_fan) {
    std::vector<std::map<std::size_t, std::size_t>> next(mannequin().vertices.size());
    for (std::size_t t = 0; t < triangle_count(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            next[corner(t, k)][corner(t, (k + 1) % 3)] = corner(t, (k + 2) % 3);
        }
    }
    for (std::size_t v = 0; v < next.size(); ++v) {
        ASSERT_GE(next[v].size(), 3U) << v;
        const std::size_t first = next[v].begin()->first;
        std::size_t steps = 0;
        std::size_t at = first;
        do {
            at = next[v].at(at);
            ++steps;
        } while (at != first && steps <= next[v].size());
        ASSERT_EQ(steps, next[v].size()) << "vertex " << v;
    }
}

TEST(MannequinMesh, is_exactly_mirror_symmetric_in_pairs) {
    const auto& vertices = mannequin().vertices;
    ASSERT_EQ(vertices.size() % 2, 0U);
    for (std::size_t i = 0; i < vertices.size(); i += 2) {
        const AvatarVertex& left = vertices[i];
        const AvatarVertex& right = vertices[i + 1];
        ASSERT_GT(left.position[0], 0.0F);
        ASSERT_EQ(left.position[0], -right.position[0]);
        ASSERT_EQ(left.position[1], right.position[1]);
        ASSERT_EQ(left.position[2], right.position[2]);
        ASSERT_EQ(left.normal[0], -right.normal[0]);
        ASSERT_EQ(left.normal[1], right.normal[1]);
        ASSERT_EQ(left.weights, right.weights);
        ASSERT_EQ(left.masks, right.masks);
        ASSERT_EQ(left.ambient_occlusion, right.ambient_occlusion);
    }
}

TEST(MannequinMesh, no_triangle_is_degenerate_or_turned_inside_out_in_bind) {
    for (std::size_t t = 0; t < triangle_count(); ++t) {
        const glm::vec3 a = bind_position(corner(t, 0));
        const glm::vec3 b = bind_position(corner(t, 1));
        const glm::vec3 c = bind_position(corner(t, 2));
        const glm::vec3 across = glm::cross(b - a, c - a);
        ASSERT_GT(glm::length(across), 1e-7F) << "triangle " << t;
        const glm::vec3 normal =
            bind_normal(corner(t, 0)) + bind_normal(corner(t, 1)) + bind_normal(corner(t, 2));
        ASSERT_GT(glm::dot(across, normal), 0.0F)
            << "triangle " << t << " at " << a.x << ' ' << a.y << ' ' << a.z;
    }
}

TEST(MannequinMesh, normals_are_unit) {
    for (std::size_t i = 0; i < mannequin().vertices.size(); ++i) {
        // 16 bits: one step is 3e-5.
        ASSERT_NEAR(glm::length(bind_normal(i)), 1.0F, 1e-4F);
        ASSERT_EQ(mannequin().vertices[i].normal[3], 0);
    }
}

TEST(MannequinMesh, has_the_size_of_a_dancer_of_171_cm_and_53_litres) {
    std::vector<glm::vec3> positions;
    float low = 9.0F;
    float high = -9.0F;
    for (std::size_t i = 0; i < mannequin().vertices.size(); ++i) {
        positions.push_back(bind_position(i));
        low = std::min(low, positions.back().y);
        high = std::max(high, positions.back().y);
    }
    EXPECT_NEAR(volume_of(positions), 0.0529, 0.0015);  // a density of 1.0 gives 53 kg
    EXPECT_NEAR(high - low, 1.71F, 0.02F);
}

TEST(MannequinMesh, is_the_same_bytes_when_built_again) {
    const Avatar again = build_mannequin();
    ASSERT_EQ(again.vertices.size(), mannequin().vertices.size());
    EXPECT_EQ(std::memcmp(again.vertices.data(),
                          mannequin().vertices.data(),
                          again.vertices.size() * sizeof(AvatarVertex)),
              0);
    EXPECT_EQ(again.indices, mannequin().indices);
}

TEST(MannequinMesh, every_colour_area_covers_a_sensible_part_of_the_skin) {
    // Share of the vertices inside; fingers and head are meshed finer than the rest.
    constexpr std::array<std::pair<float, float>, kMaskCount> kShares = {{
        {0.15F, 0.50F},  // suit
        {0.05F, 0.95F},  // stripe: the half in front of its middle line
        {0.20F, 0.95F},  // outer
        {0.03F, 0.15F},  // hair
        {0.02F, 0.15F},  // shoe
        {0.01F, 0.12F},  // accent
        {0.02F, 0.20F},  // band
    }};
    for (std::size_t m = 0; m < kShares.size(); ++m) {
        std::size_t inside = 0;
        for (const AvatarVertex& vertex : mannequin().vertices) {
            inside += vertex.masks[m] > 0 ? 1U : 0U;
        }
        const float share =
            static_cast<float>(inside) / static_cast<float>(mannequin().vertices.size());
        EXPECT_GE(share, kShares[m].first) << kMaskNames[m];
        EXPECT_LE(share, kShares[m].second) << kMaskNames[m];
    }
}

TEST(MannequinMesh, is_darker_in_the_armpit_than_on_the_forehead) {
    const auto openness_near = [](glm::vec3 place) {
        std::size_t best = 0;
        for (std::size_t i = 1; i < mannequin().vertices.size(); ++i) {
            if (glm::length(bind_position(i) - place) < glm::length(bind_position(best) - place)) {
                best = i;
            }
        }
        return int{mannequin().vertices[best].ambient_occlusion};
    };
    EXPECT_GT(openness_near({0.0F, 1.64F, 0.09F}), openness_near({0.145F, 1.27F, -0.02F}) + 40);
}

}  // namespace
}  // namespace raks::render::test
