// Scores, paths, posteriors and one Baum-Welch step against vectors made by enumeration of all
// state paths (tests/data/hmm/README.md), and against our own enumeration with exits.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "models/hmm_scorer.hpp"
#include "tests/support/realtime_guard.hpp"
#include "training/hmm/hmm_training.hpp"

namespace raks::models {
namespace {

using nlohmann::json;
constexpr double kTolerance = 1e-9;  // absolute; the vectors agree with a second source in 4e-14

const json& cases() {
    static const json document = json::parse(
        std::ifstream(std::string(RAKS_SOURCE_DIR) + "/tests/data/hmm/gaussian_hmm_cases.json"));
    return document["cases"];
}

Frames frames_of(const json& rows) {
    Frames frames(static_cast<Eigen::Index>(rows.size()),
                  static_cast<Eigen::Index>(rows[0].size()));
    for (Eigen::Index t = 0; t < frames.rows(); ++t) {
        for (Eigen::Index i = 0; i < frames.cols(); ++i) {
            frames(t, i) = rows[static_cast<std::size_t>(t)][static_cast<std::size_t>(i)];
        }
    }
    return frames;
}

Eigen::VectorXd vector_of(const json& list) {
    const std::vector<double> numbers = list.get<std::vector<double>>();
    return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                             static_cast<Eigen::Index>(numbers.size()));
}

/// The emissions of a case (or of its re-estimate) into the model.
void take_emissions(GaussianHmm& model, const std::string& type, const json& source) {
    const Eigen::Index n = model.initial.size();
    if (source.contains("weights")) {  // mixtures: means [N][K][D]
        model.covariance_type = CovarianceType::diagonal;
        model.weights = frames_of(source["weights"]);
        const Eigen::Index k = model.weights.cols();
        for (std::size_t i = 0; i < source["means"].size(); ++i) {
            const Frames means = frames_of(source["means"][i]);
            model.means.conservativeResize(n * k, means.cols());
            model.means.middleRows(static_cast<Eigen::Index>(i) * k, k) = means;
            for (const json& variances : source["covars"][i]) {
                model.covariances.push_back(vector_of(variances));
            }
        }
        return;
    }
    model.weights = Eigen::MatrixXd::Ones(n, 1);
    model.means = frames_of(source["means"]);
    const json& covars = source["covars"];
    if (type == "tied") {
        model.covariance_type = CovarianceType::tied;
        model.covariances = {frames_of(covars)};
        return;
    }
    for (const json& entry : covars) {
        if (type == "full") {
            model.covariance_type = CovarianceType::full;
            model.covariances.push_back(frames_of(entry));
        } else if (type == "spherical") {
            model.covariance_type = CovarianceType::spherical;
            model.covariances.push_back(Eigen::MatrixXd::Constant(
                1, 1, (entry.is_array() ? entry[0] : entry).get<double>()));
        } else {
            model.covariance_type = CovarianceType::diagonal;
            model.covariances.push_back(vector_of(entry));
        }
    }
}

GaussianHmm model_of(const std::string& type, const json& source) {
    GaussianHmm model;
    model.initial = vector_of(source["startprob"]);
    model.transition = frames_of(source["transmat"]);
    take_emissions(model, type, source);
    return model;
}

void expect_near(const Eigen::MatrixXd& actual, const Eigen::MatrixXd& expected) {
    ASSERT_EQ(actual.rows(), expected.rows());
    ASSERT_EQ(actual.cols(), expected.cols());
    EXPECT_LE((actual - expected).cwiseAbs().maxCoeff(), kTolerance);
}

void check_sequence(const HmmScorer& scorer, const Frames& frames, const json& expected) {
    const Frames emissions = scorer.log_emissions(frames);
    expect_near(emissions, frames_of(expected["frame_logprob"]));
    EXPECT_NEAR(log_likelihood(scorer, frames), expected["loglik"].get<double>(), kTolerance);

    StreamingForward forward(scorer);
    for (Eigen::Index t = 0; t < frames.rows(); ++t) {
        const std::span<const double> frame(frames.data() + t * frames.cols(),
                                            static_cast<std::size_t>(frames.cols()));
        test::RealtimeScope scope;
        const double prefix = forward.process(frame);
        EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
        if (expected.contains("prefix_loglik")) {
            const json& wanted = expected["prefix_loglik"][static_cast<std::size_t>(t)];
            EXPECT_NEAR(prefix, wanted.get<double>(), kTolerance);
        } else if (t + 1 == frames.rows()) {
            EXPECT_NEAR(prefix, expected["loglik"].get<double>(), kTolerance);
        }
    }
    const ViterbiResult best = viterbi(scorer, emissions);
    EXPECT_NEAR(best.log_probability, expected["viterbi_logprob"].get<double>(), kTolerance);
    EXPECT_EQ(best.path, expected["viterbi_path"].get<std::vector<std::size_t>>());
    if (expected.contains("posteriors")) {
        expect_near(forward_backward(scorer, emissions).posteriors,
                    frames_of(expected["posteriors"]));
    }
}

TEST(HmmVectors, scores_paths_and_posteriors_are_those_of_enumeration) {
    ASSERT_EQ(cases().size(), 13U);
    for (const json& one : cases()) {
        SCOPED_TRACE(one["name"].get<std::string>());
        const Expected<HmmScorer> scorer =
            HmmScorer::create(model_of(one.value("covariance_type", "diag"), one));
        ASSERT_TRUE(scorer) << scorer.error().message;
        for (std::size_t s = 0; s < one["sequences"].size(); ++s) {
            check_sequence(*scorer, frames_of(one["sequences"][s]), one["expected"][s]);
        }
    }
}

TEST(HmmVectors, one_baum_welch_step_is_that_of_the_reference) {
    int checked = 0;
    for (const json& one : cases()) {
        if (!one.contains("after_one_baum_welch_step")) {
            continue;
        }
        SCOPED_TRACE(one["name"].get<std::string>());
        const std::string type = one["covariance_type"];
        TrainingSet set;
        for (const json& sequence : one["sequences"]) {
            set.sequences.push_back(frames_of(sequence));
        }
        const Expected<TrainingResult> result = baum_welch(
            model_of(type, one),
            set,
            {.iterations = 1, .tolerance = 0.0, .variance_floor = 0.0, .absolute_floor = 0.0});
        ASSERT_TRUE(result) << result.error().message;
        const json& expected = one["after_one_baum_welch_step"];
        const GaussianHmm after = model_of(type, expected);
        expect_near(result->model.initial, after.initial);
        expect_near(result->model.transition, after.transition);
        expect_near(result->model.means, after.means);
        ASSERT_EQ(result->model.covariances.size(), after.covariances.size());
        for (std::size_t i = 0; i < after.covariances.size(); ++i) {
            expect_near(result->model.covariances[i], after.covariances[i]);
        }
        double total = 0.0;
        for (const json& loglik : expected["loglik"]) {
            total += loglik.get<double>();
        }
        const Expected<HmmScorer> scorer = HmmScorer::create(after);
        ASSERT_TRUE(scorer) << scorer.error().message;
        double of_reference = 0.0;
        for (const Frames& sequence : set.sequences) {
            of_reference += log_likelihood(*scorer, sequence);
        }
        EXPECT_NEAR(of_reference, total, kTolerance);
        // Ours, 1e-16 away in a covariance of condition 1e8 (few frames a state): 5e-9 seen.
        EXPECT_NEAR(result->log_likelihoods.back(), total, 1e-7);
        ++checked;
    }
    EXPECT_EQ(checked, 12);
}

/// ln p by summing over every path, exit included.
double enumerated(const GaussianHmm& model, const Frames& emissions) {
    const Eigen::Index n = model.states();
    const Eigen::Index frames = emissions.rows();
    double total = 0.0;
    Eigen::Index paths = 1;
    for (Eigen::Index t = 0; t < frames; ++t) {
        paths *= n;
    }
    for (Eigen::Index code = 0; code < paths; ++code) {
        double chance = 1.0;
        Eigen::Index rest = code;
        Eigen::Index before = 0;
        for (Eigen::Index t = 0; t < frames; ++t) {
            const Eigen::Index state = rest % n;
            rest /= n;
            chance *= t == 0 ? model.initial[state] : model.transition(before, state);
            chance *= std::exp(emissions(t, state));
            before = state;
        }
        total += chance * model.exit[before];
    }
    return std::log(total);
}

TEST(Hmm, exits_count_in_the_likelihood_as_enumeration_says) {
    GaussianHmm model = left_to_right(3, 2, CovarianceType::diagonal, 2.0);
    model.means << 0, 0, 1, -1, 2, 0.5;
    Frames frames(5, 2);
    frames << 0.1, 0, 0.9, -0.8, 1.2, -1, 1.9, 0.4, 2.2, 0.6;
    const Expected<HmmScorer> scorer = HmmScorer::create(model);
    ASSERT_TRUE(scorer);
    EXPECT_NEAR(
        log_likelihood(*scorer, frames), enumerated(model, scorer->log_emissions(frames)), 1e-12);
    // Two frames cannot walk through three states to the exit.
    EXPECT_EQ(log_likelihood(*scorer, frames.topRows(2)), kImpossible);
}

TEST(Hmm, a_frame_far_from_every_state_does_not_underflow) {
    const GaussianHmm model = left_to_right(2, 3, CovarianceType::tied, 2.0);
    const Expected<HmmScorer> scorer = HmmScorer::create(model);
    ASSERT_TRUE(scorer);
    const Frames frames = Frames::Constant(6, 3, 1e4);
    const double expected_order = -0.5 * 6 * 3 * 1e8;
    EXPECT_NEAR(log_likelihood(*scorer, frames) / expected_order, 1.0, 1e-6);
    EXPECT_TRUE(forward_backward(*scorer, scorer->log_emissions(frames)).posteriors.allFinite());
}

}  // namespace
}  // namespace raks::models
