// Costs of postures against the sums that their definitions are.
#include "motion/capture/angles/posture_weigher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/dice.hpp"
#include "tests/motion/capture/angles/angle_scene.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr std::size_t kPostures = 16;
constexpr double kBound = 12.0;

/// Changes of all variables, drawn.
PostureChanges drawn_changes(const BodyModel& model, double deviation) {
    Dice dice(5, 1);
    PostureChanges changes(model.variables(), kPostures);
    for (float& value : changes.values) {
        value = static_cast<float>(dice.normal(deviation));
    }
    return changes;
}

BodyState changed(const BodyModel& model,
                  const BodyState& state,
                  const PostureChanges& changes,
                  std::size_t posture) {
    std::vector<double> change;
    for (std::size_t i = 0; i < model.variables(); ++i) {
        change.push_back(static_cast<double>(changes.of(i)[posture]));
    }
    return model.moved(state, change.data());
}

double beyond_limits(const BodyModel& model, const BodyState& state) {
    double cost = 0.0;
    for (std::size_t i = 0; i < model.joints().size(); ++i) {
        const TurningJoint& joint = model.joints()[i];
        const double angle =
            joint.is_hinge ? state.angles[i] : glm::length(model.turn_of(state, i));
        const double beyond =
            std::max({0.0, angle - joint.highest, joint.is_hinge ? joint.lowest - angle : 0.0});
        cost += 50.0 * beyond * beyond;
    }
    return cost;
}

glm::dvec2 pixel_in(const Camera& camera, const glm::dvec3& place) {
    const glm::dvec3 at = camera.in_camera(place);
    return {kFocalLength * at.x / at.z, kFocalLength * at.y / at.z};
}

/// Distance of a pixel from the epipolar line of another camera's pixel.
double line_distance(const Camera& from,
                     const glm::dvec2& a,
                     const Camera& to,
                     const glm::dvec2& b) {
    return epipolar_distance(from, a / kFocalLength, to, b / kFocalLength) * kFocalLength /
           (0.5 * (to.lens.fx + to.lens.fy));
}

/// The nearest spot of a marker in a picture.
std::optional<glm::dvec2> nearest_spot(const FrameMarks& marks,
                                       std::size_t marker,
                                       std::size_t picture,
                                       const glm::dvec2& pixel) {
    std::optional<glm::dvec2> nearest;
    const MarkRange range = marks.of(marker, picture);
    for (std::size_t k = range.first; k < range.first + range.count; ++k) {
        const glm::dvec2 place = marks.marks()[k].place;
        if (!nearest || glm::distance(place, pixel) < glm::distance(*nearest, pixel)) {
            nearest = place;
        }
    }
    return nearest;
}

double epipolar_energy(const raks::test::SeenPosture& seen,
                       const FrameMarks& marks,
                       const BodyState& at) {
    const auto places = marker_places_of(seen.context(), at);
    double energy = 0.0;
    for (std::size_t marker = 0; marker < places.size(); ++marker) {
        for (std::size_t i = 0; i < marks.pictures().size(); ++i) {
            const Camera& one = seen.rig.cameras[marks.pictures()[i].camera];
            const auto spot = nearest_spot(marks, marker, i, pixel_in(one, places[marker]));
            if (!spot) {
                energy += 1.0;
                continue;
            }
            double sum = 0.0;
            double count = 0.0;
            for (std::size_t j = 0; j < marks.pictures().size(); ++j) {
                const Camera& other = seen.rig.cameras[marks.pictures()[j].camera];
                const glm::dvec2 pixel = pixel_in(other, places[marker]);
                if (i == j || glm::distance(pixel, pixel_in(other, one.centre())) < 30.0) {
                    continue;
                }
                const double there = line_distance(one, *spot, other, pixel);
                const double here = line_distance(other, pixel, one, *spot);
                const double square = there * there + here * here;
                sum += square / (square + kBound * kBound);
                count += 1.0;
            }
            energy += sum / std::max(1e-6, count);
        }
    }
    return energy;
}

TEST(PostureWeigher, costs_what_the_distances_to_the_nearest_spots_say) {
    const raks::test::SeenPosture seen;
    const FrameMarks marks = seen.marks();
    const BodyLinks links = links_of(seen.model, seen.shape, seen.bones);
    const BodyDivision division = divide(seen.model, links, seen.bones);
    const PostureWeigher weigher(
        seen.model, links, marks, seen.state, Likelihood::reprojection, kBound);
    const PostureChanges changes = drawn_changes(seen.model, 0.08);
    std::array<float, kPostures> costs{};
    weigher.weigh(division.whole, changes, 0, costs.data());
    weigher.weigh(division.whole, changes, 8, costs.data() + 8);
    for (std::size_t i = 0; i < kPostures; ++i) {
        const BodyState state = changed(seen.model, seen.state, changes, i);
        const double expected =
            reprojection_energy(marker_places_of(seen.context(), state), marks, kBound) +
            beyond_limits(seen.model, state);
        EXPECT_NEAR(static_cast<double>(costs[i]), expected, 2e-3 * expected) << i;
    }
}

TEST(PostureWeigher, costs_what_the_epipolar_lines_say) {
    const raks::test::SeenPosture seen;
    const FrameMarks marks = seen.marks();
    const BodyLinks links = links_of(seen.model, seen.shape, seen.bones);
    const BodyDivision division = divide(seen.model, links, seen.bones);
    const PostureWeigher weigher(
        seen.model, links, marks, seen.state, Likelihood::epipolar, kBound);
    const PostureChanges changes = drawn_changes(seen.model, 0.03);
    std::array<float, kPostures> costs{};
    weigher.weigh(division.whole, changes, 0, costs.data());
    weigher.weigh(division.whole, changes, 8, costs.data() + 8);
    for (std::size_t i = 0; i < kPostures; ++i) {
        const BodyState state = changed(seen.model, seen.state, changes, i);
        const double expected =
            epipolar_energy(seen, marks, state) + beyond_limits(seen.model, state);
        EXPECT_NEAR(static_cast<double>(costs[i]), expected, 5e-3 * expected) << i;
    }
}

TEST(PostureWeigher, a_limb_costs_what_its_own_markers_do) {
    const raks::test::SeenPosture seen;
    const FrameMarks marks = seen.marks();
    const BodyLinks links = links_of(seen.model, seen.shape, seen.bones);
    const BodyDivision division = divide(seen.model, links, seen.bones);
    ASSERT_EQ(division.limbs.size(), 4U);
    EXPECT_EQ(division.trunk.markers.size(), 8U);
    EXPECT_EQ(division.trunk.variables.size(), 6U);
    const PostureWeigher weigher(
        seen.model, links, marks, seen.state, Likelihood::reprojection, kBound);
    PostureChanges changes(seen.model.variables(), kPostureBlock);
    std::array<float, kPostureBlock> before{};
    std::array<float, kPostureBlock> after{};
    // Another limb's turn changes nothing.
    weigher.weigh(division.limbs[0], changes, 0, before.data());
    for (const std::size_t variable : division.limbs[2].variables) {
        std::fill_n(changes.of(variable), kPostureBlock, 0.1F);
    }
    weigher.weigh(division.limbs[0], changes, 0, after.data());
    EXPECT_EQ(before, after);
    weigher.weigh(division.limbs[2], changes, 0, after.data());
    EXPECT_GT(after[0], 0.5F);
}

}  // namespace
}  // namespace raks::capture
