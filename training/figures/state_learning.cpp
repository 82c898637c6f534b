#include "training/figures/state_learning.hpp"

#include "models/hmm_scorer.hpp"
#include "motion/figures/figure_hmm.hpp"

namespace raks::motion {

Expected<models::TrainingResult> learn_states(const models::TrainingSet& set,
                                              const StateLearning& learning) {
    // Tolerance 0: always runs the given number of iterations.
    const models::BaumWelchOptions options{.iterations = learning.iterations,
                                           .tolerance = 0.0,
                                           .variance_floor = learning.covariance_floor};
    const auto start_of =
        learning.start == StatesStart::segmental ? &models::segmental_start : &models::sliced_start;
    const Expected<models::GaussianHmm> start =
        start_of(learning.states, covariance_type_of(learning.covariance), set, options);
    if (!start) {
        return fail(start.error());
    }
    return models::baum_welch(*start, set, options);
}

// The tied covariance is needed whatever type the HMM has: PartModel stores one.
Expected<FollowedStates> follow_states(const models::GaussianHmm& hmm,
                                       const models::TrainingSet& set,
                                       double covariance_floor) {
    const Expected<models::HmmScorer> scorer = models::HmmScorer::create(hmm);
    if (!scorer) {
        return fail(scorer.error());
    }
    FollowedStates followed;
    for (const models::Frames& frames : set.sequences) {
        followed.paths.push_back(models::viterbi(*scorer, scorer->log_emissions(frames)).path);
    }
    // A tied HMM has it already; otherwise it comes from the alignment along the paths.
    if (hmm.covariance_type == models::CovarianceType::tied) {
        followed.tied = hmm.covariances.front();
        return followed;
    }
    const models::BaumWelchOptions options{.variance_floor = covariance_floor};
    const Expected<models::GaussianHmm> tied = models::from_alignment(
        models::left_to_right(hmm.states(), hmm.dimension(), models::CovarianceType::tied, 1.0),
        set,
        followed.paths,
        options);
    if (!tied) {
        return fail(tied.error());
    }
    followed.tied = tied->covariances.front();
    return followed;
}

}  // namespace raks::motion
