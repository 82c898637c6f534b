#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "models/hmm_scorer.hpp"
#include "training/hmm/hmm_training.hpp"

namespace raks::models {
namespace {

/// Sequences of a left-to-right process with three clearly different states.
TrainingSet three_state_data(std::size_t sequences, Eigen::Index dimension, std::uint64_t seed) {
    TrainingSet set;
    for (std::size_t s = 0; s < sequences; ++s) {
        const CounterRandom random(seed, s);
        const Eigen::Index frames = 24 + static_cast<Eigen::Index>(random.below(0, 12));
        Frames sequence(frames, dimension);
        for (Eigen::Index t = 0; t < frames; ++t) {
            const auto third = 3 * t / frames;
            const double level = 4.0 * static_cast<double>(third);
            for (Eigen::Index i = 0; i < dimension; ++i) {
                const auto number = static_cast<std::uint64_t>(1 + t * dimension + i);
                const double sign = i % 2 == 0 ? 1.0 : -1.0;
                sequence(t, i) = level * sign + random.normal(number);
            }
        }
        set.sequences.push_back(sequence);
    }
    return set;
}

class EveryCovariance : public ::testing::TestWithParam<CovarianceType> {};
INSTANTIATE_TEST_SUITE_P(Hmm,
                         EveryCovariance,
                         ::testing::Values(CovarianceType::diagonal,
                                           CovarianceType::full,
                                           CovarianceType::tied,
                                           CovarianceType::spherical),
                         [](const auto& type) {
                             return std::string(
                                 kCovarianceNames[static_cast<std::size_t>(type.param)]);
                         });

TEST_P(EveryCovariance, likelihood_never_falls_and_zeros_stay_zero) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const TrainingSet set = three_state_data(7, 3, seed);
        const BaumWelchOptions plain{
            .iterations = 12, .tolerance = 0.0, .variance_floor = 0.0, .absolute_floor = 0.0};
        const Expected<GaussianHmm> start = sliced_start(4, GetParam(), set, plain);
        ASSERT_TRUE(start) << start.error().message;
        const Expected<TrainingResult> result = baum_welch(*start, set, plain);
        ASSERT_TRUE(result) << result.error().message;
        ASSERT_EQ(result->log_likelihoods.size(), 13U);
        for (std::size_t i = 1; i < result->log_likelihoods.size(); ++i) {
            // 1e-7 absolute: rounding of sums of some hundred nats.
            EXPECT_GE(result->log_likelihoods[i], result->log_likelihoods[i - 1] - 1e-7)
                << "seed " << seed << ", iteration " << i;
        }
        ASSERT_TRUE(validate(result->model));
        for (Eigen::Index i = 0; i < 4; ++i) {
            for (Eigen::Index j = 0; j < 4; ++j) {
                if (j != i && j != i + 1) {
                    EXPECT_EQ(result->model.transition(i, j), 0.0);
                }
            }
            EXPECT_NEAR(result->model.transition.row(i).sum() + result->model.exit[i], 1.0, 1e-12);
        }
    }
}

TEST_P(EveryCovariance, a_constant_feature_is_held_by_the_floor) {
    TrainingSet set = three_state_data(4, 2, 9);
    for (Frames& sequence : set.sequences) {
        sequence.col(1).setConstant(0.25);
    }
    const Expected<GaussianHmm> start = sliced_start(3, GetParam(), set);
    ASSERT_TRUE(start) << start.error().message;
    const Expected<TrainingResult> result = baum_welch(*start, set);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_TRUE(validate(result->model));
    EXPECT_TRUE(std::isfinite(result->log_likelihoods.back()));
}

TEST_P(EveryCovariance, frames_scored_together_have_the_bits_of_frames_scored_alone) {
    const TrainingSet set = three_state_data(3, 7, 2);  // 24 to 35 frames: blocks and a rest
    const Expected<GaussianHmm> model = sliced_start(3, GetParam(), set);
    ASSERT_TRUE(model) << model.error().message;
    const Expected<HmmScorer> scorer = HmmScorer::create(*model);
    ASSERT_TRUE(scorer) << scorer.error().message;
    for (const Frames& frames : set.sequences) {
        const Frames together = scorer->log_emissions(frames);
        for (Eigen::Index t = 0; t < frames.rows(); ++t) {
            std::vector<double> alone(3);
            scorer->log_emissions({frames.row(t).data(), 7}, alone);
            EXPECT_EQ(std::vector<double>(together.row(t).begin(), together.row(t).end()), alone);
        }
    }
}

TEST(HmmTraining, finds_the_levels_of_a_three_state_process) {
    const TrainingSet set = three_state_data(20, 2, 3);
    const Expected<GaussianHmm> start = sliced_start(3, CovarianceType::full, set);
    const Expected<TrainingResult> result = baum_welch(*start, set);
    ASSERT_TRUE(result);
    for (Eigen::Index n = 0; n < 3; ++n) {
        // 20 sequences x about 10 frames of sd 1 a state: standard error 0.07, times 4.
        EXPECT_NEAR(result->model.means(n, 0), 4.0 * static_cast<double>(n), 0.3);
        EXPECT_NEAR(result->model.means(n, 1), -4.0 * static_cast<double>(n), 0.3);
    }
}

TEST_P(EveryCovariance, any_number_of_threads_gives_the_same_bits) {
    const TrainingSet set = three_state_data(100, 3, 4);  // four chunks of 32 or less
    const Expected<GaussianHmm> start = sliced_start(3, GetParam(), set);
    BaumWelchOptions options{.iterations = 3, .tolerance = 0.0};
    const Expected<TrainingResult> one = baum_welch(*start, set, options);
    for (const int threads : {2, 3, 8}) {
        options.threads = threads;
        const Expected<TrainingResult> many = baum_welch(*start, set, options);
        ASSERT_TRUE(one && many);
        EXPECT_EQ(one->log_likelihoods, many->log_likelihoods);
        EXPECT_EQ(one->model.means, many->model.means);
        EXPECT_EQ(one->model.transition, many->model.transition);
        EXPECT_EQ(one->model.covariances, many->model.covariances);
    }
}

TEST(HmmTraining, a_weight_of_two_is_the_sequence_twice) {
    TrainingSet once = three_state_data(3, 2, 5);
    TrainingSet twice = once;
    once.weights = {1.0, 2.0, 1.0};
    twice.sequences.push_back(twice.sequences[1]);
    const BaumWelchOptions options{.iterations = 1, .tolerance = 0.0};
    const Expected<GaussianHmm> start = sliced_start(3, CovarianceType::full, once, options);
    const Expected<TrainingResult> a = baum_welch(*start, once, options);
    const Expected<TrainingResult> b = baum_welch(*start, twice, options);
    ASSERT_TRUE(a && b);
    EXPECT_LE((a->model.means - b->model.means).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_NEAR(a->log_likelihoods.back(), b->log_likelihoods.back(), 1e-9);
}

TEST(HmmTraining, a_state_nothing_reaches_keeps_what_it_had) {
    GaussianHmm start = left_to_right(3, 1, CovarianceType::diagonal, 3.0);
    start.exit.resize(0);
    start.transition.row(2) << 0.0, 0.0, 1.0;
    start.means << 0.0, 1.0, 2.0;
    TrainingSet set;
    set.sequences = {Frames::Zero(1, 1)};  // one frame: states 1 and 2 are out of reach
    const Expected<TrainingResult> result = baum_welch(start, set);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_TRUE(validate(result->model));
    EXPECT_EQ(result->model.transition.row(1), start.transition.row(1));
    EXPECT_EQ(result->model.means(2, 0), 2.0);
}

TEST(HmmTraining, mixtures_raise_the_likelihood_of_two_clusters) {
    TrainingSet set;
    for (std::uint64_t s = 0; s < 6; ++s) {
        const CounterRandom random(6, s);
        Frames sequence(40, 1);
        for (Eigen::Index t = 0; t < 40; ++t) {
            const auto number = static_cast<std::uint64_t>(t);
            sequence(t, 0) = (random.below(2 * number + 1000, 2) == 0 ? -3.0 : 3.0) +
                             0.5 * random.normal(number);
        }
        set.sequences.push_back(sequence);
    }
    const Expected<GaussianHmm> start = sliced_start(1, CovarianceType::diagonal, set);
    const Expected<TrainingResult> one = baum_welch(*start, set, {.iterations = 30});
    const Expected<TrainingResult> two =
        baum_welch(split_heaviest(one->model), set, {.iterations = 30});
    ASSERT_TRUE(one && two) << two.error().message;
    EXPECT_GT(two->log_likelihoods.back(), one->log_likelihoods.back() + 100.0);
    EXPECT_NEAR(std::abs(two->model.means(0, 0)), 3.0, 0.3);
    EXPECT_NEAR(two->model.means(0, 0), -two->model.means(1, 0), 0.3);
}

TEST(HmmTraining, refuses_data_that_cannot_be_learnt_from) {
    const GaussianHmm start = left_to_right(3, 2, CovarianceType::full, 2.0);
    const auto message = [&](const TrainingSet& set) {
        const Expected<TrainingResult> result = baum_welch(start, set);
        return result ? std::string("learnt") : result.error().message;
    };
    EXPECT_EQ(message({{Frames::Zero(5, 3)}, {}}), "sequence 0 has 3 features, must have 2");
    EXPECT_EQ(message({{Frames::Constant(5, 2, std::nan(""))}, {}}),
              "sequence 0 has a value that is not finite or too large");
    EXPECT_EQ(message({{Frames::Constant(5, 2, 1e200)}, {}}),
              "sequence 0 has a value that is not finite or too large");
    EXPECT_EQ(message({{Frames::Zero(5, 2)}, {1.0, 2.0}}),
              "2 weights for 1 sequences, must be as many or none");
    EXPECT_EQ(message({{Frames::Zero(5, 2)}, {-1.0}}), "weight 0 is -1, must be finite and >= 0");
    EXPECT_EQ(message({{Frames::Zero(2, 2)}, {}}),
              "no sequence that the start model can produce; give it other data or fewer states");
    EXPECT_FALSE(sliced_start(9, CovarianceType::full, {{Frames::Zero(5, 2)}, {}}));
}

/// Three clearly different states of 4, 20 and 6 frames: nothing like equal slices.
TrainingSet uneven_data(std::size_t sequences) {
    TrainingSet set;
    for (std::size_t s = 0; s < sequences; ++s) {
        const CounterRandom random(3, s);
        Frames sequence(30, 2);
        for (Eigen::Index t = 0; t < sequence.rows(); ++t) {
            const double level = t < 4 ? 0.0 : t < 24 ? 8.0 : 3.0;
            const auto number = static_cast<std::uint64_t>(2 * t);
            sequence(t, 0) = level + random.normal(number);
            sequence(t, 1) = -level + random.normal(number + 1);
        }
        set.sequences.push_back(sequence);
    }
    return set;
}

TEST_P(EveryCovariance, segmental_start_finds_states_of_uneven_length) {
    const TrainingSet set = uneven_data(6);
    const Expected<GaussianHmm> model = segmental_start(3, GetParam(), set);
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_TRUE(validate(*model));
    // Six sequences: 0.4 is one standard error of a mean of 6 x 4 frames, twice.
    EXPECT_NEAR(model->means(0, 0), 0.0, 0.4);
    EXPECT_NEAR(model->means(1, 0), 8.0, 0.4);
    EXPECT_NEAR(model->means(2, 0), 3.0, 0.4);
    EXPECT_NEAR(model->transition(1, 2), 1.0 / 20.0, 1e-12);
    EXPECT_NEAR(model->exit[2], 1.0 / 6.0, 1e-12);
    const Expected<GaussianHmm> flat = sliced_start(3, GetParam(), set);
    ASSERT_TRUE(flat);
    EXPECT_GT(std::abs(flat->means(0, 0)), 3.0);  // six frames of the second state among its ten
}

TEST_P(EveryCovariance, segmental_start_never_loses_joint_likelihood_and_repeats_its_bits) {
    const BaumWelchOptions plain{.variance_floor = 0.0, .absolute_floor = 1e-12};
    const TrainingSet set = three_state_data(5, 2, 4);
    const auto joint = [&](const GaussianHmm& model) {
        const Expected<HmmScorer> scorer = HmmScorer::create(model);
        double sum = 0.0;
        for (const Frames& frames : set.sequences) {
            sum += viterbi(*scorer, scorer->log_emissions(frames)).log_probability;
        }
        return sum;
    };
    const Expected<GaussianHmm> flat = sliced_start(4, GetParam(), set, plain);
    const Expected<GaussianHmm> once = segmental_start(4, GetParam(), set, plain);
    const Expected<GaussianHmm> again = segmental_start(4, GetParam(), set, plain);
    ASSERT_TRUE(flat && once && again);
    EXPECT_GE(joint(*once), joint(*flat) - 1e-7);  // rounding of sums of some hundred nats
    EXPECT_EQ(once->means, again->means);
    EXPECT_EQ(once->transition, again->transition);
}

TEST(SegmentalStart, leaves_out_sequences_with_fewer_frames_than_states) {
    TrainingSet set = uneven_data(2);
    set.sequences.push_back(set.sequences[0].topRows(2));
    const Expected<GaussianHmm> model = segmental_start(3, CovarianceType::tied, set);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_NEAR(model->transition(1, 2), 1.0 / 20.0, 1e-12);
    set.sequences.assign(1, set.sequences[2]);
    const Expected<GaussianHmm> none = segmental_start(3, CovarianceType::tied, set);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message, "no sequence has the 3 frames that 3 states need");
}

}  // namespace
}  // namespace raks::models
