#include "models/sliding_score.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::models {
namespace {

/// A random model whose states are left and entered at random; some transitions are impossible.
GaussianHmm random_model(Eigen::Index states, Eigen::Index mixtures, std::uint64_t seed) {
    const CounterRandom random(seed);
    std::uint64_t draw = 0;
    GaussianHmm model = left_to_right(states, 2, CovarianceType::diagonal, 3.0);
    model.exit.resize(0);
    for (Eigen::Index i = 0; i < states; ++i) {
        model.initial(i) = 0.1 + random.uniform(draw++);
        for (Eigen::Index j = 0; j < states; ++j) {
            const bool is_missing = states > 2 && (i + 1) % states == j && seed % 2 == 0;
            model.transition(i, j) = is_missing ? 0.0 : 0.05 + random.uniform(draw++);
        }
        model.transition.row(i) /= model.transition.row(i).sum();
    }
    model.initial /= model.initial.sum();
    model.means = Eigen::MatrixXd::NullaryExpr(
        states * mixtures, 2, [&] { return 3.0 * random.normal(draw++); });
    model.weights =
        Eigen::MatrixXd::Constant(states, mixtures, 1.0 / static_cast<double>(mixtures));
    model.covariances.assign(static_cast<std::size_t>(states * mixtures),
                             Eigen::MatrixXd::Constant(2, 1, 0.8));
    return model;
}

Frames random_frames(Eigen::Index count, std::uint64_t seed) {
    const CounterRandom random(seed, 1);
    std::uint64_t draw = 0;
    return Frames::NullaryExpr(count, 2, [&] { return 3.0 * random.normal(draw++); });
}

std::span<const double> row_of(const Frames& frames, Eigen::Index t) {
    return {frames.data() + t * frames.cols(), static_cast<std::size_t>(frames.cols())};
}

/// ln p of every path through rows [from, to) of the emissions, one by one: {all, the best}.
std::pair<double, double> enumerate(const GaussianHmm& model,
                                    const Frames& emissions,
                                    Eigen::Index from,
                                    Eigen::Index to) {
    const Eigen::Index length = to - from;
    const auto paths = static_cast<long>(
        std::pow(static_cast<double>(model.states()), static_cast<double>(length)));
    std::vector<double> logs;
    for (long path = 0; path < paths; ++path) {
        long rest = path;
        double log = 0.0;
        Eigen::Index before = -1;
        for (Eigen::Index t = 0; t < length; ++t) {
            const Eigen::Index state = rest % model.states();
            rest /= model.states();
            log += std::log(before < 0 ? model.initial(state) : model.transition(before, state)) +
                   emissions(from + t, state);
            before = state;
        }
        logs.push_back(log);
    }
    return {log_sum(logs), *std::max_element(logs.begin(), logs.end())};
}

TEST(SlidingScore, equals_every_path_enumerated_on_tiny_models) {
    for (const Eigen::Index states : {1, 2, 3}) {
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const GaussianHmm model = random_model(states, 2, seed);
            const auto scorer = HmmScorer::create(model);
            ASSERT_TRUE(scorer) << scorer.error().message;
            const Frames emissions = scorer->log_emissions(random_frames(11, seed));
            SlidingScore forward(*scorer, {.block = 2, .blocks = 3});
            SlidingScore viterbi(*scorer,
                                 {.kind = SlidingScore::Kind::viterbi, .block = 2, .blocks = 3});
            int compared = 0;
            for (Eigen::Index t = 0; t < emissions.rows(); ++t) {
                forward.process(row_of(emissions, t));
                viterbi.process(row_of(emissions, t));
                for (int blocks = 1; blocks <= forward.blocks_scored(); ++blocks) {
                    const auto to = static_cast<Eigen::Index>(forward.frames_scored());
                    const auto [sum, best] = enumerate(model, emissions, to - 2 * blocks, to);
                    ASSERT_NEAR(forward.score(blocks), sum, 1e-9) << states << " states, " << t;
                    ASSERT_NEAR(viterbi.score(blocks), best, 1e-9) << states << " states, " << t;
                    ++compared;
                }
            }
            EXPECT_GT(compared, 10);
        }
    }
}

TEST(SlidingScore, equals_the_batch_forward_within_1e_6_after_an_hour) {
    const GaussianHmm model = random_model(3, 2, 5);
    const auto scorer = HmmScorer::create(model);
    ASSERT_TRUE(scorer);
    SlidingScore sliding(*scorer, {.block = 10, .blocks = 50});
    // The same 3,000 frames again and again: sums of an hour would reach 1e6.
    const Frames frames = random_frames(3000, 6);
    const Frames emissions = scorer->log_emissions(frames);
    constexpr Eigen::Index kHour = 360'000;
    for (Eigen::Index t = 0; t < kHour; ++t) {
        sliding.process(row_of(emissions, t % frames.rows()));
    }
    ASSERT_EQ(sliding.frames_scored(), kHour - 10);
    for (const int blocks : {1, 5, 50}) {
        const Eigen::Index to = frames.rows() - 10;
        const Frames window = frames.middleRows(to - 10 * blocks, 10 * blocks);
        EXPECT_NEAR(sliding.score(blocks), log_likelihood(*scorer, window), 1e-6) << blocks;
    }
}

TEST(SlidingScore, viterbi_equals_the_batch_path) {
    const GaussianHmm model = random_model(3, 1, 8);
    const auto scorer = HmmScorer::create(model);
    ASSERT_TRUE(scorer);
    SlidingScore sliding(*scorer, {.kind = SlidingScore::Kind::viterbi, .block = 7, .blocks = 20});
    const Frames emissions = scorer->log_emissions(random_frames(300, 9));
    for (Eigen::Index t = 0; t < emissions.rows(); ++t) {
        sliding.process(row_of(emissions, t));
    }
    const auto to = static_cast<Eigen::Index>(sliding.frames_scored());
    const Frames window = emissions.middleRows(to - 140, 140);
    EXPECT_NEAR(sliding.score(20), viterbi(*scorer, window).log_probability, 1e-9);
}

TEST(SlidingScore, unlikely_frames_do_not_underflow) {
    const GaussianHmm model = random_model(2, 1, 3);
    const auto scorer = HmmScorer::create(model);
    ASSERT_TRUE(scorer);
    SlidingScore sliding(*scorer, {.block = 5, .blocks = 4});
    const Frames frames = Frames::Constant(45, 2, 900.0);  // each frame some -1e6 nats
    const Frames emissions = scorer->log_emissions(frames);
    for (Eigen::Index t = 0; t < emissions.rows(); ++t) {
        sliding.process(row_of(emissions, t));
    }
    const double batch = log_likelihood(*scorer, frames.topRows(20));
    EXPECT_NEAR(sliding.score(4), batch, 1e-9 * std::abs(batch));
}

TEST(SlidingScore, windows_that_were_not_heard_yet_are_impossible) {
    const auto scorer = HmmScorer::create(random_model(2, 1, 1));
    ASSERT_TRUE(scorer);
    SlidingScore sliding(*scorer, {.block = 4, .blocks = 5});
    EXPECT_EQ(sliding.score(1), kImpossible);
    const std::vector<double> frame(2, -1.0);
    for (int t = 0; t < 8; ++t) {
        sliding.process(frame);
    }
    EXPECT_NE(sliding.score(1), kImpossible);
    EXPECT_EQ(sliding.score(2), kImpossible);
    EXPECT_EQ(sliding.score(0), kImpossible);
    sliding.reset();
    EXPECT_EQ(sliding.score(1), kImpossible);
}

TEST(SlidingScore, reset_gives_the_same_bits_and_nothing_allocates) {
    const auto scorer = HmmScorer::create(random_model(3, 2, 2));
    ASSERT_TRUE(scorer);
    SlidingScore sliding(*scorer, {.block = 3, .blocks = 8});
    const Frames emissions = scorer->log_emissions(random_frames(100, 2));
    const auto run = [&] {
        sliding.reset();
        for (Eigen::Index t = 0; t < emissions.rows(); ++t) {
            sliding.process(row_of(emissions, t));
        }
        return sliding.score(8);
    };
    const double first = run();
    test::RealtimeScope scope;
    const double second = run();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace raks::models
