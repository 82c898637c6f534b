#include "training/figures/figure_report.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/motion/figures/small_figure.hpp"

namespace raks::motion {
namespace {

/// Of three takes of the known dance with two figures each; the last take is the surest.
FigureReport report_of(FigureFeatures features) {
    std::vector<TrainingClip> clips;
    std::vector<FigureRepeat> repeats;
    for (std::size_t i = 0; i < 3; ++i) {
        clips.push_back(test::known_dance(2));
        clips.back().name = "take_" + std::to_string(i);
        for (FigureRepeat repeat : test::known_repeats(2)) {
            repeat.clip = i;
            repeat.weight = 0.7 + 0.1 * static_cast<double>(i);
            repeats.push_back(repeat);
        }
    }
    FigureTrainingOptions options = test::known_options();
    options.features = features;
    options.baum_welch_iterations = 3;
    return report_figure(clips, repeats, options, {.most = 6, .threads = 2}).value();
}

const FigureReport& known_report() {
    static const FigureReport report = report_of(FigureFeatures::angles);
    return report;
}

TEST(FigureReport, shows_the_surest_repeats_of_different_takes_first) {
    EXPECT_EQ(known_report().shown, (std::vector<std::size_t>{4, 2, 0, 5}));
    EXPECT_EQ(known_report().takes[4], "take_2");
    EXPECT_EQ(known_report().figure, "known");
}

TEST(FigureReport, every_repeat_passes_all_states_in_order) {
    for (const PartReport& part : known_report().parts) {
        EXPECT_EQ(part.states(), static_cast<std::size_t>(part.selection.chosen));
        ASSERT_EQ(part.paths.size(), 6U);
        for (const std::vector<std::size_t>& path : part.paths) {
            ASSERT_EQ(path.size(), 192U);
            EXPECT_EQ(path.front(), 0U);
            EXPECT_EQ(path.back(), part.states() - 1);
            for (std::size_t t = 1; t < path.size(); ++t) {
                EXPECT_TRUE(path[t] == path[t - 1] || path[t] == path[t - 1] + 1);
            }
        }
    }
}

TEST(FigureReport, every_count_and_every_repeat_is_shared_out_whole) {
    for (const PartReport& part : known_report().parts) {
        ASSERT_EQ(part.occurrence.size(), 8U);
        for (const std::vector<double>& count : part.occurrence) {
            EXPECT_NEAR(std::accumulate(count.begin(), count.end(), 0.0), 1.0, 1e-9);
        }
        for (std::size_t r = 0; r < 6; ++r) {
            double beats = 0.0;
            for (const std::vector<double>& stays : part.stays) {
                EXPECT_GE(stays[r], 1.0 / 24.0 - 1e-9);
                beats += stays[r];
            }
            EXPECT_NEAR(beats, 8.0, 1e-9);
        }
    }
}

TEST(FigureReport, shows_the_features_that_move_from_state_to_state) {
    // The knees and nothing else of the legs; one arm swings.
    const PartReport& lower = known_report().parts[static_cast<std::size_t>(Part::lower)];
    ASSERT_EQ(lower.curves.size(), 2U);
    EXPECT_EQ(lower.curves[0].unit, "rad");
    EXPECT_NE(lower.curves[0].name.find("lower leg, x"), std::string::npos);
    EXPECT_NE(lower.curves[1].name.find("lower leg, x"), std::string::npos);
    EXPECT_NE(lower.curves[0].name, lower.curves[1].name);
    EXPECT_GT(lower.curves[0].explained, 0.8);
    EXPECT_LE(lower.curves[0].explained, 1.0);
    EXPECT_EQ(lower.curves[0].repeats.size(), 4U);
    EXPECT_EQ(lower.curves[0].state_means.size(), lower.states());
    EXPECT_EQ(known_report().parts[1].curves[0].name, "left upper arm, x");
}

TEST(FigureReport, of_positions_has_an_upper_and_a_lower_part) {
    const FigureReport report = report_of(FigureFeatures::positions);
    EXPECT_EQ(report.features, FigureFeatures::positions);
    EXPECT_TRUE(report.parts[static_cast<std::size_t>(Part::torso)].paths.empty());
    for (const Part which : parts_of(report.features)) {
        const PartReport& part = report.parts[static_cast<std::size_t>(which)];
        EXPECT_EQ(part.states(), static_cast<std::size_t>(part.selection.chosen));
        EXPECT_EQ(part.paths.size(), 6U);
        EXPECT_EQ(part.selection.tried.size(), 5U);
        ASSERT_EQ(part.curves.size(), 2U);
        EXPECT_EQ(part.curves[1].unit, "m");
    }
}

TEST(FigureReport, names_every_feature) {
    PartModel torso;
    torso.part = Part::torso;
    torso.joints = {{Bone::spine, {}}, {Bone::chest, {}}};
    EXPECT_EQ(feature_name(torso, 1), "hips forward");
    EXPECT_EQ(feature_unit(torso, 1), "m a beat");
    EXPECT_EQ(feature_unit(torso, 2), "rad a beat");
    EXPECT_EQ(feature_name(torso, 5), "hips' tilt, z");
    EXPECT_EQ(feature_name(torso, 7), "spine, y");
    EXPECT_EQ(feature_name(torso, 11), "chest, z");
    EXPECT_EQ(feature_unit(torso, 11), "rad");
    PartModel lower;
    lower.part = Part::lower;
    lower.features = FigureFeatures::positions;
    lower.joints = {{Bone::left_foot, {}}};
    EXPECT_EQ(feature_name(lower, 2), "turn");
    EXPECT_EQ(feature_name(lower, 4), "left foot, y");
    EXPECT_EQ(feature_unit(lower, 4), "m");
}

}  // namespace
}  // namespace raks::motion
