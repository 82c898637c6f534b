#include "motion/capture/angles/angle_filter.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/motion/capture/angles/angle_scene.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

/// Where a dancer may be thought to be before a frame.
BodyState beside(const raks::test::SeenPosture& seen, double by) {
    std::vector<double> change(seen.model.variables());
    for (std::size_t i = 0; i < change.size(); ++i) {
        change[i] = (i < 3 ? 0.2 : 1.0) * by * std::cos(2.0 * static_cast<double>(i));
    }
    return seen.model.moved(seen.state, change.data());
}

double mean_distance(const raks::test::SeenPosture& seen, const BodyState& one) {
    const auto places = marker_places_of(seen.context(), one);
    const auto truth = marker_places_of(seen.context(), seen.state);
    double sum = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        sum += glm::distance(places[i], truth[i]) / static_cast<double>(places.size());
    }
    return sum;
}

FilteredPosture found(const raks::test::SeenPosture& seen, const AngleFilterOptions& options) {
    AngleFilter filter(seen.context(), options);
    return filter.find(seen.marks(), {beside(seen, 0.06), {seen.state}}, 7);
}

TEST(PosturePolish, leads_to_the_posture_that_was_seen) {
    const raks::test::SeenPosture seen;
    const BodyState start = beside(seen, 0.008);
    const std::vector<double> deviations(seen.model.variables(), 1.0);
    EXPECT_GT(mean_distance(seen, start), 0.003);
    const BodyState polished =
        polish(seen.context(), seen.marks(), 1.0, {start, deviations}, start);
    EXPECT_LT(mean_distance(seen, polished), 1e-4);
}

TEST(PosturePolish, is_kept_only_if_it_fits_better) {
    const raks::test::SeenPosture seen;
    // A prediction that is very sure, and wrong, draws a posture away from what was seen.
    const BodyState wrong = beside(seen, 0.02);
    const std::vector<double> sure(seen.model.variables(), 1e-5);
    const BodyState kept = polish(seen.context(), seen.marks(), 1.0, {wrong, sure}, seen.state);
    EXPECT_LT(mean_distance(seen, kept), 1e-12);
}

TEST(AngleFilter, finds_a_posture_near_its_prediction) {
    const raks::test::SeenPosture seen;
    EXPECT_GT(mean_distance(seen, beside(seen, 0.06)), 0.025);
    for (const FilterKind kind : {FilterKind::partitioned, FilterKind::full}) {
        for (const Likelihood likelihood : {Likelihood::reprojection, Likelihood::epipolar}) {
            AngleFilterOptions options;
            options.filter = kind;
            options.likelihood = likelihood;
            options.is_polished = false;
            const double rough = mean_distance(seen, found(seen, options).state);
            EXPECT_LT(rough, kind == FilterKind::full ? 0.02 : 0.01);
            options.is_polished = true;
            EXPECT_LT(mean_distance(seen, found(seen, options).state), 1e-3);
        }
    }
}

TEST(AngleFilter, gives_the_same_bits_for_any_number_of_threads) {
    const raks::test::SeenPosture seen;
    AngleFilterOptions options;
    options.particles = 50;  // not a whole number of blocks
    options.is_polished = false;
    const BodyState alone = found(seen, options).state;
    for (const int threads : {2, 5}) {
        options.threads = threads;
        const BodyState together = found(seen, options).state;
        EXPECT_EQ(together.hips, alone.hips);
        EXPECT_EQ(together.turns, alone.turns);
        EXPECT_EQ(together.angles, alone.angles);
    }
    options.seed = 2;
    EXPECT_NE(found(seen, options).state.hips, alone.hips);
}

}  // namespace
}  // namespace raks::capture
