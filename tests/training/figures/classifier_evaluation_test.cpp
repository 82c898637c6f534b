#include "training/figures/classifier_evaluation.hpp"

#include <gtest/gtest.h>

#include "tests/motion/figures/small_figure.hpp"

namespace raks::motion {
namespace {

/// Takes of two figures: the known dance and its mirror image. The arm that swings is the left one
/// in the first, the right one in the second.
std::vector<FigureExample> examples(const std::string& dancer, std::size_t takes) {
    std::vector<FigureExample> result;
    for (std::size_t i = 0; i < takes; ++i) {
        for (std::size_t figure = 0; figure < 2; ++figure) {
            TrainingClip clip = test::known_dance(2, 0.05 * static_cast<double>(i));
            clip.name = dancer + "_" + std::to_string(i);
            if (figure == 1) {
                for (Pose& pose : clip.poses) {
                    pose = mirrored(pose);
                }
            }
            const std::vector<TrainingClip> clips = {clip};
            for (FigureExample& example :
                 examples_of(figure, clips, test::known_repeats(2), test::known_options())) {
                example.start += 1000.0 * static_cast<double>(figure);
                result.push_back(std::move(example));
            }
        }
    }
    return result;
}

DancerExamples dancer(DanceRole role, const std::string& name) {
    std::vector<FigureExample> all = examples(name, 3);
    DancerExamples result{role, {}, {}};
    for (FigureExample& example : all) {
        (example.take == name + "_2" ? result.unseen : result.training)
            .push_back(std::move(example));
    }
    return result;
}

const std::vector<std::string> kFigures = {"known", "mirrored"};

TEST(ClassifierEvaluation, tells_a_dance_from_its_mirror_image) {
    const std::vector<DancerExamples> dancers = {dancer(DanceRole::lead, "60"),
                                                 dancer(DanceRole::follow, "61")};
    const auto result = evaluate_classifier(kFigures, dancers, test::known_options(6), 2);
    ASSERT_TRUE(result) << result.error().message;
    ASSERT_EQ(result->dancers.size(), 2U);
    for (const DancerEvaluation& one : result->dancers) {
        EXPECT_EQ(one.left_out.right(), 8);
        EXPECT_EQ(one.left_out.total(), 8);
        EXPECT_EQ(one.unseen.right(), 4);
        EXPECT_EQ(one.unseen.right_between(0, 1), 4);
        EXPECT_EQ(one.unseen.total_of(0, 1), 4);
        EXPECT_EQ(one.unseen_by_part[2].right(), 4);
    }
    EXPECT_EQ(result->couple.total(), 4);  // each example has one partner
    EXPECT_EQ(result->couple.right(), 4);
}

TEST(ClassifierEvaluation, any_number_of_threads_gives_the_same_weights) {
    const std::vector<DancerExamples> dancers = {dancer(DanceRole::lead, "60")};
    const auto one = evaluate_classifier(kFigures, dancers, test::known_options(4), 1);
    const auto four = evaluate_classifier(kFigures, dancers, test::known_options(4), 4);
    ASSERT_TRUE(one && four);
    EXPECT_EQ(one->dancers[0].weights, four->dancers[0].weights);
    EXPECT_TRUE(one->couple.confusion.empty());
}

TEST(ClassifierEvaluation, refuses_figures_that_cannot_be_left_out) {
    const auto message = [](const std::vector<std::string>& figures,
                            const DancerExamples& examples) {
        const std::vector<DancerExamples> dancers = {examples};
        const auto result = evaluate_classifier(figures, dancers, test::known_options(4), 1);
        return result ? std::string("evaluated") : result.error().message;
    };
    DancerExamples one_take = dancer(DanceRole::follow, "61");
    std::erase_if(one_take.training, [](const FigureExample& example) {
        return example.figure == 1 && example.take == "61_0";
    });
    EXPECT_EQ(message(kFigures, one_take),
              "mirrored of the follow is in 1 of the takes to learn from, must be in two or more: "
              "one is left out");
    EXPECT_EQ(message({"known"}, one_take), "needs two figures or more to tell apart");
}

TEST(FitWeights, trusts_the_part_that_tells_figures_apart) {
    // The legs are right by 2 nats; the arms say the same of both; the torso is wrong by 1.
    std::vector<ScoredExample> scored;
    for (std::size_t i = 0; i < 10; ++i) {
        const std::size_t own = i % 2;
        FigureScores scores(2, {10.0, 5.0, 30.0});
        scores[own][2] += 2.0;
        scores[1 - own][0] += 1.0;
        scored.push_back({own, scores});
    }
    const PartWeights weights = fit_weights(scored);
    EXPECT_EQ(weights[0], 0.0);
    EXPECT_GT(weights[2], 0.9 * (weights[0] + weights[1] + weights[2]));
    for (const ScoredExample& example : scored) {
        EXPECT_EQ(most_likely(evidence(example.scores, weights)), example.figure);
    }
}

TEST(Decisions, count_pairs_by_themselves) {
    Decisions decisions = no_decisions(3);
    const std::vector<double> third_most = {2.0, 1.0, 3.0};
    decisions.add(0, third_most);  // taken for the third, but not for the second
    const std::vector<double> tie = {1.0, 1.0, 0.0};
    decisions.add(1, tie);  // a tie is no evidence
    EXPECT_EQ(decisions.total(), 2);
    EXPECT_EQ(decisions.right(), 0);
    EXPECT_EQ(decisions.confusion[0][2], 1);
    EXPECT_EQ(decisions.right_between(0, 1), 1);
    EXPECT_EQ(decisions.total_of(0, 1), 2);
    EXPECT_EQ(decisions.right_between(0, 2), 0);
    EXPECT_EQ(decisions.right_between(1, 2), 1);
}

}  // namespace
}  // namespace raks::motion
