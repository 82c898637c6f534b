#include "training/figures/figure_trainer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/figures/foot_events.hpp"
#include "tests/motion/figures/small_figure.hpp"
#include "training/figures/repeat_features.hpp"

namespace raks::motion {
namespace {

TEST(PhaseWarp, goes_through_the_beats_rises_and_is_inverted) {
    const std::vector<double> frames = {10.0, 30.0, 55.0, 70.0, 95.0};
    const PhaseWarp warp(frames);
    double before = -100.0;
    for (double beat = -0.5; beat <= 4.6; beat += 0.01) {
        const double frame = warp.frame_at(beat);
        EXPECT_GT(frame, before);
        before = frame;
        EXPECT_NEAR(warp.beat_at(frame), beat, 1e-8);
    }
    for (std::size_t b = 0; b < frames.size(); ++b) {
        EXPECT_NEAR(warp.frame_at(static_cast<double>(b)), frames[b], 1e-12);
    }
}

TEST(LowPass, keeps_dancing_and_takes_trembling) {
    const std::vector<double> taps = low_pass_taps(10.0, 60.0);
    const auto gain = [&](double hz) {
        std::vector<double> wave(300);
        for (std::size_t i = 0; i < wave.size(); ++i) {
            wave[i] = std::sin(2.0 * M_PI * hz * static_cast<double>(i) / 60.0);
        }
        const std::vector<double> out = filtered(wave, taps);
        double in_square = 0.0;
        double out_square = 0.0;
        for (std::size_t i = 50; i < 250; ++i) {
            in_square += wave[i] * wave[i];
            out_square += out[i] * out[i];
        }
        return std::sqrt(out_square / in_square);
    };
    EXPECT_NEAR(gain(3.0), 1.0, 0.02);
    EXPECT_LT(gain(20.0), 0.03);
    EXPECT_EQ(low_pass_taps(40.0, 60.0), std::vector<double>{1.0});
}

TEST(BridgeFaults, replaces_jumps_by_the_straight_way) {
    std::vector<Pose> poses(10);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        poses[i].hips_position.x = static_cast<float>(i);
    }
    poses[4].hips_position.x = 1000.0F;
    poses[5].hips_position.x = -1000.0F;
    const std::vector<FrameSpan> faults = {{4, 5}, {8, 50}, {90, 95}};
    bridge_faults(poses, faults);
    EXPECT_NEAR(poses[4].hips_position.x, 4.0F, 1e-5F);
    EXPECT_NEAR(poses[5].hips_position.x, 5.0F, 1e-5F);
    EXPECT_EQ(poses[9].hips_position.x, 7.0F);  // held from the last sound frame
}

TEST(FigureTrainer, learns_the_known_dance) {
    const FigureModel model =
        test::learnt(test::known_dance(4, 0.25), 4, test::known_options()).model;
    EXPECT_TRUE(validate(model));
    EXPECT_EQ(model.repeats, 4);
    EXPECT_NEAR(model.learnt_tempo.bpm(), 180.0, 1e-9);
    EXPECT_NEAR(model.net_turn, 0.25, 1e-3);
    EXPECT_NEAR(model.net_displacement.x, 0.0, 0.02);
    EXPECT_EQ(model.source_hips_height, 0.9);

    // The left knee's swing, 0.4 sin(phase) about its mean, in the middle of state 4 of 16.
    const PartModel& lower = model.part(Part::lower);
    ASSERT_EQ(lower.joints[1].bone, Bone::left_lower_leg);
    const double expected = 0.4 * std::sin(2.0 * M_PI * 4.5 / 16.0);
    EXPECT_NEAR(lower.states[4].mean[3], expected, 0.03);
    EXPECT_GT(lower.states[0].delta_mean[3], 0.0);
    EXPECT_LT(lower.states[7].delta_mean[3], 0.0);
    EXPECT_NEAR(lower.global_variance[3], 0.08, 0.01);  // of 0.4 sin
}

TEST(FigureTrainer, states_lie_on_equal_slices_of_the_phase) {
    const FigureModel model = test::learnt(test::known_dance(3), 3, test::known_options()).model;
    for (const PartModel& part : model.parts) {
        ASSERT_EQ(part.states.size(), 16U);
        EXPECT_EQ(part.state_at(0, model.samples()), 0U);
        EXPECT_EQ(part.state_at(11, model.samples()), 0U);
        EXPECT_EQ(part.state_at(12, model.samples()), 1U);
        EXPECT_EQ(part.state_at(191, model.samples()), 15U);
        // 12 samples a state: left with chance 1/12, to the next one or out.
        EXPECT_NEAR(part.transition[3][4], 1.0 / 12.0, 1e-12);
        EXPECT_NEAR(part.transition[3][3], 11.0 / 12.0, 1e-12);
        EXPECT_NEAR(part.exit[15], 1.0 / 12.0, 1e-12);
    }
}

TEST(FigureTrainer, learns_when_the_feet_rest_and_land) {
    const FigureModel model = test::learnt(test::known_dance(3), 3, test::known_options()).model;
    // The left foot rests on beats 0-4 and moves on 4-8; the right the other way round.
    EXPECT_EQ(model.contact[0][16], 1.0);
    EXPECT_EQ(model.contact[0][34], 0.0);
    EXPECT_EQ(model.contact[1][16 + 32], 1.0);
    // 0.3 sin(2 pi (u - 0.5)) metres over figures of 160/60 s: from 0.707 m/s under 0.3 m/s.
    const double speed = 0.3 * 2.0 * M_PI / (160.0 / 60.0);
    const double beat = 8.0 * std::acos(0.3 / speed) / (2.0 * M_PI);  // 1.44 after the start
    EXPECT_EQ(model.landings[0][5].repeats, 3);
    EXPECT_NEAR(model.landings[0][5].median.count(), 4.0 + beat - 5.0, 0.05);
    EXPECT_EQ(model.landings[1][1].repeats, 3);
    EXPECT_NEAR(model.landings[1][1].median.count(), beat - 1.0, 0.05);
    EXPECT_EQ(model.landings[0][2].repeats, 0);
}

TEST(FigureTrainer, gives_the_same_bits_again) {
    const std::string once =
        figure_text(test::learnt(test::known_dance(4, 0.1), 4, test::known_options()).model);
    const std::string again =
        figure_text(test::learnt(test::known_dance(4, 0.1), 4, test::known_options()).model);
    EXPECT_EQ(once, again);
}

TEST(FigureTrainer, baum_welch_rounds_move_states_and_keep_left_to_right) {
    FigureTrainingOptions options = test::known_options(8);
    const FigureModel sliced = test::learnt(test::known_dance(4), 4, options).model;
    options.baum_welch_iterations = 5;
    const FigureModel refined = test::learnt(test::known_dance(4), 4, options).model;
    EXPECT_TRUE(validate(refined));
    EXPECT_NE(refined.part(Part::lower).states[3].mean, sliced.part(Part::lower).states[3].mean);
    for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t j = 0; j < 8; ++j) {
            if (j != i && j != i + 1) {
                EXPECT_EQ(refined.part(Part::lower).transition[i][j], 0.0);
            }
        }
    }
}

TEST(FigureTrainer, every_covariance_and_start_gives_a_valid_model_that_tells_the_figure) {
    const std::vector<TrainingClip> same = {test::known_dance(4)};
    for (const CovarianceKind covariance :
         {CovarianceKind::tied, CovarianceKind::full, CovarianceKind::diagonal}) {
        for (const StatesStart start : {StatesStart::flat, StatesStart::segmental}) {
            FigureTrainingOptions options = test::known_options(6);
            options.covariance = covariance;
            options.start = start;
            options.baum_welch_iterations = 2;
            const FigureTrainingResult result = test::learnt(same[0], 4, options);
            const PartModel& lower = result.model.part(Part::lower);
            EXPECT_EQ(lower.covariance_kind, covariance);
            EXPECT_EQ(lower.state_covariances.size(), covariance == CovarianceKind::tied ? 0U : 6U);
            const Expected<double> score =
                score_repeats(result.model, Part::lower, same, test::known_repeats(4), 10.0);
            ASSERT_TRUE(score);
            // The very model that was learnt is what is kept.
            EXPECT_NEAR(*score, result.log_likelihood[2], 1e-9);
            const Expected<FigureModel> again = parse_figure(figure_text(result.model), "x");
            ASSERT_TRUE(again) << again.error().message;
            EXPECT_EQ(figure_text(*again), figure_text(result.model));
        }
    }
}

TEST(FigureTrainer, keeps_counts_against_states_and_how_long_states_last) {
    const FigureModel model = test::learnt(test::known_dance(3), 3, test::known_options(8)).model;
    for (const PartModel& part : model.parts) {
        ASSERT_EQ(part.occurrence.size(), 8U);
        double all = 0.0;
        for (const StateStay& stay : part.stays) {
            EXPECT_GT(stay.mean.count(), 0.0);
            all += stay.mean.count();
        }
        EXPECT_NEAR(all, 8.0, 1e-9);
    }
    // A state a count, about a beat each: counts and states go together.
    const PartModel& lower = model.part(Part::lower);
    for (std::size_t k = 0; k < 8; ++k) {
        EXPECT_GT(lower.occurrence[k][k], 0.5) << k;
        EXPECT_NEAR(lower.stays[k].mean.count(), 1.0, 0.6) << k;
    }
}

TEST(FigureTrainer, a_figure_is_told_from_another_by_its_likelihood) {
    const FigureModel model = test::learnt(test::known_dance(3), 3, test::known_options()).model;
    const std::vector<FigureRepeat> repeats = test::known_repeats(2);
    const std::vector<TrainingClip> same = {test::known_dance(2)};
    std::vector<TrainingClip> other = same;
    for (Pose& pose : other[0].poses) {
        pose = mirrored(pose);
    }
    const Expected<double> own = score_repeats(model, Part::lower, same, repeats, 10.0);
    const Expected<double> mirror = score_repeats(model, Part::lower, other, repeats, 10.0);
    ASSERT_TRUE(own && mirror);
    EXPECT_GT(*own, *mirror + 1.0);
}

TEST(FigureTrainer, one_repeat_and_joints_that_never_move_still_give_a_valid_model) {
    const FigureModel model = test::learnt(test::known_dance(1), 1, test::known_options()).model;
    EXPECT_TRUE(validate(model));
}

TEST(FigureTrainer, refuses_what_cannot_be_learnt_from) {
    const auto message =
        [](const std::function<void(
               TrainingClip&, std::vector<FigureRepeat>&, FigureTrainingOptions&)>& spoil) {
            std::vector<TrainingClip> clips = {test::known_dance(2)};
            std::vector<FigureRepeat> repeats = test::known_repeats(2);
            FigureTrainingOptions options = test::known_options();
            spoil(clips[0], repeats, options);
            const Expected<FigureTrainingResult> result = train_figure(clips, repeats, options);
            return result ? std::string("learnt") : result.error().message;
        };
    using Clip = TrainingClip;
    using Repeats = std::vector<FigureRepeat>;
    using Options = FigureTrainingOptions;
    EXPECT_EQ(message([](Clip&, Repeats& r, Options&) { r.clear(); }),
              "no repeats to learn from; check figure, role, split and confidence");
    EXPECT_EQ(
        message([](Clip& c, Repeats&, Options&) { c.poses[7].hips_position.y = std::nanf(""); }),
        "known: frame 7 is not finite or more than 1000 m away; mend or cut the clip");
    EXPECT_EQ(message([](Clip& c, Repeats&, Options&) { c.poses[7].hips_position.y = 1e30F; }),
              "known: frame 7 is not finite or more than 1000 m away; mend or cut the clip");
    EXPECT_EQ(message([](Clip&, Repeats& r, Options&) { r[1].beat_frames[8] = 400.0; }),
              "known: a repeat spans frames 160.0 to 400.0, the clip has 321");
    EXPECT_EQ(message([](Clip&, Repeats& r, Options&) { r[1].beat_frames[3] = 201.0; }),
              "known: beat 3 of the repeat at frame 160.0 is 1.0 frames long, must be at least 4; "
              "check the counts and --fps");
    EXPECT_EQ(message([](Clip&, Repeats& r, Options&) { r[0].beat_frames.pop_back(); }),
              "known: a repeat has 8 beat times, must have 9 (the end included)");
    EXPECT_EQ(message([](Clip&, Repeats& r, Options&) { r[0].weight = 0.0; }),
              "known: a repeat weighs 0, must be > 0");
    EXPECT_EQ(message([](Clip&, Repeats&, Options& o) { o.states = 0; }),
              "states is 0, must lie in [1, 192]");
    EXPECT_EQ(message([](Clip&, Repeats&, Options& o) { o.beats = 0; }),
              "beats is 0, must lie in [1, 64]");
}

}  // namespace
}  // namespace raks::motion
