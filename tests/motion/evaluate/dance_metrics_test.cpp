#include "motion/evaluate/dance_metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/evaluate/landing_error.hpp"

namespace raks::motion {
namespace {

constexpr double kRate = 60.0;

BodyTrack standing(std::size_t frames) {
    BodyTrack track;
    track.frames_per_second = kRate;
    track.joints.resize(frames);
    track.feet.resize(frames);
    return track;
}

double seconds(std::size_t frame) { return static_cast<double>(frame) / kRate; }

TEST(Jerk, of_a_sine_is_its_third_derivative_and_of_a_steady_way_nothing) {
    // Slow enough that filter and differences cost less than 1 %: 1 Hz at 60 frames a second.
    constexpr double kRadius = 0.1;
    constexpr double kOmega = 2.0 * M_PI;
    BodyTrack track = standing(601);
    BodyTrack steady = standing(601);
    for (std::size_t f = 0; f < track.frames(); ++f) {
        const double t = seconds(f);
        // Flat at both ends, where the filter repeats the last frame.
        track.joints[f].fill({kRadius * std::cos(kOmega * t), 1.0, 0.0});
        steady.joints[f].fill({0.0, 1.0, 0.0});
    }
    const double expected = kRadius * kOmega * kOmega * kOmega;
    EXPECT_NEAR(jerk_of(track).rms, expected / std::sqrt(2.0), 0.01 * expected);
    EXPECT_LT(jerk_of(steady).highest, 1e-6);
    EXPECT_EQ(jerk_of(standing(3)).rms, 0.0);
}

TEST(Contacts, of_a_sliding_toe_are_as_long_as_it_slides) {
    BodyTrack track = standing(240);
    for (std::size_t f = 0; f < track.frames(); ++f) {
        const double t = seconds(f);
        // Left: 0.1 m/s for ever: one contact. Right: in the air.
        track.feet[f][0].toe_tip = {0.1 * t, 0.01, 0.0};
        track.feet[f][1].toe_tip = {0.0, 0.3, 0.0};
    }
    const ContactReport report = contacts_of(track, 0.0);
    ASSERT_EQ(report.slips.size(), 1U);
    // The filter shortens the way by 0.75 frames at its ends.
    EXPECT_NEAR(report.slips[0], 0.1 * seconds(239), 1.3e-3);
    EXPECT_NEAR(report.share, 0.5, 1e-12);
    EXPECT_NEAR(report.toe_speed_mean, 0.1, 1e-3);
    EXPECT_NEAR(report.lowest_toe, 0.01, 1e-12);
}

// A foot that rests, steps 0.4 m in 0.3 s (a raised cosine in speed) and rests again.
void add_step(BodyTrack& track, Side side, double end) {
    constexpr double kLength = 0.3;
    for (std::size_t f = 0; f < track.frames(); ++f) {
        const double u = std::clamp((seconds(f) - end + kLength) / kLength, 0.0, 1.0);
        const double way = 0.4 * (u - std::sin(2.0 * M_PI * u) / (2.0 * M_PI));
        SourceFoot& foot = track.feet[f][static_cast<std::size_t>(side)];
        foot.ankle.z += way;
        foot.toe_tip.z += way;
    }
}

FigureModel two_steps() {
    FigureModel figure;
    figure.beats = 8;
    figure.repeats = 5;
    for (auto& side : figure.landings) {
        side.resize(8);
    }
    figure.landings[0][0] = {5, Beats(0.0), Beats(0.1)};
    figure.landings[1][4] = {5, Beats(0.25), Beats(0.1)};
    return figure;
}

TEST(LandingErrors, measure_how_late_each_foot_is_against_its_learnt_offset) {
    std::vector<double> counts;
    counts.reserve(24);
    for (int k = 0; k < 24; ++k) {
        counts.push_back(2.0 + 0.5 * k);  // 120 BPM
    }
    BodyTrack track = standing(1000);
    for (const double figure_start : {2.0, 6.0, 10.0}) {
        add_step(track, Side::left, figure_start);
        add_step(track, Side::right, figure_start + 2.0 + 0.125);
    }
    const LandingReport on_time = landing_errors(track, two_steps(), counts);
    ASSERT_EQ(on_time.landings.size(), 6U);
    EXPECT_EQ(on_time.missing, 0U);
    EXPECT_EQ(on_time.unexpected, 0U);
    // The raised cosine is under 0.30 m/s for its last 50 ms.
    EXPECT_NEAR(on_time.mean, -0.035, 0.02);
    EXPECT_LT(on_time.deviation, 0.002);

    BodyTrack late = standing(1000);
    for (const double figure_start : {2.0, 6.0, 10.0}) {
        add_step(late, Side::left, figure_start + 0.1);
        add_step(late, Side::right, figure_start + 2.0 + 0.125 + 0.1);
    }
    EXPECT_NEAR(landing_errors(late, two_steps(), counts).mean, on_time.mean + 0.1, 0.003);
}

TEST(LandingErrors, of_a_mirrored_figure_are_of_the_other_foot) {
    std::vector<AudibleCount> counts;
    const FigureModel figure = two_steps();
    for (std::size_t k = 0; k < 24; ++k) {
        const double time = 2.0 + 0.5 * static_cast<double>(k);
        counts.push_back({&figure, k % static_cast<std::size_t>(figure.beats), time, 0.5, true});
    }
    BodyTrack track = standing(1000);
    for (const double figure_start : {2.0, 6.0, 10.0}) {
        add_step(track, Side::right, figure_start);
        add_step(track, Side::left, figure_start + 2.0 + 0.125);
    }
    const LandingReport report = landing_errors(track, counts);
    EXPECT_EQ(report.landings.size(), 6U);
    EXPECT_EQ(report.missing, 0U);
    EXPECT_EQ(report.unexpected, 0U);
}

TEST(LandingErrors, count_steps_that_are_missing_or_not_expected) {
    std::vector<double> counts;
    counts.reserve(16);
    for (int k = 0; k < 16; ++k) {
        counts.push_back(2.0 + 0.5 * k);
    }
    BodyTrack track = standing(900);
    add_step(track, Side::left, 2.0);
    add_step(track, Side::left, 4.0);  // nobody steps left on 5
    const LandingReport report = landing_errors(track, two_steps(), counts);
    EXPECT_EQ(report.landings.size(), 1U);
    EXPECT_EQ(report.missing, 3U);
    EXPECT_EQ(report.unexpected, 1U);
}

TEST(LandingErrors, a_step_between_the_beats_belongs_to_its_own_count_however_late) {
    FigureModel figure = two_steps();
    figure.landings[0][0] = {5, Beats(0.5), Beats(0.05)};
    figure.landings[0][1] = {5, Beats(0.0), Beats(0.05)};  // and at once the next one
    std::vector<double> counts;
    for (int k = 0; k < 16; ++k) {
        counts.push_back(2.0 + 0.5 * k);
    }
    BodyTrack track = standing(900);
    add_step(track, Side::left, 2.25 + 0.09);  // 0.18 beats late: past the middle of both counts
    add_step(track, Side::left, 6.25 + 0.09);
    const LandingReport report = landing_errors(track, figure, counts);
    ASSERT_EQ(report.landings.size(), 2U);
    EXPECT_EQ(report.landings[0].count, 1);
    EXPECT_NEAR(report.landings[0].error, 0.09 - 0.035, 0.02);
    EXPECT_EQ(report.unexpected, 0U);
}

TEST(LandingErrors, of_steps_that_were_learnt_far_from_a_beat_are_counted_and_not_judged) {
    std::vector<AudibleCount> counts;
    const FigureModel figure = two_steps();  // the right foot comes a quarter of a beat late
    for (std::size_t k = 0; k < 24; ++k) {
        counts.push_back({&figure, k % 8, 2.0 + 0.5 * static_cast<double>(k), 0.5, false});
    }
    BodyTrack track = standing(1000);
    for (const double figure_start : {2.0, 6.0, 10.0}) {
        add_step(track, Side::left, figure_start);
    }
    add_step(track, Side::right, 4.0 + 0.125);
    const LandingReport report = landing_errors(track, counts, {.farthest = 0.15});
    EXPECT_EQ(report.landings.size(), 3U) << "the left foot's";
    EXPECT_EQ(report.off_beat, 1U);
    EXPECT_EQ(report.missing, 0U) << "two that are not judged";
    EXPECT_EQ(report.unexpected, 0U);
}

TEST(LandingErrors, expect_nothing_where_a_foot_comes_down_twice_a_count) {
    FigureModel figure = two_steps();
    figure.landings[0][0] = {10, Beats(-0.1), Beats(0.2)};  // of 5 repeats
    std::vector<double> counts;
    for (int k = 0; k < 16; ++k) {
        counts.push_back(2.0 + 0.5 * k);
    }
    const LandingReport report = landing_errors(standing(900), figure, counts);
    EXPECT_EQ(report.missing, 2U);  // the right foot's
}

}  // namespace
}  // namespace raks::motion
