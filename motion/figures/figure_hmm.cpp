#include "motion/figures/figure_hmm.hpp"

namespace raks::motion {
namespace {

Eigen::VectorXd vector_of(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
}

template <typename Row>
std::vector<double> list_of(const Row& row) {
    std::vector<double> list;
    for (Eigen::Index i = 0; i < row.size(); ++i) {
        list.push_back(row(i));
    }
    return list;
}

}  // namespace

Eigen::MatrixXd matrix_of(const std::vector<std::vector<double>>& rows) {
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()),
                           rows.empty() ? 0 : static_cast<Eigen::Index>(rows[0].size()));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        matrix.row(static_cast<Eigen::Index>(i)) = vector_of(rows[i]).transpose();
    }
    return matrix;
}

models::GaussianHmm hmm_of(const PartModel& part) {
    models::GaussianHmm hmm;
    hmm.initial = vector_of(part.initial);
    hmm.transition = matrix_of(part.transition);
    hmm.exit = vector_of(part.exit);
    hmm.weights = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(part.states.size()), 1);
    hmm.means.resize(static_cast<Eigen::Index>(part.states.size()),
                     static_cast<Eigen::Index>(part.dimension()));
    for (std::size_t k = 0; k < part.states.size(); ++k) {
        hmm.means.row(static_cast<Eigen::Index>(k)) = vector_of(part.states[k].mean).transpose();
    }
    hmm.covariance_type = models::CovarianceType::tied;
    hmm.covariances = {matrix_of(part.covariance)};
    return hmm;
}

void take_hmm(const models::GaussianHmm& hmm, PartModel& part) {
    part.initial = list_of(hmm.initial);
    part.exit = list_of(hmm.exit);
    part.states.resize(static_cast<std::size_t>(hmm.states()));
    part.transition.clear();
    for (Eigen::Index k = 0; k < hmm.states(); ++k) {
        part.states[static_cast<std::size_t>(k)].mean = list_of(hmm.means.row(k));
        part.transition.push_back(list_of(hmm.transition.row(k)));
    }
    part.covariance.clear();
    for (Eigen::Index i = 0; i < hmm.dimension(); ++i) {
        part.covariance.push_back(list_of(hmm.covariances[0].row(i)));
    }
}

Expected<models::TrainingResult> learn_states(const models::TrainingSet& set,
                                              int states,
                                              int iterations,
                                              double covariance_floor) {
    const models::BaumWelchOptions options{
        .iterations = iterations, .tolerance = 0.0, .variance_floor = covariance_floor};
    const Expected<models::GaussianHmm> start =
        models::sliced_start(states, models::CovarianceType::tied, set, options);
    if (!start) {
        return fail(start.error());
    }
    return models::baum_welch(*start, set, options);
}

models::Frames frames_of(const FeatureTrack& track, std::size_t first, std::size_t count) {
    models::Frames frames(static_cast<Eigen::Index>(count),
                          static_cast<Eigen::Index>(track.columns));
    for (std::size_t t = 0; t < count; ++t) {
        const std::span<const double> row = track.row(first + t);
        for (std::size_t i = 0; i < row.size(); ++i) {
            frames(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(i)) = row[i];
        }
    }
    return frames;
}

}  // namespace raks::motion
