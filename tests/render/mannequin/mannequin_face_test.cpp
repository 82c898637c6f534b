#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "render/mannequin/face_shape.hpp"
#include "render/mannequin/face_sheets.hpp"
#include "render/mannequin/mannequin.hpp"
#include "render/mannequin/painted_mesh.hpp"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace raks::render::test {
namespace {

constexpr std::array kBuilds = {MannequinBuild::follow, MannequinBuild::lead};

const Avatar& built(MannequinBuild build) {
    static const std::array<Avatar, 2> avatars = {build_mannequin({MannequinBuild::follow}),
                                                  build_mannequin({MannequinBuild::lead})};
    return avatars[static_cast<std::size_t>(build)];
}

/// Places of the surface's vertices with one expression at a weight; in the T-pose.
std::vector<glm::vec3> shaped(const Avatar& avatar, FaceExpression expression, float weight) {
    RigState state(*avatar.rig);
    Face face;
    face.weight(expression) = weight;
    avatar.rig->expressions.spread(face, state.weights);
    avatar.rig->expressions.apply(state.weights, state.face);
    std::vector<glm::vec3> places;
    for (const SurfaceVertex& vertex : avatar.surface.vertices) {
        places.emplace_back(vertex.position[0], vertex.position[1], vertex.position[2]);
    }
    for (const SurfaceMorph& morph : avatar.surface.morphs) {
        for (std::size_t i = 0; i < morph.vertices.size(); ++i) {
            places[morph.vertices[i]] += state.face.morphs[morph.weight] * morph.positions[i];
        }
    }
    return places;
}

Paint paint_of(const SurfaceVertex& vertex) {
    return static_cast<Paint>(std::lround(vertex.uv[2]));
}

/// Whether a triangle of skin or lashes lies before a place, seen from the front.
bool is_covered(const Avatar& avatar, const std::vector<glm::vec3>& places, glm::vec3 at) {
    const Surface& surface = avatar.surface;
    for (std::size_t t = 0; t + 2 < surface.indices.size(); t += 3) {
        const std::uint32_t first = surface.indices[t];
        const Paint paint = paint_of(surface.vertices[first]);
        if (paint != Paint::skin && paint != Paint::hair) {
            continue;
        }
        const glm::vec3 a = places[first];
        const glm::vec3 b = places[surface.indices[t + 1]];
        const glm::vec3 c = places[surface.indices[t + 2]];
        const auto across = [&](glm::vec3 p, glm::vec3 q) {
            return (q.x - p.x) * (at.y - p.y) - (q.y - p.y) * (at.x - p.x);
        };
        const glm::vec3 w(across(b, c), across(c, a), across(a, b));
        const float area = w.x + w.y + w.z;
        if (area > 1e-12F && w.x >= 0.0F && w.y >= 0.0F && w.z >= 0.0F &&
            (w.x * a.z + w.y * b.z + w.z * c.z) / area > at.z) {
            return true;
        }
    }
    return false;
}

std::vector<std::size_t> vertices_of(const Avatar& avatar, Paint paint) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < avatar.surface.vertices.size(); ++i) {
        if (paint_of(avatar.surface.vertices[i]) == paint) {
            found.push_back(i);
        }
    }
    return found;
}

float covered_share(const Avatar& avatar, FaceExpression expression, float weight) {
    const std::vector<glm::vec3> places = shaped(avatar, expression, weight);
    const std::vector<std::size_t> irises = vertices_of(avatar, Paint::iris);
    const auto covered = std::count_if(irises.begin(), irises.end(), [&](std::size_t i) {
        return is_covered(avatar, places, places[i]);
    });
    return static_cast<float>(covered) / static_cast<float>(irises.size());
}

TEST(MannequinFace, has_every_standard_expression_and_looks) {
    for (const MannequinBuild build : kBuilds) {
        const AvatarRig& rig = *built(build).rig;
        EXPECT_TRUE(rig.warnings.empty());
        for (const std::string_view name : kFaceExpressionNames) {
            EXPECT_GE(rig.expressions.find(name), 0) << name;
        }
        EXPECT_TRUE(rig.look_at.can_look());
    }
}

TEST(MannequinFace, skin_and_all_that_is_worn_have_at_most_15_thousand_vertices) {
    for (const MannequinBuild build : kBuilds) {
        EXPECT_LE(built(build).vertices.size() + built(build).surface.vertices.size(), 15'000U);
    }
}

TEST(MannequinFace, eyes_are_open_at_rest_and_a_blink_covers_them) {
    for (const MannequinBuild build : kBuilds) {
        EXPECT_LT(covered_share(built(build), FaceExpression::neutral, 1.0F), 0.5F);
        EXPECT_EQ(covered_share(built(build), FaceExpression::blink, 1.0F), 1.0F);
        EXPECT_LT(covered_share(built(build), FaceExpression::surprised, 1.0F),
                  covered_share(built(build), FaceExpression::relaxed, 1.0F));
    }
}

TEST(MannequinFace, one_eye_blinks_alone) {
    const Avatar& avatar = built(MannequinBuild::follow);
    const std::vector<glm::vec3> places = shaped(avatar, FaceExpression::blink_left, 1.0F);
    for (const std::size_t i : vertices_of(avatar, Paint::iris)) {
        if (places[i].x > 0.0F) {
            EXPECT_TRUE(is_covered(avatar, places, places[i]));
        }
    }
    EXPECT_NEAR(covered_share(avatar, FaceExpression::blink_left, 1.0F),
                covered_share(avatar, FaceExpression::blink_right, 1.0F),
                1e-6F);
}

TEST(MannequinFace, expressions_of_both_sides_move_the_face_symmetrically) {
    // Rounded to 1/100 mm: both sides are computed on the left one.
    using Key = std::tuple<long, long, long>;
    const auto key = [](glm::vec3 p) {
        return Key{std::lround(p.x * 1e5F), std::lround(p.y * 1e5F), std::lround(p.z * 1e5F)};
    };
    const Avatar& avatar = built(MannequinBuild::follow);
    for (const FaceExpression expression : {FaceExpression::happy,
                                            FaceExpression::sad,
                                            FaceExpression::aa,
                                            FaceExpression::oh,
                                            FaceExpression::blink,
                                            FaceExpression::look_up}) {
        const std::vector<glm::vec3> rest = shaped(avatar, FaceExpression::neutral, 0.0F);
        const std::vector<glm::vec3> places = shaped(avatar, expression, 1.0F);
        std::multiset<Key> moved;
        std::multiset<Key> mirrored;
        for (std::size_t i = 0; i < places.size(); ++i) {
            // The lights in the eyes lie where the light is, not in a mirror.
            const bool is_glint = avatar.surface.vertices[i].colour[0] == 65'535 &&
                                  paint_of(avatar.surface.vertices[i]) == Paint::white;
            if (places[i] != rest[i] && !is_glint) {
                moved.insert(key(places[i]));
                mirrored.insert(key({-places[i].x, places[i].y, places[i].z}));
            }
        }
        EXPECT_GT(moved.size(), 20U);
        EXPECT_EQ(moved, mirrored) << static_cast<int>(expression);
    }
}

TEST(MannequinFace, the_mouth_opens_and_the_irises_follow_the_gaze) {
    const Avatar& avatar = built(MannequinBuild::follow);
    const auto lowest_lip = [&](FaceExpression expression, float weight) {
        const std::vector<glm::vec3> places = shaped(avatar, expression, weight);
        float low = 9.0F;
        for (const std::size_t i : vertices_of(avatar, Paint::lips)) {
            low = std::min(low, places[i].y);
        }
        return low;
    };
    EXPECT_LT(lowest_lip(FaceExpression::aa, 1.0F), lowest_lip(FaceExpression::aa, 0.0F) - 0.010F);
    const std::vector<glm::vec3> ahead = shaped(avatar, FaceExpression::look_left, 0.0F);
    const std::vector<glm::vec3> left = shaped(avatar, FaceExpression::look_left, 1.0F);
    for (const std::size_t i : vertices_of(avatar, Paint::iris)) {
        EXPECT_GT(left[i].x, ahead[i].x + 0.004F);
    }
}

TEST(MannequinFace, at_rest_it_neither_sulks_nor_frowns) {
    for (const MannequinBuild build : kBuilds) {
        const std::vector<Sheet> sheets = face_sheets({}, build);
        // The inside of the mouth, then the lips; its first row is the upper lip's edge.
        const Sheet& mouth = sheets[sheets.size() - 3];
        const float corner = mouth.points.front().y;
        EXPECT_GT(corner, mouth.points[mouth.columns / 2].y + 0.003F) << "corners are up";
        // Of the left half the brow is the last.
        const Sheet& brow = sheets[7];
        ASSERT_EQ(brow.points.front().paint, Paint::hair);
        const float inner = brow.points[brow.columns].y;
        const float outer = brow.points[2 * brow.columns - 1].y;
        EXPECT_GT(inner, outer - 0.002F) << "inner ends do not hang";
    }
}

TEST(MannequinFace, one_brow_rises_alone) {
    const auto highest = [](const FaceShape& shape, std::size_t sheet) {
        float high = 0.0F;
        const auto sheets = face_sheets(shape, MannequinBuild::follow);
        for (const FacePoint& point : sheets[sheet].points) {
            high = std::max(high, point.y);
        }
        return high;
    };
    const FaceShape left = face_shape(FaceExpression::brow_up_left);
    constexpr std::size_t kLeftBrow = 7;
    constexpr std::size_t kRightBrow = 15;
    EXPECT_GT(highest(left, kLeftBrow), highest({}, kLeftBrow) + 0.004F);
    EXPECT_LE(highest(left, kRightBrow), highest({}, kRightBrow));
}

TEST(MannequinFace, nothing_of_it_lies_under_the_skin_of_the_eyes) {
    // An open eye shows its pupil: nothing painted as skin lies before it.
    for (const MannequinBuild build : kBuilds) {
        const Avatar& avatar = built(build);
        const std::vector<glm::vec3> places = shaped(avatar, FaceExpression::neutral, 0.0F);
        glm::vec3 middle(0.0F);
        float count = 0.0F;
        for (const std::size_t i : vertices_of(avatar, Paint::iris)) {
            if (places[i].x > 0.0F) {
                middle += places[i];
                count += 1.0F;
            }
        }
        EXPECT_FALSE(is_covered(avatar, places, middle / count));
    }
}

TEST(MannequinBuilds, both_are_closed_and_symmetric) {
    for (const MannequinBuild build : kBuilds) {
        const Avatar& avatar = built(build);
        std::map<std::pair<int, int>, int> edges;
        for (std::size_t i = 0; i < avatar.indices.size(); i += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                ++edges[{avatar.indices[i + k], avatar.indices[i + (k + 1) % 3]}];
            }
        }
        for (const auto& [edge, count] : edges) {
            ASSERT_EQ(count, 1);
            ASSERT_EQ(edges.count({edge.second, edge.first}), 1U);
        }
        for (std::size_t i = 0; i < avatar.vertices.size(); i += 2) {
            ASSERT_EQ(avatar.vertices[i].position[0], -avatar.vertices[i + 1].position[0]);
            ASSERT_EQ(avatar.vertices[i].position[1], avatar.vertices[i + 1].position[1]);
        }
    }
}

TEST(MannequinBuilds, have_one_skeleton_but_other_shoulders_hair_and_clothes) {
    const Avatar& follow = built(MannequinBuild::follow);
    const Avatar& lead = built(MannequinBuild::lead);
    EXPECT_EQ(follow.skeleton.offsets, lead.skeleton.offsets);
    const auto width_at = [](const Avatar& avatar, float height) {
        float widest = 0.0F;
        for (const AvatarVertex& vertex : avatar.vertices) {
            if (std::abs(vertex.position[1] - height) < 0.02F && vertex.position[0] < 0.2F) {
                widest = std::max(widest, vertex.position[0]);
            }
        }
        return widest;
    };
    EXPECT_GT(width_at(lead, 1.11F), width_at(follow, 1.11F) + 0.01F);  // waist
    // Tail and skirt swing; the lead has neither.
    EXPECT_GT(follow.rig->springs.size(), 30U);
    EXPECT_EQ(lead.rig->springs.size(), 0U);
    EXPECT_GT(follow.surface.parts.size(), lead.surface.parts.size());
}

}  // namespace
}  // namespace raks::render::test
