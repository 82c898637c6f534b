#include "audio/evaluate/beat_metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "base/random.hpp"

#include <nlohmann/json.hpp>

namespace raks::audio {
namespace {

using Times = std::vector<double>;

/// Both sums run over some hundred terms of size 1; mir_eval adds them in another order.
constexpr double kRounding = 1e-12;

nlohmann::json vectors(const char* name) {
    std::ifstream file(std::string(RAKS_SOURCE_DIR) + "/tests/data/beats/" + name);
    return nlohmann::json::parse(file);
}

Times steady(double first, double interval, int count) {
    Times times;
    for (int i = 0; i < count; ++i) {
        times.push_back(first + interval * i);
    }
    return times;
}

Times moved(Times times, double seconds) {
    for (double& time : times) {
        time += seconds;
    }
    return times;
}

struct MirEvalValues {
    double f, cemgil, p, cml_longest, cml_total, aml_longest, aml_total, information_gain;
};
void expect_values(const Times& reference, const Times& estimate, const MirEvalValues& expected) {
    EXPECT_NEAR(f_measure(reference, estimate), expected.f, kRounding);
    EXPECT_NEAR(cemgil_accuracy(reference, estimate), expected.cemgil, kRounding);
    EXPECT_NEAR(p_score(reference, estimate), expected.p, kRounding);
    const Continuity levels = continuity(reference, estimate);
    EXPECT_NEAR(levels.cml_longest, expected.cml_longest, kRounding);
    EXPECT_NEAR(levels.cml_total, expected.cml_total, kRounding);
    EXPECT_NEAR(levels.aml_longest, expected.aml_longest, kRounding);
    EXPECT_NEAR(levels.aml_total, expected.aml_total, kRounding);
    EXPECT_NEAR(information_gain(reference, estimate), expected.information_gain, kRounding);
}

TEST(BeatMetrics, equal_mir_eval_on_small_cases) {
    const nlohmann::json document = vectors("cases.json");
    ASSERT_EQ(document["cases"].size(), 18U);
    for (const auto& one : document["cases"]) {
        SCOPED_TRACE(one["name"].get<std::string>());
        const auto& expected = one["expect"];
        expect_values(one["reference"].get<Times>(),
                      one["estimate"].get<Times>(),
                      {expected["f_measure"],
                       expected["cemgil"],
                       expected["p_score"],
                       expected["CMLc"],
                       expected["CMLt"],
                       expected["AMLc"],
                       expected["AMLt"],
                       expected["information_gain"]});
    }
}

TEST(BeatMetrics, equal_the_values_that_mir_eval_publishes) {
    const nlohmann::json document = vectors("published.json");
    ASSERT_EQ(document["cases"].size(), 10U);
    for (const auto& one : document["cases"]) {
        SCOPED_TRACE(one["name"].get<std::string>());
        const auto without_start = [](Times times) {
            times.erase(times.begin(), std::lower_bound(times.begin(), times.end(), 5.0));
            return times;
        };
        const auto& expected = one["expect_after_dropping_beats_before_5s"];
        expect_values(without_start(one["reference"].get<Times>()),
                      without_start(one["estimate"].get<Times>()),
                      {expected["F-measure"],
                       expected["Cemgil"],
                       expected["P-score"],
                       expected["Correct Metric Level Continuous"],
                       expected["Correct Metric Level Total"],
                       expected["Any Metric Level Continuous"],
                       expected["Any Metric Level Total"],
                       expected["Information gain"]});
    }
}

TEST(BeatMetrics, do_not_depend_on_where_the_music_starts) {
    const CounterRandom random(7);
    Times reference;
    Times estimate;
    for (std::uint64_t i = 0; i < 60; ++i) {
        reference.push_back(1.0 + 0.5 * static_cast<double>(i));
        if (random.uniform(i) < 0.9) {
            estimate.push_back(reference.back() + 0.03 * random.normal(i));
        }
    }
    // A power of two keeps the distances' bits but for the last.
    const Times later_reference = moved(reference, 64.0);
    const Times later_estimate = moved(estimate, 64.0);
    EXPECT_EQ(f_measure(reference, estimate), f_measure(later_reference, later_estimate));
    EXPECT_NEAR(cemgil_accuracy(reference, estimate),
                cemgil_accuracy(later_reference, later_estimate),
                1e-9);
    EXPECT_EQ(continuity(reference, estimate).cml_total,
              continuity(later_reference, later_estimate).cml_total);
    EXPECT_EQ(time_to_lock(reference, estimate), time_to_lock(later_reference, later_estimate));
}

TEST(BeatMetrics, are_zero_or_empty_without_beats) {
    const Times beats = steady(0.5, 0.5, 20);
    const Times none;
    for (const auto& [reference, estimate] :
         {std::pair{beats, none}, std::pair{none, beats}, std::pair{none, none}}) {
        expect_values(reference, estimate, {});
        EXPECT_EQ(time_to_lock(reference, estimate), std::nullopt);
        EXPECT_EQ(median_bias(reference, estimate), std::nullopt);
        EXPECT_EQ(median_error(reference, estimate), std::nullopt);
        EXPECT_FALSE(tempo_accuracy(reference, estimate).is_octave);
    }
}

TEST(BeatMetrics, beats_at_one_moment_give_finite_values) {
    const Times reference = steady(0.5, 0.5, 20);
    const Times together(20, 5.0);
    for (const auto& [a, b] : {std::pair{reference, together}, std::pair{together, reference}}) {
        EXPECT_TRUE(std::isfinite(p_score(a, b)));
        EXPECT_TRUE(std::isfinite(information_gain(a, b)));
        EXPECT_TRUE(std::isfinite(continuity(a, b).aml_total));
        EXPECT_TRUE(std::isfinite(cemgil_accuracy(a, b)));
    }
}

TEST(BeatMetrics, a_hit_is_within_the_tolerance_and_one_to_one) {
    const Times reference = {1.0, 2.0};
    EXPECT_EQ(f_measure(reference, Times{1.07, 1.93}), 1.0);
    EXPECT_EQ(f_measure(reference, Times{1.0701, 1.9299}), 0.0);
    EXPECT_EQ(f_measure(reference, Times{1.035, 2.036}, kPredictionTolerance), 0.5);
    // Two estimates at one beat: one hit.
    EXPECT_EQ(f_measure(reference, Times{0.99, 1.01}), 0.5);
    // Greedy from the left finds the most pairs: the first estimate must not take the second beat.
    EXPECT_EQ(f_measure(Times{1.00, 1.10}, Times{1.05, 1.12}), 1.0);
}

TEST(BeatMetrics, a_beat_before_the_first_counts_as_nearly_exact_as_in_mir_eval) {
    const Times reference = steady(10.0, 0.5, 81);
    Times estimate = reference;
    estimate.insert(estimate.begin(), 9.75);  // half a beat early: the worst phase there is
    // All 82 estimates fall in the middle bin: 0.25 s over the 40 s from the last beat. The
    // other way round the first beat, nearest to itself, is exact.
    EXPECT_EQ(information_gain(reference, estimate), 1.0);
}

TEST(TimeToLock, is_from_the_first_beat_to_four_hits_in_a_row) {
    const Times reference = steady(1.0, 0.5, 20);
    EXPECT_EQ(time_to_lock(reference, reference), 0.0);
    EXPECT_EQ(time_to_lock(reference, steady(3.02, 0.5, 10)), 2.0);
    EXPECT_EQ(time_to_lock(reference, steady(9.02, 0.5, 3)), std::nullopt);
    // 80 ms late is no hit; an off-beat between the hits is no lock.
    EXPECT_EQ(time_to_lock(reference, moved(reference, 0.08)), std::nullopt);
    EXPECT_EQ(time_to_lock(reference, steady(1.0, 0.25, 40)), std::nullopt);
    Times gap = reference;
    gap.erase(gap.begin() + 3);
    EXPECT_EQ(time_to_lock(reference, gap), 2.0);
}

TEST(TempoAccuracy, takes_four_per_cent_and_octaves) {
    const Times reference = steady(0.0, 0.5, 30);
    const struct {
        double interval;
        bool is_exact;
        bool is_octave;
    } table[] = {
        {0.5, true, true},
        {0.5 / 1.039, true, true},
        {0.5 / 1.041, false, false},
        {0.5 / 0.961, true, true},
        {0.25, false, true},
        {1.0, false, true},
        {0.5 / 3, false, true},
        {1.5, false, true},
        {0.5 / 1.5, false, false},
        {2.0, false, false},
    };
    for (const auto& row : table) {
        const TempoAccuracy accuracy = tempo_accuracy(reference, steady(0.1, row.interval, 10));
        EXPECT_EQ(accuracy.is_exact, row.is_exact) << row.interval;
        EXPECT_EQ(accuracy.is_octave, row.is_octave) << row.interval;
    }
    EXPECT_FALSE(tempo_accuracy(reference, Times{0.0, 0.5}).is_exact) << "two beats are no tempo";
}

TEST(MedianBias, is_positive_when_late_and_counts_hits_only) {
    const Times reference = {1.0, 2.0, 3.0, 4.0};
    const Times estimate = {0.99, 2.03, 3.02, 4.5};
    EXPECT_NEAR(median_bias(reference, estimate).value(), 0.02, 1e-12);
    EXPECT_NEAR(median_error(reference, estimate).value(), 0.02, 1e-12);
    const Times both_sides = {0.98, 2.02};
    EXPECT_NEAR(median_bias(reference, both_sides).value(), 0.0, 1e-12);
    EXPECT_NEAR(median_error(reference, both_sides).value(), 0.02, 1e-12);
}

}  // namespace
}  // namespace raks::audio
