// Points of a capture on the stage.
#include "render/scene/point_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace raks::render::point_body_test {
namespace {

// A person of 1.8 m of three points, standing on a floor of its own, in millimetres with z up; the
// knee is not seen in the second frame.
motion::PointClip standing() {
    motion::PointClip clip;
    clip.names = {"head", "knee", "foot"};
    clip.frames_per_second = 100.0;
    clip.frame_count = 2;
    const glm::dvec3 unseen(std::numeric_limits<double>::quiet_NaN());
    clip.positions = {{1000.0, 0.0, 2300.0},
                      {1000.0, 50.0, 1000.0},
                      {1000.0, 0.0, 500.0},
                      {1400.0, 0.0, 2300.0},
                      unseen,
                      {1400.0, 0.0, 500.0}};
    return clip;
}

Expected<PointBodies> figures_of(const motion::PointClip& clip,
                                 std::vector<motion::PointEdge> edges = {}) {
    const PointFrame frame = guess_point_frame(clip).frame;
    return PointBodies::create(
        {motion::world_points(clip, frame.metres_per_unit, frame.up, std::move(edges))});
}

struct Span {
    float low = 1e9F;
    float high = -1e9F;
};
Span span_of(const ClipBody& body, int axis) {
    Span span;
    for (const StickVertex& vertex : body.shape.vertices) {
        span.low = std::min(span.low, vertex.position[axis]);
        span.high = std::max(span.high, vertex.position[axis]);
    }
    return span;
}

TEST(PointBodies, what_a_file_does_not_say_is_guessed_from_the_points) {
    motion::PointClip clip = standing();
    const GuessedPointFrame guess = guess_point_frame(clip);
    EXPECT_TRUE(guess.is_unit_guessed && guess.is_up_guessed);
    EXPECT_EQ(guess.frame.metres_per_unit, 0.001);
    EXPECT_EQ(guess.frame.up, glm::dvec3(0.0, 0.0, 1.0));
    clip.metres_per_unit = 0.0254;
    clip.up = glm::dvec3(0.0, 1.0, 0.0);
    const GuessedPointFrame said = guess_point_frame(clip);
    EXPECT_FALSE(said.is_unit_guessed || said.is_up_guessed);
    EXPECT_EQ(said.frame.metres_per_unit, 0.0254);
    EXPECT_EQ(said.frame.up, *clip.up);
}

TEST(PointBodies, stand_upright_on_the_floor_in_the_middle_of_their_way) {
    const motion::PointClip clip = standing();
    const auto bodies = figures_of(clip);
    ASSERT_TRUE(bodies) << bodies.error().message;
    EXPECT_NEAR(bodies->size(), 1.8F / 1.714F, 1e-3F);
    const ClipBody first = bodies->at(0);
    // Points are drawn as spheres of 2.5 cm.
    EXPECT_NEAR(span_of(first, 1).low, 0.0F, 0.03F);
    EXPECT_NEAR(span_of(first, 1).high, 1.8F, 0.03F);
    EXPECT_NEAR(span_of(first, 0).low, -0.2F, 0.03F);
    EXPECT_NEAR(span_of(bodies->at(1), 0).high, 0.2F, 0.03F);
    // One sphere fewer where a point was not seen.
    EXPECT_EQ(3 * bodies->at(1).shape.vertices.size(), 2 * first.shape.vertices.size());
}

TEST(PointBodies, are_joined_where_both_ends_are_seen) {
    const motion::PointClip clip = standing();
    const auto alone = figures_of(clip);
    const auto joined = figures_of(clip, {{0, 1}, {1, 2}});
    ASSERT_TRUE(alone && joined);
    const auto sticks = [&](std::size_t frame) {
        return joined->at(frame).shape.vertices.size() - alone->at(frame).shape.vertices.size();
    };
    EXPECT_GT(sticks(0), 0U);
    EXPECT_EQ(sticks(1), 0U) << "the knee is not seen";
    const std::vector<BodyPoint> points = joined->points(1);
    ASSERT_EQ(points.size(), 3U);
    EXPECT_EQ(points[2].name, "foot");
    EXPECT_TRUE(std::isnan(points[1].place.x));
    EXPECT_NEAR(points[0].place.y, 1.8F, 1e-4F);
}

TEST(PointBodies, two_motions_lie_over_each_other_or_side_by_side) {
    const PointFrame frame = guess_point_frame(standing()).frame;
    const auto two = [&](Arrangement arrangement) {
        const auto points = motion::world_points(standing(), frame.metres_per_unit, frame.up);
        return PointBodies::create({points, points}, arrangement);
    };
    const auto over = two(Arrangement::overlaid);
    const auto beside = two(Arrangement::side_by_side);
    ASSERT_TRUE(over && beside);
    const auto points = over->points(0);
    EXPECT_EQ(points[0].place, points[3].place);
    EXPECT_NE(points[0].part, points[3].part);
    EXPECT_LT(beside->points(0)[0].place.x, beside->points(0)[3].place.x);
}

TEST(PointBodies, of_two_motions_with_very_many_edges_fit_one_mesh) {
    motion::PointClip most;
    most.frame_count = 1;
    most.frames_per_second = 1.0;
    std::vector<motion::PointEdge> edges;
    for (std::size_t i = 0; i < 1000; ++i) {
        most.names.push_back(std::to_string(i));
        most.positions.emplace_back(0.01 * static_cast<double>(i), 0.1, 0.0);
        for (std::size_t k = i + 1; k < std::min<std::size_t>(i + 11, 1000); ++k) {
            edges.push_back({i, k});
        }
    }
    const auto points = motion::world_points(most, 1.0, {0.0, 1.0, 0.0}, edges);
    const auto bodies = PointBodies::create({points, points});
    ASSERT_TRUE(bodies);
    EXPECT_LT(bodies->at(0).shape.vertices.size(), 65'536U);
}

TEST(PointBodies, that_cannot_be_drawn_are_refused) {
    motion::PointClip many = standing();
    many.names.resize(1001);
    many.positions.resize(2002);
    EXPECT_EQ(figures_of(many).error().message, "has 1001 points; at most 1000 can be drawn");
    EXPECT_FALSE(figures_of(motion::PointClip{}));
    motion::PointClip dark = standing();
    dark.positions.assign(6, glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_EQ(figures_of(dark).error().message, "has no frame in which a point is seen");
}

TEST(PointBodies, of_the_most_points_fit_one_mesh) {
    motion::PointClip most;
    most.names.resize(1000);
    most.frame_count = 1;
    for (int i = 0; i < 1000; ++i) {
        most.positions.emplace_back(0.0, 0.002 * i, 0.0);
    }
    const auto bodies = PointBodies::create({motion::world_points(most, 1.0, {0.0, 1.0, 0.0})});
    ASSERT_TRUE(bodies);
    EXPECT_LT(bodies->at(0).shape.vertices.size(), 65'536U);
}

TEST(Enclosing, goes_back_until_all_of_a_figure_is_in_the_picture) {
    motion::PointClip clip = standing();
    // A foot a metre and a half aside, as in a long lunge.
    clip.positions[2].x += 1500.0;
    const auto bodies = figures_of(clip);
    ASSERT_TRUE(bodies);
    const ClipBody body = bodies->at(0);
    const Camera near;
    const Camera far = enclosing(near, 0.75F, body);
    EXPECT_GT(far.distance, near.distance);
    Camera panned = far;
    panned.pan_to(body.landmarks.position(motion::Bone::hips));
    const glm::mat4 clip_from_world = panned.clip_from_world(0.75F);
    for (const StickVertex& vertex : body.shape.vertices) {
        const glm::vec4 at = clip_from_world * glm::vec4(vertex.position, 1.0F);
        EXPECT_LE(std::max(std::abs(at.x), std::abs(at.y)), at.w);
    }
    // A body that lies in the picture already leaves the camera where it is.
    EXPECT_EQ(enclosing(far, 0.75F, body), far);
}

}  // namespace
}  // namespace raks::render::point_body_test
