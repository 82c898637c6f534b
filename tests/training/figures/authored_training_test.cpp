// A written figure through the training of captured ones: what it dances is still in the model.
#include "training/figures/authored_training.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/file.hpp"
#include "motion/choreography/figure_evaluation.hpp"
#include "motion/choreography/figure_measures.hpp"
#include "motion/dance/baking/trajectory.hpp"
#include "tests/motion/choreography/small_dance.hpp"
#include "tests/support/dances.hpp"

namespace raks::motion {
namespace {

FigureModel learnt(const AuthoredDance& dance,
                   std::size_t figure,
                   FigureFeatures features = FigureFeatures::angles) {
    AuthoredTrainingOptions options;
    options.features = features;
    options.takes = 2;
    options.repeats = 3;
    auto trained =
        train_authored_figure(dance, dance.figures[figure], mannequin_skeleton(), options);
    EXPECT_TRUE(trained) << trained.error().message;
    return trained ? std::move(trained->model) : FigureModel{};
}

/// Of one torso feature: how wide the learnt trajectory is beside the repeats.
double width_kept(const FigureModel& model, RootFeature feature) {
    const PartModel& torso = model.part(Part::torso);
    const auto column = static_cast<std::size_t>(feature);
    const FeatureTrack track = most_likely_trajectory(torso, model.samples());
    double mean = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < track.rows(); ++i) {
        mean += track.row(i)[column] / static_cast<double>(track.rows());
        square += track.row(i)[column] * track.row(i)[column] / static_cast<double>(track.rows());
    }
    return std::sqrt((square - mean * mean) / torso.global_variance[column]);
}

TEST(AuthoredTraining, learns_length_feet_and_tempo_of_a_figure) {
    const AuthoredDance dance = dance_of(kSmallDance);
    const FigureModel model = learnt(dance, 0);
    EXPECT_EQ(model.name, "rock_step");
    EXPECT_EQ(model.dance, "rock");
    EXPECT_EQ(model.beats, 4);
    EXPECT_NEAR(model.learnt_tempo.bpm(), 120.0, 1e-6);
    EXPECT_TRUE(validate(model));
    // Left lands on beat 0, right on beat 2, within 30 ms.
    EXPECT_NEAR(model.landings[0][0].median.count(), 0.0, 0.06);
    EXPECT_NEAR(model.landings[1][2].median.count(), 0.0, 0.06);
    // Left stands in the second half of beat 1, and swings at 3.7.
    EXPECT_GT(model.contact[0][24], 0.9);
    EXPECT_LT(model.contact[0][59], 0.5);
}

TEST(AuthoredTraining, both_sides_of_a_mirrored_figure_are_one_figure) {
    const AuthoredDance dance = dance_of(kSmallDance);
    EXPECT_EQ(learnt(dance, 1).beats, 4);
}

TEST(AuthoredTraining, learns_positions_that_take_the_same_steps) {
    const AuthoredDance dance = dance_of(kSmallDance);
    const FigureModel angles = learnt(dance, 0);
    const FigureModel positions = learnt(dance, 0, FigureFeatures::positions);
    EXPECT_TRUE(validate(positions));
    EXPECT_EQ(positions.features, FigureFeatures::positions);
    EXPECT_EQ(positions.contact, angles.contact);
    EXPECT_EQ(positions.landings[1][2].median, angles.landings[1][2].median);
}

TEST(AuthoredTraining, gives_the_same_bits_again) {
    const AuthoredDance dance = dance_of(kSmallDance);
    EXPECT_EQ(figure_text(learnt(dance, 1)), figure_text(learnt(dance, 1)));
}

TEST(AuthoredTraining, a_shimmy_keeps_four_fifths_of_its_width) {
    const AuthoredDance dance = dance_of(replaced(
        "body.chest.yaw", "body.hip.roll = { wave = 4, every = 0.25, peak = 0 }\nbody.chest.yaw"));
    EXPECT_EQ(states_for(dance.figures[0]), 48);
    EXPECT_GT(width_kept(learnt(dance, 0), RootFeature::tilt_z), 0.8);  // before it is widened
}

TEST(AuthoredTraining, a_jump_keeps_four_fifths_of_its_height) {
    auto dance =
        load_authored_dance(std::string(RAKS_SOURCE_DIR) + "/tests/data/choreography/rock.toml");
    ASSERT_TRUE(dance);
    const auto pogo = static_cast<std::size_t>(dance->figure("pogo") - dance->figures.data());
    EXPECT_GT(width_kept(learnt(*dance, pogo), RootFeature::height), 0.8);
}

TEST(AuthoredTraining, refuses_what_cannot_be_danced) {
    const AuthoredDance dance = dance_of(replaced("to = [-16, 0]", "to = [-130, 0]"));
    const auto trained = train_authored_figure(dance, dance.figures[0], mannequin_skeleton());
    ASSERT_FALSE(trained);
    EXPECT_NE(trained.error().message.find("cannot be reached"), std::string::npos);
}

TEST(AuthoredTraining, gives_the_shipped_models_bit_for_bit) {
    const std::string root = RAKS_SOURCE_DIR;
    const struct {
        const char* dance;
        const char* figure;
    } figures[] = {{"belly", "figure_eight"}, {"rock", "pogo"}};
    for (const auto& [name, figure] : figures) {
        const auto dance = load_authored_dance(root + "/config/choreographies/" + name + ".toml");
        ASSERT_TRUE(dance) << dance.error().message;
        const auto trained =
            train_authored_figure(*dance, *dance->figure(figure), mannequin_skeleton());
        ASSERT_TRUE(trained) << trained.error().message;
        const auto shipped =
            read_file(root + "/models/trained/" + name + "_" + figure + "_lead.json");
        ASSERT_TRUE(shipped) << shipped.error().message;
        EXPECT_TRUE(figure_text(trained->model) == *shipped)
            << figure << ": run scripts/train_dances.sh";
    }
}

TEST(FigureMeasures, a_frozen_and_a_wandering_figure_fail_what_their_file_expects) {
    std::string text = replaced("[1, 60]", "[4, 60]");
    const AuthoredDance moving = dance_of(text);
    EXPECT_TRUE(faults_in_measures(moving,
                                   moving.figures[0],
                                   measure_figure(moving, moving.figures[0], mannequin_skeleton()))
                    .empty());
    // The second figure has no step that goes anywhere.
    const auto faults = faults_in_measures(
        moving, moving.figures[1], measure_figure(moving, moving.figures[1], mannequin_skeleton()));
    ASSERT_FALSE(faults.empty());
    EXPECT_NE(faults[0].find("figure \"sway\": hips travel, cm a beat,"), std::string::npos)
        << faults[0];
}

TEST(FigureMeasures, the_shipped_dances_do_what_their_files_expect) {
    for (const auto& file : raks::test::written_dances()) {
        const auto dance = load_authored_dance(file);
        ASSERT_TRUE(dance) << dance.error().message;
        for (const AuthoredFigure& figure : dance->figures) {
            const TakeMeasures measures = measure_figure(*dance, figure, mannequin_skeleton());
            for (const std::string& fault : faults_in_measures(*dance, figure, measures)) {
                ADD_FAILURE() << fault;
            }
            // People's repeats lie 8 to 15 cm apart.
            EXPECT_GT(measures.repeat_distance, 0.055) << figure.name;
            EXPECT_LT(measures.repeat_distance, 0.14) << figure.name;
            EXPECT_LT(measures.slip_p90, 0.027) << figure.name;
            EXPECT_TRUE(figure.expectation.hip_travel && figure.expectation.toe_contacts &&
                        figure.expectation.hand_delay)
                << figure.name << " states no ranges";
        }
    }
}

}  // namespace
}  // namespace raks::motion
