#include <cmath>
#include <cstdint>
#include <utility>

#include "apps/raks/bench.hpp"
#include "base/random.hpp"
#include "models/hmm_scorer.hpp"
#include "training/hmm/hmm_training.hpp"

namespace raks::apps {
namespace {

// The sizes that hmmlearn was timed at: 21.7 s of processor time to train, 5.2 us a frame to score.
constexpr Eigen::Index kStates = 10;
constexpr Eigen::Index kFeatures = 39;
constexpr std::size_t kSequences = 50;
constexpr Eigen::Index kFrames = 500;
constexpr int kIterations = 20;

// Sequences of a left-to-right process: each state has a mean of its own, one standard deviation
// from the others in each feature, and neighbouring features are correlated. The borders between
// states differ from sequence to sequence.
models::TrainingSet bench_sequences() {
    const CounterRandom of_states(1, 0);
    models::TrainingSet set;
    for (std::size_t s = 0; s < kSequences; ++s) {
        const CounterRandom random(2, s);
        models::Frames frames(kFrames, kFeatures);
        for (Eigen::Index t = 0; t < kFrames; ++t) {
            // A power bends the time axis a little, differently in each sequence.
            const double bend = 1.0 + 0.1 * random.normal(0);
            const double share = static_cast<double>(t) / static_cast<double>(kFrames);
            const auto state =
                static_cast<std::uint64_t>(std::pow(share, bend) * static_cast<double>(kStates));
            double before = 0.0;
            for (Eigen::Index i = 0; i < kFeatures; ++i) {
                const auto feature = static_cast<std::uint64_t>(i);
                // First-order recursion over the features: their neighbours are correlated.
                before = 0.5 * before +
                         random.normal(1 + static_cast<std::uint64_t>(t * kFeatures) + feature);
                frames(t, i) =
                    before + of_states.normal(state * std::uint64_t{kFeatures} + feature);
            }
        }
        set.sequences.push_back(std::move(frames));
    }
    return set;
}

}  // namespace

Expected<BenchReport> bench_train() {
    const models::TrainingSet set = bench_sequences();
    // Tolerance 0: all iterations are done, however little they gain.
    const models::BaumWelchOptions options{.iterations = kIterations, .tolerance = 0.0};
    const auto start = models::sliced_start(kStates, models::CovarianceType::full, set, options);
    if (!start) {
        return fail(start.error());
    }
    const double training_start = thread_cpu_seconds();
    const auto trained = models::baum_welch(*start, set, options);
    const double training = thread_cpu_seconds() - training_start;
    if (!trained) {
        return fail(trained.error());
    }
    const auto scorer = models::HmmScorer::create(trained->model);
    if (!scorer) {
        return fail(scorer.error());
    }
    const double scoring_start = thread_cpu_seconds();
    // The sum is reported, so that the scoring cannot be optimized away.
    double sum = 0.0;
    for (const models::Frames& frames : set.sequences) {
        sum += models::log_likelihood(*scorer, frames);
    }
    const double scoring = thread_cpu_seconds() - scoring_start;
    constexpr double kAllFrames = static_cast<double>(kSequences) * static_cast<double>(kFrames);
    BenchReport report;
    report.notes.emplace_back("model", "left to right, 10 states, 39 features, full covariances");
    report.notes.emplace_back("set", "50 sequences of 500 frames; 20 iterations; one thread");
    report.values.emplace_back("training_cpu_s", training);
    report.values.emplace_back("scoring_cpu_us_a_frame", 1e6 * scoring / kAllFrames);
    report.values.emplace_back("nats_a_frame", sum / kAllFrames);
    return report;
}

}  // namespace raks::apps
